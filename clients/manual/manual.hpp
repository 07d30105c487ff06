#pragma once

#include <string>
#include <vector>

#include "clients/manual/syntax.hpp"

/// Manual pages and completions of a command line, made from what its --help is made from.
namespace ridgeline::manual {

/// What a program's declarations do not say.
struct About {
  int section = 1;  ///< of the manual: 1 commands, 8 administration
  std::string see_also;
};

/// A page for man(1).
std::string man_page(const Syntax& program, const About& about);
/// A completion script for bash; needs no other package.
std::string bash_completion(const Syntax& program);
/// A completion function for zsh's compsys.
std::string zsh_completion(const Syntax& program);

/// Gives a program the option --manual man|bash|zsh, which --help does not show: prints the text
/// and ends. It must be there before the program parses; it shows what has been declared by then.
void add_manual_option(CLI::App& app, const About& about);

}  // namespace ridgeline::manual
