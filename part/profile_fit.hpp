#pragma once

#include <span>
#include <vector>

#include "core/units/curve.hpp"

namespace ridgeline::part {

struct FittedPiece {
  units::Curve curve;
  double z0 = 0;
  double z1 = 0;
};

/// Lines and arcs through dense points of a smooth profile, within the tolerance of all of them;
/// pieces do not turn back in z, and parts across the axis (constant z) are left out.
std::vector<FittedPiece> fitted(std::span<const units::Point> points, double tolerance);

}  // namespace ridgeline::part
