#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "part/solid.hpp"

namespace ridgeline::part {

/// Largest and smallest extent of a part that is believed [mm]: beyond, the unit is wrong.
constexpr double largest_part = 2e4;
constexpr double smallest_part = 0.1;

/// Sets the translator up: once, some milliseconds. Reading does it when nobody has.
void prepare();

/// Every solid of a STEP file (ISO 10303-21) given as text, millimetres whatever unit the file has,
/// assemblies in their places. Throws Error{BadFile}: no STEP file, cut off, unreadable, no solid;
/// AbsurdSize.
std::vector<Solid> read_step(std::string_view text);

}  // namespace ridgeline::part
