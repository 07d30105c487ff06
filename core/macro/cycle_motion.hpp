#pragma once

#include <vector>

#include "core/macro/cycle.hpp"

namespace ridgeline::macro {

/// The moves of a solved cycle, of the tool tip, in the work frame. What the program of the cycle
/// commands, before rounding.
Result cycle_motion(const Cycle& cycle, const CycleResult& solved, const Progress& progress);

/// Every point of a helical cycle, in cutting order.
std::vector<HelixPoint> helix_path(const Cycle& cycle);

/// Segments of one turn of a helical corner R.
int helix_segments(const Cycle& cycle);

}  // namespace ridgeline::macro
