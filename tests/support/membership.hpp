#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/workpiece.hpp"

namespace ridgeline::geometry {

/// Membership straight from the definitions, without any distance.
inline bool is_material(const Workpiece& part, const Eigen::Vector3d& p) {
  const Eigen::Vector3d a1 = part.axis.normalized();
  const Eigen::Vector3d v = p - part.position;
  const Eigen::Vector3d square = v - v.dot(a1) * a1;
  if (square.norm() < part.inner_radius) return false;
  if (part.shape == BodyShape::ThickWalledCylinder) {
    if (square.norm() > part.outer_radius || std::abs(v.dot(a1)) > part.length / 2) return false;
  } else {
    const Eigen::Vector3d local = block_frame(part).axes.transpose() * v;
    if ((local.cwiseAbs().array() > part.size.array() / 2).any()) return false;
  }
  for (const Hole& hole : part.holes) {
    const Frame frame = hole_frame(part, hole);
    const Eigen::Vector3d q = to_local(frame, p);
    const std::optional<double> floor = floor_height(part, hole);
    if (floor && q.z() < *floor) continue;
    if (hole.walls == 1 && square.dot(hole.axis) < 0) continue;
    const double x = std::max(std::abs(q.x()) - hole.profile.straight_across / 2, 0.0);
    const double y = std::max(std::abs(q.y()) - hole.profile.straight_along / 2, 0.0);
    if (x * x + y * y < hole.profile.R2 * hole.profile.R2) return false;
  }
  return true;
}

}  // namespace ridgeline::geometry
