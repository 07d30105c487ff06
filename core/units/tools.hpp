#pragma once

#include <vector>

#include "core/units/program.hpp"

namespace ridgeline::units {

/// Tools and cutting conditions where nobody says others: carbide in steel of about 200 HB.
/// Turning 180 m/min roughing, 220 m/min finishing, boring 3/4 of it, grooving 100 m/min; drills
/// 70 m/min, feed 0.02 of the diameter up to 0.3 mm; end mills 120 m/min, 0.2 mm a revolution.
std::vector<ToolRow> usual_tools(const Unit& unit);

}  // namespace ridgeline::units
