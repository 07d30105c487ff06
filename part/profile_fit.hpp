#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/units/curve.hpp"

namespace ridgeline::part {

struct FittedPiece {
  units::Curve curve;
  double z0 = 0;
  double z1 = 0;
  std::size_t first = 0;  ///< of the points that it runs through
  std::size_t last = 0;
};

/// Lines and arcs through dense points of a smooth profile, within the tolerance of all of them;
/// pieces do not turn back in z, and parts across the axis (constant z) are left out.
std::vector<FittedPiece> fitted(std::span<const units::Point> points, double tolerance);

/// The same along a curve, t from 0 to 1, through as many points as it takes for those in between
/// to lie as near; 1025 at most.
std::vector<FittedPiece> fitted_along(const std::function<units::Point(double t)>& curve,
                                      double tolerance);

}  // namespace ridgeline::part
