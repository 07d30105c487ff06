#pragma once

#include <string>
#include <vector>

#include "core/macro/cycle_program.hpp"

namespace ridgeline::macro {

/// A parameter of a cycle program: its G65 letter, local variable and value.
struct Argument {
  char letter;
  int variable;
  double value;
  std::string meaning;
  bool is_needed = true;  ///< without a default
};

/// The parameters of a cycle, in the order in which the program lists them.
std::vector<Argument> arguments_of(const Cycle& cycle);

/// Range checks that alarm.
void write_checks(const Cycle& cycle, MacroText& text);

/// The statements of a cycle after its parameters. Local variables: #27 tool radius, #28 core
/// radius a, #29 y of approach; #30 count, #31 last count; #32 station; #14, #15 tip.
void write_body(const Cycle& cycle, MacroText& text);

/// Method 1 and the parts that methods share.
void write_across(const Cycle& cycle, MacroText& text);
void write_along(const Cycle& cycle, MacroText& text);
void write_helix(const Cycle& cycle, MacroText& text);
void write_rotation(const Cycle& cycle, MacroText& text);
void write_series(const Cycle& cycle, MacroText& text);
/// Passes along an outline: the contour is program `contour`.
void write_complex(const Cycle& cycle, MacroText& text, int contour);
void write_contour(const Cycle& cycle, MacroText& text);

/// X and Y words of section coordinate y (an expression) at the place along the edge.
std::string place_words(const Cycle& cycle, const std::string& along, const std::string& y);

}  // namespace ridgeline::macro
