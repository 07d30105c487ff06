#pragma once

#include <vector>

#include "core/units/program.hpp"

namespace ridgeline::units {

/// Hole, face mill and unexplained units of the product's findings (S807 to S809), each with its
/// process: drills and mills along Z from the end that they come from, others by the side of the
/// split on which they start (design 1.8-j).
std::vector<Unit> feature_units(const Product& product, const Split& split);

}  // namespace ridgeline::units
