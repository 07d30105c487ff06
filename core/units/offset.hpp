#pragma once

#include "core/units/region.hpp"

namespace ridgeline::units {

/// Every point within `distance` of the region: corners become arcs. Exact lines and circles. The
/// axis is no boundary.
Region grown(const Region& region, double distance);

/// Every point that is at least `distance` inside. The axis is no boundary.
Region shrunk(const Region& region, double distance);

}  // namespace ridgeline::units
