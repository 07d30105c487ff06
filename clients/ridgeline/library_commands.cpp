#include <memory>
#include <optional>
#include <vector>

#include "clients/ridgeline/commands.hpp"
#include "clients/ridgeline/files.hpp"
#include "clients/ridgeline/subcommand.hpp"
#include "jobs/refuse.hpp"

namespace ridgeline::command {
namespace {

using Json = nlohmann::json;

struct Arguments {
  std::string kind;
  std::string name;
  std::string file = "-";
  std::optional<int> revision;
};

constexpr const char* kinds = "{workpiece,tool,material,part}";

Outcome ask(const Session& session, Json job) {
  job["job"] = "library";
  return outcome_of(session.ask(job.dump(), "json"), "json");
}

/// The definitions of a file: one, an array, or what export wrote.
Json definitions_in(const std::string& path) {
  Json document = read_document(path);
  if (document.is_object() && document.contains("definitions")) {
    return std::move(document["definitions"]);
  }
  if (document.is_object()) return Json::array({std::move(document)});
  if (document.is_array()) return document;
  jobs::refuse({.value = "neither",
                .limit = "a definition, an array of definitions, or what library export wrote"});
}

void add_file(CLI::App& command, Arguments& arguments, const char* what) {
  command.add_option("FILE", arguments.file, what)->required();
}

void add_key(CLI::App& command, Arguments& arguments) {
  command.add_option("KIND", arguments.kind, "workpiece, tool, material or part")
      ->required()
      ->type_name(kinds);
  command.add_option("NAME", arguments.name, "Name, or number of a tool")
      ->required()
      ->type_name("NAME");
}

Json key(const Arguments& arguments) {
  return {{"kind", arguments.kind}, {"name", arguments.name}};
}

Outcome put(const Session& session, const Arguments& arguments) {
  return ask(session, {{"operation", "put"}, {"definition", read_document(arguments.file)}});
}

Outcome import_all(const Session& session, const Arguments& arguments) {
  if (is_part_file(arguments.file)) return import_part(session, arguments.file);
  return ask(session, {{"operation", "import"}, {"definitions", definitions_in(arguments.file)}});
}

Outcome with_kind(const Session& session, const char* operation, const Arguments& arguments) {
  Json job = {{"operation", operation}};
  if (!arguments.kind.empty()) job["kind"] = arguments.kind;
  return ask(session, std::move(job));
}

Outcome get(const Session& session, const Arguments& arguments) {
  Json job = key(arguments);
  job["operation"] = "get";
  if (arguments.revision) job["revision"] = *arguments.revision;
  return ask(session, std::move(job));
}

Outcome with_key(const Session& session, const char* operation, const Arguments& arguments) {
  Json job = key(arguments);
  job["operation"] = operation;
  return ask(session, std::move(job));
}

}  // namespace

void add_library_commands(CLI::App& app, Selected& selected) {
  CLI::App* library =
      app.add_subcommand("library", "Named workpieces with their holes, tools and materials");
  library->require_subcommand(1);
  library->footer(
      "A put or an import makes a new revision; nothing is overwritten. Results name the "
      "revisions\n"
      "that they were computed from.");
  const auto arguments = std::make_shared<Arguments>();
  add_file(add_subcommand(*library, selected, arguments, "put", "Store one definition", put),
           *arguments, "Definition (JSON), or - for standard input");
  CLI::App& get_command = add_subcommand(*library, selected, arguments, "get",
                                         "Print a definition and its revision", get);
  add_key(get_command, *arguments);
  get_command.add_option("--revision", arguments->revision, "That revision instead of the latest");
  const auto optional_kind = [&](CLI::App& command) {
    command.add_option("KIND", arguments->kind, "Only workpiece, tool, material or part")
        ->type_name(kinds);
  };
  optional_kind(
      add_subcommand(*library, selected, arguments, "list", "List names and revisions",
                     [](const Session& s, const Arguments& a) { return with_kind(s, "list", a); }));
  add_key(add_subcommand(
              *library, selected, arguments, "remove", "Remove a definition; its history stays",
              [](const Session& s, const Arguments& a) { return with_key(s, "remove", a); }),
          *arguments);
  add_key(add_subcommand(
              *library, selected, arguments, "history", "Every revision of a name",
              [](const Session& s, const Arguments& a) { return with_key(s, "history", a); }),
          *arguments);
  add_file(add_subcommand(*library, selected, arguments, "import",
                          "Store many definitions, all or none", import_all),
           *arguments,
           "Array of definitions, or what export wrote (JSON), or - for standard input; or a STEP "
           "file, for\n"
           "the workpieces that its hole edges lie on");
  optional_kind(add_subcommand(
      *library, selected, arguments, "export", "Print every definition, ready for import",
      [](const Session& s, const Arguments& a) { return with_kind(s, "export", a); }));
}

}  // namespace ridgeline::command
