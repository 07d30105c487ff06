#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace ridgeline::part {

/// A line in space.
struct Axis {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit
};

/// Surfaces within these share an axis: 1e-5 rad, 1e-4 mm; design 1.3-b and section 4.
constexpr double same_direction = 1e-5;
constexpr double same_place = 1e-4;

/// Do two lines agree within the tolerances, in either sense?
inline bool is_same_axis(const Axis& a, const Axis& b) {
  if (a.direction.cross(b.direction).norm() > same_direction) return false;
  const Eigen::Vector3d d = b.point - a.point;
  return (d - d.dot(a.direction) * a.direction).norm() <= same_place;
}

}  // namespace ridgeline::part
