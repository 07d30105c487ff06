#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "clients/ridgeline/commands.hpp"
#include "clients/ridgeline/files.hpp"
#include "clients/ridgeline/subcommand.hpp"
#include "jobs/text.hpp"

namespace ridgeline::command {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

struct Arguments {
  std::string file;
  std::string edit;
  std::optional<int> undo;
  std::optional<int> process;
  std::optional<int> number;
  std::string dialect = "fanuc";
  std::string name;
  std::string tool;
  double width = 0.5;
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

bool has_step_extension(const std::string& text) {
  std::string extension = fs::path(text).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".step" || extension == ".stp" || extension == ".p21";
}

/// Does it look like a file rather than the name of a part in the library?
bool is_step_path(const std::string& text) {
  return has_step_extension(text) || is_file(text);
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

Outcome nc(const Session& session, const Arguments& arguments) {
  Json output = {{"dialect", arguments.dialect}};
  if (arguments.process) output["process"] = *arguments.process;
  if (arguments.number) output["program"] = *arguments.number;
  return ask(session,
             {{"job", "units"},
              {"operation", "nc"},
              {"program", read_document(arguments.file)},
              {"output", std::move(output)}},
             arguments.format);
}

Json holes_job(const std::string& file, const std::string& name) {
  Json job = {{"job", "units"}, {"operation", "holes"}, {"product", file}};
  send_content(job, "product", ".");
  job["name"] = name.empty() ? fs::path(file).stem().string() : name;
  return job;
}

/// The hole edges of a part: workpieces for the library, and chamfer jobs.
Outcome holes(const Session& session, const Arguments& arguments) {
  Json job = holes_job(arguments.file, arguments.name);
  if (!arguments.tool.empty()) {
    const bool is_number = arguments.tool.size() < 9 &&
                           arguments.tool.find_first_not_of("0123456789") == std::string::npos;
    job["chamfer"] = {{"tool", is_number ? Json(std::stol(arguments.tool)) : Json(arguments.tool)},
                      {"width", arguments.width}};
  }
  return ask(session, job, "json");
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
  CLI::App& command =
      add_subcommand(units, selected, arguments, "edit",
                     "Change, insert or remove units; everything after is rebuilt", edit);
  command.add_option("PROGRAM", arguments->file, "Program that plan or edit printed")->required();
  CLI::Option* edits = command.add_option("EDIT", arguments->edit, "Edits (JSON), or -");
  CLI::Option* undo =
      command.add_option("--undo", arguments->undo, "Take back the last N lists of edits instead")
          ->type_name("N");
  edits->excludes(undo);
  command.callback([&selected, arguments] {
    if (arguments->edit.empty() && !arguments->undo) {
      throw CLI::ValidationError("EDIT", "a file of edits or --undo is needed");
    }
    selected.run = [arguments](const Session& session) { return edit(session, *arguments); };
  });
  add_format(command, arguments, {"json", "text", "svg", "html"});
  command.footer(
      "Edits: {\"edits\": [ {\"unit\": 3, \"set\": {\"shape/2/end\": [12, 125]}},\n"
      "{\"insert_after\": 3, \"unit\": {...}}, {\"remove\": 5} ]}; X as radius.");
}

void add_nc(CLI::App& units, Selected& selected) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command = add_subcommand(units, selected, arguments, "nc",
                                     "Write the NC programs of both spindles", nc);
  command.add_option("PROGRAM", arguments->file, "Program (JSON), or -")->required();
  command.add_option("--dialect", arguments->dialect, "Control")
      ->check(CLI::IsMember({"fanuc", "linuxcnc"}))
      ->capture_default_str();
  command.add_option("--process", arguments->process, "Only 1 (main spindle) or 2 (sub spindle)")
      ->check(CLI::Range(1, 2));
  command.add_option("--program", arguments->number, "Number of the first program")
      ->check(CLI::Range(1, 9998));
  add_format(command, arguments, {"nc", "json"});
  command.footer(
      "nc: the text; json: the texts, what each turned unit leaves, and what is not written and "
      "why.\n"
      "LinuxCNC keeps one program in a file: choose a process.");
}

void add_holes(CLI::App& units, Selected& selected) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command =
      add_subcommand(units, selected, arguments, "holes",
                     "Find the hole edges of a part: workpieces and chamfer jobs", holes);
  command.add_option("PART", arguments->file, "STEP file, or a part of the library")->required();
  command.add_option("--name", arguments->name, "Name of the workpiece (default: of the file)");
  CLI::Option* tool = command.add_option("--tool", arguments->tool,
                                         "Also print the jobs that chamfer every edge "
                                         "with this tool of the library");
  command.add_option("--width", arguments->width, "Width of those chamfers")
      ->needs(tool)
      ->capture_default_str();
}

}  // namespace

bool is_part_file(const std::string& path) {
  return path != "-" && has_step_extension(path);
}

Outcome import_part(const Session& session, const std::string& path) {
  const std::string job = holes_job(path, {}).dump(-1, ' ', false, Json::error_handler_t::replace);
  // finding edges needs no library, and storing them makes the file that is not there yet
  Options bare = session.options();
  bare.library.clear();
  const Session local(bare, session.interrupt());
  const jobs::Answer found = (bare.local ? local : session).ask(job, "json");
  if (jobs::is_error(found)) return outcome_of(found, "json");
  Json definitions = found.document.at("workpieces");
  if (found.document.contains("part")) definitions.push_back(found.document.at("part"));
  const Json request = {
      {"job", "library"}, {"operation", "import"}, {"definitions", std::move(definitions)}};
  jobs::Answer stored = session.ask(request.dump(), "json");
  if (jobs::is_error(stored)) return outcome_of(stored, "json");
  stored.document["edges"] = found.document.at("edges");
  stored.document["unnamed"] = found.document.at("unnamed");
  return outcome_of(stored, "json");
}

void add_units_commands(CLI::App& app, Selected& selected) {
  CLI::App* units = app.add_subcommand(
      "units",
      "Machining units: from stock and product to a turn-mill program that survives edits");
  units->require_subcommand(1);
  const auto of_plan = std::make_shared<Arguments>();
  CLI::App& plan_command = add_subcommand(
      *units, selected, of_plan, "plan", "Plan the units that make a product from its stock", plan);
  plan_command.add_option("JOB", of_plan->file, "Job (JSON), or -")->required();
  add_format(plan_command, of_plan, {"json", "text", "svg", "html"});
  const auto of_show = std::make_shared<Arguments>();
  CLI::App& show_command = add_subcommand(*units, selected, of_show, "show",
                                          "Print a program as a tree or a picture", show);
  show_command.add_option("PROGRAM", of_show->file, "Program (JSON), or -")->required();
  add_format(show_command, of_show, {"text", "json", "svg", "html"});
  add_edit(*units, selected);
  add_nc(*units, selected);
  add_holes(*units, selected);
}

}  // namespace ridgeline::command
