#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ridgeline::manual {

/// An option or a positional argument of a command.
struct Argument {
  std::vector<std::string> names;    ///< "-o", "--output"; a positional: its name
  std::string value;                 ///< what follows, e.g. "FILE"; empty for a flag
  std::vector<std::string> choices;  ///< the words it takes; empty: any
  std::string range;                 ///< e.g. "0 to 100"; empty: any
  std::string description;
  std::string otherwise;    ///< the default
  std::string environment;  ///< the variable that sets it
  bool is_required = false;
  bool is_repeatable = false;
};

/// A program or one of its commands.
struct Syntax {
  std::string name;  ///< with those before it: "ridgeline macro run"
  std::string description;
  std::string footer;
  std::vector<Argument> options;
  std::vector<Argument> positionals;
  std::vector<Syntax> commands;
};

Syntax syntax_of(const CLI::App& app);

/// Does the argument take the name of a file, of a folder?
bool is_file(const Argument& argument);
bool is_folder(const Argument& argument);

}  // namespace ridgeline::manual
