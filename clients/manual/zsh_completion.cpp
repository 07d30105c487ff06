#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "clients/manual/manual.hpp"

namespace ridgeline::manual {
namespace {

/// A text inside a specification of _arguments, in single quotes.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else if (c == '\n') {
      result += ' ';
    } else if (c == ':' || c == '[' || c == ']' || c == '\\') {
      result += std::string("\\") + c;
    } else {
      result += c;
    }
  }
  return result;
}

std::string action_of(const Argument& argument) {
  if (!argument.choices.empty()) return fmt::format("({})", fmt::join(argument.choices, " "));
  if (is_folder(argument)) return "_files -/";
  return is_file(argument) ? "_files" : " ";
}

/// '(-o --output)'{-o,--output}'[text]:FILE:_files'
std::string specification(const Argument& option) {
  std::vector<std::string> alternatives;
  for (const std::string& name : option.names) {
    const bool takes_equals = !option.value.empty() && name.starts_with("--");
    alternatives.push_back(name + (takes_equals ? "=" : ""));
  }
  std::string text = "[" + escaped(option.description) + "]";
  if (!option.value.empty()) text += ":" + escaped(option.value) + ":" + action_of(option);
  const std::string head =
      option.is_repeatable ? "'*'" : fmt::format("'({})'", fmt::join(option.names, " "));
  const std::string names = fmt::format("{}", fmt::join(alternatives, ","));
  return head + (alternatives.size() > 1 ? "{" + names + "}" : names) + "'" + text + "'";
}

std::string function_of(const Syntax& command) {
  std::string name = "_" + command.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::string specifications(const Syntax& command, const Syntax& program) {
  std::string text;
  const auto add = [&text](const std::string& line) { text += " \\\n    " + line; };
  for (const Argument& option : command.options) add(specification(option));
  if (&command != &program) {
    for (const Argument& option : program.options) {
      if (option.names.back() != "--help" && option.names.back() != "--version") {
        add(specification(option));
      }
    }
  }
  for (const Argument& each : command.positionals) {
    add("'" + std::string(each.is_repeatable ? "*" : "") + ":" + escaped(each.names.front()) + ":" +
        action_of(each) + "'");
  }
  return text;
}

std::string functions(const Syntax& command, const Syntax& program) {
  std::string text = function_of(command) + "() {\n";
  if (command.commands.empty()) {
    return text + "  _arguments -s" + specifications(command, program) + "\n}\n";
  }
  text += "  local state line\n  local -a commands=(\n";
  std::string cases, inner;
  for (const Syntax& each : command.commands) {
    const std::string word = each.name.substr(each.name.rfind(' ') + 1);
    text += "    '" + word + ":" + escaped(each.description) + "'\n";
    cases += "        " + word + ") " + function_of(each) + " ;;\n";
    inner += functions(each, program);
  }
  text += "  )\n  _arguments -s -C" + specifications(command, program) +
          " \\\n    '1: :->command' '*:: :->rest'\n  case $state in\n"
          "    command) _describe command commands ;;\n    rest)\n      case $words[1] in\n" +
          cases + "      esac ;;\n  esac\n}\n";
  return inner + text;
}

}  // namespace

std::string zsh_completion(const Syntax& program) {
  return "#compdef " + program.name + "\n" + functions(program, program) + function_of(program) +
         " \"$@\"\n";
}

}  // namespace ridgeline::manual
