#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/macro/segment.hpp"

namespace ridgeline::macro {

/// How two compensated moves join, in the coordinates of the plane.
struct CornerPath {
  Eigen::Vector2d end;                 ///< of the first move
  std::vector<Eigen::Vector2d> extra;  ///< straight moves between
  Eigen::Vector2d begin;               ///< of the second move
};

/// Unit tangents of a move at its ends, in the plane.
Eigen::Vector2d start_tangent(const Segment& segment);
Eigen::Vector2d end_tangent(const Segment& segment);

inline Eigen::Vector2d left_of(const Eigen::Vector2d& direction) {
  return {-direction.y(), direction.x()};
}

/// Corner of cutter compensation C between `first` and `second`, whose offsets are not 0.
/// Raises 033 when the offset paths of an inside corner do not meet, 041 when an arc is smaller
/// than the tool.
CornerPath corner_path(const Segment& first, const Segment& second);

}  // namespace ridgeline::macro
