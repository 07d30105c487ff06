#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "clients/manual/manual.hpp"

namespace ridgeline::manual {
namespace {

/// A text in single quotes of the shell.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

void add_names(const std::vector<Argument>& options, std::vector<std::string>& names) {
  for (const Argument& option : options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
}

std::string words(const std::vector<std::string>& list) {
  return "_ridgeline_words " + quoted(fmt::format("{}", fmt::join(list, " ")));
}

/// All commands, the program itself first.
void collect(const Syntax& command, std::vector<const Syntax*>& all) {
  all.push_back(&command);
  for (const Syntax& each : command.commands) collect(each, all);
}

/// The name without the program's: "macro run".
std::string path_of(const Syntax& command, const Syntax& program) {
  return command.name.size() > program.name.size() ? command.name.substr(program.name.size() + 1)
                                                   : std::string();
}

/// `compgen` for the value of an argument; empty where it can be anything.
std::string words_for(const Argument& argument) {
  if (!argument.choices.empty()) return words(argument.choices);
  if (is_folder(argument)) return "_ridgeline_files -d";
  if (is_file(argument)) return "_ridgeline_files -f";
  return "COMPREPLY=()";
}

/// `-o|--output` of all options that a value follows.
std::string with_value(const std::vector<const Syntax*>& commands) {
  std::vector<std::string> names;
  for (const Syntax* command : commands) {
    for (const Argument& option : command->options) {
      if (!option.value.empty()) {
        names.insert(names.end(), option.names.begin(), option.names.end());
      }
    }
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return fmt::format("{}", fmt::join(names, "|"));
}

std::string value_cases(const std::vector<const Syntax*>& commands, const Syntax& program) {
  std::string cases;
  for (const Syntax* command : commands) {
    for (const Argument& option : command->options) {
      if (option.value.empty()) continue;
      const std::string path = path_of(*command, program);
      std::vector<std::string> patterns;
      for (const std::string& name : option.names) {
        patterns.push_back(path.empty() ? "*" + quoted(" " + name)
                                        : quoted(fmt::format("{} {}", path, name)));
      }
      cases += fmt::format("    {}) {}; return ;;\n", fmt::join(patterns, "|"), words_for(option));
    }
  }
  return cases;
}

/// By the number of positionals before it; the last one goes on where it may be repeated.
std::string positional_case(const std::vector<Argument>& positionals) {
  std::string cases;
  for (std::size_t i = 0; i < positionals.size(); ++i) {
    cases += (positionals[i].is_repeatable ? "*" : std::to_string(i)) + ") " +
             words_for(positionals[i]) + " ;; ";
  }
  return "case $count in " + cases + "esac";
}

std::string word_cases(const std::vector<const Syntax*>& commands, const Syntax& program) {
  std::string cases;
  for (const Syntax* command : commands) {
    std::vector<std::string> options, names;
    add_names(command->options, options);
    if (command != &program) add_names(program.options, options);
    for (const Syntax& each : command->commands) {
      names.push_back(each.name.substr(each.name.rfind(' ') + 1));
    }
    const std::string other = names.empty() ? positional_case(command->positionals) : words(names);
    cases += "    " + quoted(path_of(*command, program)) + ")\n      case $word in\n        -*) " +
             words(options) + " ;;\n        *) " + other + " ;;\n      esac ;;\n";
  }
  return cases;
}

}  // namespace

std::string bash_completion(const Syntax& program) {
  std::vector<const Syntax*> commands;
  collect(program, commands);
  std::vector<std::string> paths;
  for (const Syntax* command : commands) {
    if (command != &program) paths.push_back(quoted(path_of(*command, program)));
  }
  const std::string known = fmt::format("{}", fmt::join(paths, "|"));
  const std::string follow =
      known.empty()
          ? std::string()
          : "      *)\n        case \"${path:+$path }${COMP_WORDS[i]}\" in\n          " + known +
                ") path=${path:+$path }${COMP_WORDS[i]} ;;\n          *' -'*|-*) ;;\n          *) "
                "((++count)) ;;\n        esac ;;\n";
  return "# bash completion of " + program.name +
         R"sh(
_ridgeline_words() { COMPREPLY=($(compgen -W "$1" -- "$word")); }
_ridgeline_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen "$1" -- "$word")
}
_)sh" + program.name +
         R"sh(() {
  local path= count=0 word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} i
  # --format=js comes as three words
  [ "$word" != = ] || word=
  [ "$before" != = ] || before=${COMP_WORDS[COMP_CWORD-2]}
  [ "${COMP_WORDS[COMP_CWORD]}" != = ] || before=${COMP_WORDS[COMP_CWORD-1]}
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${COMP_WORDS[i]} in
      )sh" +
         with_value(commands) + ") [ \"${COMP_WORDS[i+1]}\" != = ] || ((++i)); ((++i)) ;;\n" +
         follow + "    esac\n  done\n  case \"$path $before\" in\n" +
         value_cases(commands, program) + "  esac\n  case $path in\n" +
         word_cases(commands, program) + "  esac\n}\ncomplete -F _" + program.name + " " +
         program.name + "\n";
}

}  // namespace ridgeline::manual
