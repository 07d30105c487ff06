#pragma once

#include <Eigen/Core>

#include "core/cutting/cutter.hpp"
#include "core/cutting/stock.hpp"
#include "core/tool/coefficients.hpp"

namespace ridgeline::cutting {

/// How the deflection at the previous tooth's angle is read between samples. Nearest exists to
/// compare: it costs half the accuracy (design: section 3).
enum class Lookup { Linear, Nearest };
/// StockLimited: the chip ends where the stock ends, at entry and exit (design: section 2 (a)).
enum class ChipEnd { PreviousTooth, StockLimited };

/// One engagement: a tool that moves straight and steadily through stock. Frame of the cut: origin
/// O' (centre of the ball; of a square mill the axis at the tip), Y+ the feed seen along the axis,
/// Z+ from the tip to the spindle. theta counts from -X towards +Y.
struct Cut {
  Cutter cutter;
  tool::Coefficients coefficients;
  Stock stock;
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();  ///< unit, contact point -> O' (27)
  double feed = 0;                               ///< f per tooth, mean over the teeth [mm]
  double phi = 0;                                ///< feed direction below the horizontal [rad]
  int samples = 1024;                            ///< N in a revolution
  int earlier_teeth = 1;  ///< how many teeth back a chip may have been cut (section 2 (b))
  ChipEnd chip_end = ChipEnd::PreviousTooth;
  Lookup lookup = Lookup::Linear;
};

/// Feed direction fd = (0, cos phi, -sin phi).
Eigen::Vector3d feed_direction(const Cut& cut);

/// Throws Error{BadInput} or Error{Unsupported}: field, value, unit, limit.
void validate(const Cut& cut);

}  // namespace ridgeline::cutting
