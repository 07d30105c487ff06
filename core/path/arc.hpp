#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/path/motion.hpp"

namespace ridgeline::path {

/// Indices of the axes of a plane, right-handed: XY 0 1 2, ZX 2 0 1, YZ 1 2 0.
struct PlaneAxes {
  int first = 0, second = 1, third = 2;
};
constexpr PlaneAxes axes_of(ArcPlane plane) {
  if (plane == ArcPlane::ZX) return {2, 0, 1};
  if (plane == ArcPlane::YZ) return {1, 2, 0};
  return {0, 1, 2};
}

/// The machine axis that a tool axis (unit) lies along, either way: 0 X, 1 Y, 2 Z, within 1e-7 rad,
/// which is less than 1e-5 mm over 100 mm; nullopt: it is tilted.
std::optional<int> machine_axis(const Eigen::Vector3d& tool_axis);

/// Axes of a tilted work plane, as columns: Rx(A) Ry(B) with its third along `tool_axis` (unit).
Eigen::Matrix3d tilted_axes(const Eigen::Vector3d& tool_axis);

/// A move's arc made explicit: angle, radius and height go linearly with t in [0, 1]. The radii
/// differ where the centre is rounded; a control goes the same spiral.
struct ArcShape {
  Eigen::Vector3d centre;                ///< at the height of the start [mm, work frame]
  Eigen::Vector3d first, second, third;  ///< unit axes of the plane and its normal
  double start_radius = 0, end_radius = 0;
  double start_angle = 0;
  double sweep = 0;  ///< signed, counter-clockwise positive; a full circle is +-2 pi [rad]
  double rise = 0;   ///< along third [mm]
};

/// Shape of the arc of `move`, begun at `from`. Throws Error{BadInput} when the move has no arc or
/// an end lies on the centre.
ArcShape arc_shape(const Eigen::Vector3d& from, const Move& move);

Eigen::Vector3d point_at(const ArcShape& arc, double t);

/// Length of a move, straight or arc [mm].
double length(const Eigen::Vector3d& from, const Move& move);

/// The points of a move after `from`, its end included; chord error <= tolerance [mm].
std::vector<Eigen::Vector3d> sampled(const Eigen::Vector3d& from, const Move& move,
                                     double tolerance);

/// The motion with arcs as straight moves of the same kind and feed; chord error <= tolerance [mm].
Motion linearised(const Motion& motion, double tolerance, const Progress& progress = {});

}  // namespace ridgeline::path
