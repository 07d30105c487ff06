#pragma once

#include <Eigen/Core>

namespace ridgeline::geometry {

/// A right-handed orthonormal frame: its axes as columns and its origin, both in the outer frame.
struct Frame {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [mm]
};

inline Eigen::Vector3d to_outer(const Frame& frame, const Eigen::Vector3d& point) {
  return frame.origin + frame.axes * point;
}
inline Eigen::Vector3d to_local(const Frame& frame, const Eigen::Vector3d& point) {
  return frame.axes.transpose() * (point - frame.origin);
}
inline Eigen::Vector3d direction_to_outer(const Frame& frame, const Eigen::Vector3d& direction) {
  return frame.axes * direction;
}
inline Eigen::Vector3d direction_to_local(const Frame& frame, const Eigen::Vector3d& direction) {
  return frame.axes.transpose() * direction;
}

}  // namespace ridgeline::geometry
