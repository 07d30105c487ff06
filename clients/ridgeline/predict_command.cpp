#include <memory>
#include <vector>

#include "clients/ridgeline/commands.hpp"
#include "clients/ridgeline/files.hpp"
#include "clients/ridgeline/subcommand.hpp"

namespace ridgeline::command {
namespace {

using Json = nlohmann::json;

/// What the parsed arguments are kept in until the command runs.
struct PredictArguments {
  std::string job;
  std::string format = "json";
  bool correct = false;
};

/// A path's own job (a chamfer, a cycle) stands for the prediction along it.
Json predict_document(const PredictArguments& arguments) {
  Json document = read_document(arguments.job);
  const bool is_object = document.is_object();
  if (is_object && document.contains("job") && document["job"] != "predict") {
    document = Json{{"job", "predict"}, {"along", document}};
  }
  if (arguments.correct && is_object && !document.contains("correct")) document["correct"] = true;
  return document;
}

Outcome run(const Session& session, const PredictArguments& arguments) {
  const Json document = predict_document(arguments);
  const std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  return outcome_of(session.ask(text, arguments.format), arguments.format);
}

}  // namespace

void add_predict_command(CLI::App& app, Selected& selected) {
  const auto arguments = std::make_shared<PredictArguments>();
  CLI::App& command = add_subcommand(
      app, selected, arguments, "predict",
      "Predict the machining error that the cutting force makes, and correct a path", run);
  command
      .add_option("JOB", arguments->job,
                  "Job file (JSON): a prediction, or the job of a path; - for standard input")
      ->required();
  command.add_option("--format", arguments->format, "What to print")
      ->check(CLI::IsMember({"json", "nc", "csv", "svg", "html"}))
      ->capture_default_str();
  command.add_flag("--correct", arguments->correct,
                   "Shift the path until what is left of the error is small");
  command.footer(
      "Formats: json (error, force, deflection, stability), nc (program of the corrected path, "
      "with\n"
      "--correct), csv, svg (drawing), html (viewer for a browser).\n"
      "Example: ridgeline predict job.json --correct --format nc -o O9102.nc");
}

}  // namespace ridgeline::command
