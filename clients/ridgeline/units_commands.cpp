#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "clients/ridgeline/commands.hpp"
#include "clients/ridgeline/files.hpp"
#include "jobs/text.hpp"

namespace ridgeline::command {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Arguments {
  std::string file;
  std::string edit;
  std::optional<int> undo;
  std::string format;
};

Outcome ask(const Session& session, const Json& job, const std::string& format) {
  const std::string text = job.dump(-1, ' ', false, Json::error_handler_t::replace);
  return outcome_of(session.ask(text, format), format);
}

bool is_file(const fs::path& path) {
  std::error_code none;  // what cannot be looked at is no file
  return fs::is_regular_file(path, none);
}

/// Does it look like a file rather than the name of a part in the library?
bool is_step_path(const std::string& text) {
  std::string extension = fs::path(text).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".step" || extension == ".stp" || extension == ".p21" || is_file(text);
}

/// The service reads no files: their text goes with the job. A path is taken from where the command
/// runs, else from where the job file lies.
void send_content(Json& job, const char* key, const fs::path& folder) {
  const auto member = job.find(key);
  if (member == job.end() || !member->is_string()) return;
  const std::string path = member->get<std::string>();
  const bool is_beside_job = !is_file(path) && is_file(folder / path);
  if (!is_beside_job && !is_step_path(path)) return;
  // A STEP file is ASCII; some are written in Latin-1 all the same.
  job[std::string(key) + "_step"] =
      jobs::valid_utf8(read_file(is_beside_job ? (folder / path).string() : path));
  job.erase(key);
}

Outcome plan(const Session& session, const Arguments& arguments) {
  Json job = read_document(arguments.file);
  if (job.is_object()) {
    const fs::path folder =
        arguments.file == "-" ? fs::path(".") : fs::path(arguments.file).parent_path();
    send_content(job, "product", folder);
    send_content(job, "stock", folder);
  }
  return ask(session, job, arguments.format);
}

Outcome show(const Session& session, const Arguments& arguments) {
  return ask(session,
             {{"job", "units"}, {"operation", "show"}, {"program", read_document(arguments.file)}},
             arguments.format);
}

Outcome edit(const Session& session, const Arguments& arguments) {
  Json job = {{"job", "units"}, {"operation", "edit"}, {"program", read_document(arguments.file)}};
  if (arguments.undo) {
    job["undo"] = *arguments.undo;
  } else {
    Json edits = read_document(arguments.edit);
    job["edits"] = edits.is_object() && edits.contains("edits") ? edits["edits"] : edits;
  }
  return ask(session, job, arguments.format);
}

using Run = Outcome (*)(const Session&, const Arguments&);

CLI::App& add(CLI::App& units, Selected& selected, const std::shared_ptr<Arguments>& arguments,
              const char* name, const char* summary, Run run) {
  CLI::App* command = units.add_subcommand(name, summary);
  command->add_option("-o,--output", selected.output, "File for the result")->type_name("FILE");
  command->callback([&selected, arguments, run] {
    selected.run = [arguments, run](const Session& session) { return run(session, *arguments); };
  });
  return *command;
}

void add_format(CLI::App& command, const std::shared_ptr<Arguments>& arguments,
                const std::vector<std::string>& formats) {
  arguments->format = formats.front();
  command.add_option("--format", arguments->format, "What to print")
      ->check(CLI::IsMember(formats))
      ->capture_default_str();
}

void add_edit(CLI::App& units, Selected& selected) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command = add(units, selected, arguments, "edit",
                          "Change, insert or remove units; everything after is rebuilt", edit);
  command.add_option("PROGRAM", arguments->file, "Program that plan or edit printed")->required();
  CLI::Option* edits = command.add_option("EDIT", arguments->edit, "Edits (JSON), or -");
  CLI::Option* undo =
      command.add_option("--undo", arguments->undo, "Take back the last N lists of edits instead")
          ->type_name("N");
  edits->excludes(undo);
  command.callback([&selected, arguments] {
    if (arguments->edit.empty() && !arguments->undo)
      throw CLI::ValidationError("EDIT", "a file of edits or --undo is needed");
    selected.run = [arguments](const Session& session) { return edit(session, *arguments); };
  });
  add_format(command, arguments, {"json", "text", "svg", "html"});
  command.footer(
      "Edits: {\"edits\": [ {\"unit\": 3, \"set\": {\"shape/2/end\": [12, 125]}},\n"
      "{\"insert_after\": 3, \"unit\": {...}}, {\"remove\": 5} ]}; X as radius.");
}

}  // namespace

void add_units_commands(CLI::App& app, Selected& selected) {
  CLI::App* units = app.add_subcommand(
      "units",
      "Machining units: from stock and product to a turn-mill program that survives edits");
  units->require_subcommand(1);
  const auto of_plan = std::make_shared<Arguments>();
  CLI::App& plan_command = add(*units, selected, of_plan, "plan",
                               "Plan the units that make a product from its stock", plan);
  plan_command.add_option("JOB", of_plan->file, "Job (JSON), or -")->required();
  add_format(plan_command, of_plan, {"json", "text", "svg", "html"});
  const auto of_show = std::make_shared<Arguments>();
  CLI::App& show_command =
      add(*units, selected, of_show, "show", "Print a program as a tree or a picture", show);
  show_command.add_option("PROGRAM", of_show->file, "Program (JSON), or -")->required();
  add_format(show_command, of_show, {"text", "json", "svg", "html"});
  add_edit(*units, selected);
}

}  // namespace ridgeline::command
