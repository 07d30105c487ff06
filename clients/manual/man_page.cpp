#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "clients/manual/manual.hpp"
#include "core/base/version.hpp"

namespace ridgeline::manual {
namespace {

/// Text that troff prints as it is.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-' || c == '\'') {
      result += c == '-' ? "\\-" : "\\(aq";
    } else if (c == '.' && (result.empty() || result.back() == '\n')) {
      result += "\\&.";
    } else {
      result += c;
    }
  }
  return result;
}

std::string bold(const std::string& text) {
  return "\\fB" + escaped(text) + "\\fR";
}

std::string slanted(const std::string& text) {
  return "\\fI" + escaped(text) + "\\fR";
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string value_of(const Argument& argument) {
  std::vector<std::string> choices;
  for (const std::string& choice : argument.choices) choices.push_back(bold(choice));
  return choices.empty() ? slanted(argument.value) : fmt::format("{}", fmt::join(choices, "|"));
}

/// "-o, --output FILE" and what it means, as one tagged paragraph.
std::string paragraph(const Argument& argument) {
  const bool is_positional = !argument.names.front().starts_with('-');
  std::vector<std::string> names;
  for (const std::string& name : argument.names) {
    names.push_back(is_positional ? slanted(name) : bold(name));
  }
  std::string tag = fmt::format("{}", fmt::join(names, ", "));
  if (!argument.value.empty() && (!is_positional || !argument.choices.empty())) {
    tag += (is_positional ? ": " : " ") + value_of(argument);
  }
  std::string text = escaped(one_line(argument.description));
  std::vector<std::string> notes;
  if (argument.is_required && !is_positional) notes.push_back("required");
  if (!argument.range.empty()) notes.push_back(escaped(argument.range));
  if (!argument.otherwise.empty()) notes.push_back("default " + escaped(argument.otherwise));
  if (!notes.empty()) text += " (" + fmt::format("{}", fmt::join(notes, "; ")) + ")";
  return ".TP\n" + tag + "\n" + text + "\n";
}

std::string paragraphs(const std::vector<Argument>& arguments, const std::string& but = {}) {
  std::string text;
  for (const Argument& argument : arguments) {
    if (argument.names.back() != but) text += paragraph(argument);
  }
  return text;
}

/// The footer's lines as filled text; an example stands alone.
std::string footer_of(const std::string& footer) {
  std::string text;
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("Example:") || text.empty()) text += ".PP\n";
    text += escaped(line) + "\n";
  }
  return text;
}

std::string synopsis(const Syntax& command) {
  std::string text = bold(command.name);
  if (!command.options.empty()) text += " [" + slanted("OPTIONS") + "]";
  for (const Argument& each : command.positionals) {
    const std::string name =
        slanted(each.names.front()) + (each.is_repeatable ? " \\&..." : std::string());
    text += each.is_required ? " " + name : " [" + name + "]";
  }
  if (!command.commands.empty()) text += " " + slanted("COMMAND");
  return text + "\n";
}

std::string command_sections(const Syntax& command) {
  std::string text;
  for (const Syntax& each : command.commands) {
    text += ".SS " + escaped(each.name) + "\n" + synopsis(each) + ".PP\n" +
            escaped(each.description) + ".\n" + paragraphs(each.positionals) +
            paragraphs(each.options, "--help") + footer_of(each.footer) + command_sections(each);
  }
  return text;
}

std::string environment(const Syntax& program) {
  std::string text =
      ".SH ENVIRONMENT\n.TP\n" + bold("CYCLONEDDS_URI") +
      "\nDDS configuration, e.g. file:///etc/ridgeline/network.xml; without it the loopback of "
      "this machine alone is used\n";
  for (const Argument& option : program.options) {
    if (!option.environment.empty()) {
      text +=
          ".TP\n" + bold(option.environment) + "\nDefault of " + bold(option.names.back()) + "\n";
    }
  }
  return text;
}

}  // namespace

std::string man_page(const Syntax& program, const About& about) {
  const std::string section = std::to_string(about.section);
  const std::string marker = "Exit status: ";
  const std::size_t statuses = program.footer.find(marker);
  std::string title = program.name;
  std::ranges::transform(title, title.begin(), [](unsigned char c) { return std::toupper(c); });
  std::string page = ".TH " + title + " " + section + " \"\" \"Ridgeline " +
                     std::string(version()) + "\" \"Ridgeline\"\n";
  page += ".SH NAME\n" + program.name + " \\- " + escaped(program.description) + "\n";
  page += ".SH SYNOPSIS\n" + synopsis(program);
  page += ".SH DESCRIPTION\n" + footer_of(program.footer.substr(0, statuses));
  page += ".SH OPTIONS\n" + paragraphs(program.options);
  if (!program.commands.empty()) {
    page += ".SH COMMANDS\nAll options above hold for every command, before or behind its name.\n" +
            command_sections(program);
  }
  page += environment(program);
  if (statuses != std::string::npos) {
    std::string items = one_line(program.footer.substr(statuses + marker.size()));
    for (std::size_t at = 0; (at = items.find(", ", at)) != std::string::npos;) {
      items.replace(at, 2, "\n.br\n");
    }
    page += ".SH EXIT STATUS\n" + escaped(items) + "\n";
  }
  return page + ".SH SEE ALSO\n" + about.see_also + "\n";
}

}  // namespace ridgeline::manual
