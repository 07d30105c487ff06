#include <memory>
#include <vector>

#include "clients/ridgeline/commands.hpp"
#include "clients/ridgeline/files.hpp"
#include "clients/ridgeline/subcommand.hpp"
#include "jobs/parse.hpp"

namespace ridgeline::command {
namespace {

/// A command that sends a job file as it is.
struct JobCommand {
  const char* name;
  const char* summary;
  std::vector<std::string> formats;
  const char* footer;
};

/// What the parsed arguments of a command are kept in until it runs.
struct Arguments {
  std::string job;
  std::string program;
  std::string binding;
  std::string format = "json";
};

Outcome run_file(const Session& session, const Arguments& arguments) {
  const std::string text = read_file(arguments.job);
  jobs::parse(text);  // what is not JSON is an unusable file, not a refused job
  return outcome_of(session.ask(text, arguments.format), arguments.format);
}

void add_job_command(CLI::App& app, Selected& selected, const JobCommand& job) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command = add_subcommand(app, selected, arguments, job.name, job.summary, run_file);
  command.add_option("JOB", arguments->job, "Job file (JSON), or - for standard input")->required();
  command.add_option("--format", arguments->format, "What to print")
      ->check(CLI::IsMember(job.formats))
      ->capture_default_str();
  command.footer(job.footer);
}

Outcome run_verify(const Session& session, const Arguments& arguments) {
  const nlohmann::json job = {{"job", "verify"},
                              {"program", read_file(arguments.program)},
                              {"against", read_document(arguments.job)}};
  const std::string text = job.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return outcome_of(session.ask(text, "json"), "json");
}

void add_verify(CLI::App& app, Selected& selected) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command =
      add_subcommand(app, selected, arguments, "verify",
                     "Measure an NC program against a chamfer job, whoever wrote it", run_verify);
  command.add_option("PROGRAM", arguments->program, "NC program, or - for standard input")
      ->required();
  command.add_option("--job", arguments->job, "Chamfer job that the program is to keep")
      ->required()
      ->type_name("JOB.json");
  command.footer(
      "Measures the width of the chamfer all round, the deepest cut beside it, and the clearance "
      "of\n"
      "neck, shank, holder and rapids. Exit status 4 when the program does not keep the job.");
}

Outcome run_expand(const Session& session, const Arguments& arguments) {
  nlohmann::json job = {{"job", "expand"}, {"program", read_file(arguments.program)}};
  if (!arguments.binding.empty()) job["binding"] = read_document(arguments.binding);
  const std::string text = job.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return outcome_of(session.ask(text, arguments.format), arguments.format);
}

void add_expand(CLI::App& app, Selected& selected) {
  const auto arguments = std::make_shared<Arguments>();
  arguments->format = "nc";
  CLI::App& command =
      add_subcommand(app, selected, arguments, "expand",
                     "Replace macro calls in an NC program by computed motion", run_expand);
  command.add_option("PROGRAM", arguments->program, "NC program, or - for standard input")
      ->required();
  command
      .add_option("--binding", arguments->binding,
                  "File (JSON) that says what macro numbers and letters mean")
      ->type_name("FILE");
  command.add_option("--format", arguments->format, "What to print")
      ->check(CLI::IsMember({"nc", "json"}))
      ->capture_default_str();
  command.footer(
      "Calls as G65 P9100 W1 H1 T12 Q0.35 E1 become the motion of a chamfer; all other bytes "
      "stay.\n"
      "Without a binding: W workpiece, H hole, T tool (numbers of the library), Q cutting amount "
      "or\n"
      "V width, E edge (1 inner, 2 outer), S side (1 entry, 2 exit), or in place of W and H: I and "
      "J\n"
      "inner and outer radius, K length, R hole radius, U eccentricity, A arrangement and B\n"
      "penetration angle, X Y Z position; C tolerance, D tool radius, F feed, M spindle speed.");
}

}  // namespace

nlohmann::json read_document(const std::string& path) {
  return jobs::parse(read_file(path));
}

void add_job_commands(CLI::App& app, Selected& selected) {
  add_job_command(
      app, selected,
      {"chamfer",
       "Compute the path that chamfers the edge of a hole",
       {"json", "nc", "cl", "csv", "svg", "html", "macro"},
       "Formats: json (path, report), nc (program for the control that the job names), cl (APT CL\n"
       "data), csv (one line a point), svg (drawing), html (viewer for a browser), macro (Custom\n"
       "Macro B that computes the path on the control).\n"
       "Example: ridgeline chamfer job.json --format nc -o O9101.nc"});
  add_verify(app, selected);
  add_expand(app, selected);
}

}  // namespace ridgeline::command
