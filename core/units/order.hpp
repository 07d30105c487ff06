#pragma once

#include <vector>

#include "core/units/program.hpp"

namespace ridgeline::units {

/// Puts units in machining order (S1001 to S1006): by process and the table of kinds, bars from the
/// end of their process, face mills by their bottom, holes by diameter, then by polar angle from
/// +X, smaller Z, smaller number. Stable.
void put_in_order(std::vector<Unit>& units);

/// Place of a unit in the table: smaller is earlier.
int rank(const Unit& unit);

/// Gives the numbers 1, 2, ... in the order they stand.
void number(std::vector<Unit>& units);

}  // namespace ridgeline::units
