#pragma once

#include <span>
#include <variant>

#include "core/units/program.hpp"

namespace ridgeline::units {

/// S108. Numbers are those of the program before the edit.
struct ChangeUnit {
  int number = 0;
  Unit unit;  ///< with its new start, FIG, hole, face or tools
};
struct InsertUnit {
  int after = 0;  ///< 0: at the front
  Unit unit;
};
struct RemoveUnit {
  int number = 0;
};
using Edit = std::variant<ChangeUnit, InsertUnit, RemoveUnit>;

/// S109 to S113 by the rule "v2" of design 1.9: units before the first edited one are frozen; what
/// all edited units remove is taken from the material; the rest is divided again; a new unit equal
/// to an old one is the old one, with its tools. Notes say what could not be rebuilt and why.
/// Throws Error{BadInput} for a number that the program does not have or a FIG that bounds nothing.
Program edit(const Program& program, std::span<const Edit> edits);

}  // namespace ridgeline::units
