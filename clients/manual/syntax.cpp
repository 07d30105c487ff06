#include "clients/manual/syntax.hpp"

#include <CLI/CLI.hpp>
#include <regex>

namespace ridgeline::manual {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// CLI11 puts name and checks of a value into one text: "TEXT:{json,nc}", "INT:INT in [0 - 100]".
void read_type(const std::string& type, Argument& argument) {
  static const std::regex choices(R"(\{([^}]*)\})");
  static const std::regex range(R"(in \[(\S+) - (\S+)\])");
  argument.value = type.substr(0, type.find(':'));
  std::smatch found;
  if (std::regex_search(type, found, choices)) argument.choices = split(found[1], ',');
  if (std::regex_search(type, found, range))
    argument.range = found[1].str() + " to " + found[2].str();
}

Argument argument_of(const CLI::Option& option) {
  Argument argument;
  for (const std::string& name : option.get_snames()) argument.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) argument.names.push_back("--" + name);
  if (option.get_positional()) argument.names = {option.get_name(true)};
  if (option.get_items_expected_max() > 0) read_type(option.get_type_name(), argument);
  argument.description = option.get_description();
  argument.otherwise = option.get_default_str();
  argument.environment = option.get_envname();
  argument.is_required = option.get_required();
  argument.is_repeatable = option.get_items_expected_max() > 1;
  return argument;
}

Syntax syntax_of(const CLI::App& app, const std::string& before) {
  Syntax syntax;
  syntax.name = before + app.get_name();
  syntax.description = app.get_description();
  syntax.footer = app.get_footer();
  const auto is_shown = [](const auto* each) { return !each->get_group().empty(); };
  for (const CLI::Option* option : app.get_options(is_shown))
    (option->get_positional() ? syntax.positionals : syntax.options)
        .push_back(argument_of(*option));
  for (const CLI::App* command : app.get_subcommands(is_shown))
    syntax.commands.push_back(syntax_of(*command, syntax.name + " "));
  return syntax;
}

}  // namespace

Syntax syntax_of(const CLI::App& app) {
  return syntax_of(app, {});
}

bool is_folder(const Argument& argument) {
  return argument.value == "DIR";
}

bool is_file(const Argument& argument) {
  const bool is_positional = !argument.names.front().starts_with('-');
  return argument.choices.empty() && argument.value != "NAME" && !is_folder(argument) &&
         (is_positional || argument.value == "FILE" || argument.value.ends_with(".json"));
}

}  // namespace ridgeline::manual
