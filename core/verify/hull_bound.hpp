#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "core/geometry/material.hpp"

namespace ridgeline::verify {

/// The corners of a box: hull of its points, but for the deviation of the path from its chord.
/// Values at [0] the first and [1] the last end of the path, and of the patch, and of the turn; the
/// corner between the turns lies outside of the arc.
struct Corner {
  Eigen::Vector3d p;
  int path, patch, turn;  ///< turn 2: between
};

/// A lower bound of the distance to the material over the hull of corners, by the one cell that
/// gives the best: the cell is convex, so that inside a cavity its walls are nearest at a corner,
/// and outside of the body the tangent plane at the middle bounds.
struct Bound {
  double value = -std::numeric_limits<double>::infinity();
  std::array<double, 12> at{};  ///< at each corner
};

/// At most 12 corners; `middle` is in their hull.
Bound hull_bound(const geometry::Material& material, const Eigen::Vector3d& middle,
                 const std::vector<Corner>& corners);

}  // namespace ridgeline::verify
