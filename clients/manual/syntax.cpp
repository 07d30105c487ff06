#include "clients/manual/syntax.hpp"

#include <CLI/CLI.hpp>
#include <optional>
#include <sstream>

namespace ridgeline::manual {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// What stands between two marks, where both are there.
std::optional<std::string> between(const std::string& text, const std::string& open,
                                   const std::string& close) {
  const std::size_t before = text.find(open);
  if (before == std::string::npos) return std::nullopt;
  const std::size_t begin = before + open.size(), end = text.find(close, begin);
  if (end == std::string::npos) return std::nullopt;
  return text.substr(begin, end - begin);
}

/// CLI11 puts name and checks of a value into one text: "TEXT:{json,nc}", "INT:INT in [0 - 100]".
void read_type(const std::string& type, Argument& argument) {
  argument.value = type.substr(0, type.find(':'));
  if (const auto choices = between(type, "{", "}")) argument.choices = split(*choices, ',');
  const auto low = between(type, "in [", " - "), high = between(type, " - ", "]");
  if (low && high) argument.range = *low + " to " + *high;
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
  for (const CLI::Option* option : app.get_options(is_shown)) {
    (option->get_positional() ? syntax.positionals : syntax.options)
        .push_back(argument_of(*option));
  }
  for (const CLI::App* command : app.get_subcommands(is_shown)) {
    syntax.commands.push_back(syntax_of(*command, syntax.name + " "));
  }
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
