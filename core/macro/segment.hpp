#pragma once

#include <Eigen/Core>

#include "core/macro/result.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::macro {

/// A move on its way from the block to the record: machine coordinates, not yet compensated.
struct Segment {
  MoveKind kind = MoveKind::Rapid;
  path::ArcPlane plane = path::ArcPlane::XY;  ///< selected plane, also of lines
  bool counter_clockwise = true;
  bool machine_fixed = false;
  int program = 0;
  int line = 0;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< third component of no meaning
  double sweep = 0;                                  ///< of an arc, > 0 [rad]
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();   ///< machine minus work coordinates
  std::uint32_t shift_index = 0;                     ///< of Result::shifts
  double feed = 0;
  double seconds = 0;
  double offset = 0;   ///< cutter compensation: to the left of the path, < 0 to the right; 0: none
  double chamfer = 0;  ///< ,C at the end of this move
  double corner_radius = 0;  ///< ,R at the end of this move
};

inline Eigen::Vector2d in_plane(path::ArcPlane plane, const Eigen::Vector3d& p) {
  const path::PlaneAxes axes = path::axes_of(plane);
  return {p[axes.first], p[axes.second]};
}

inline Eigen::Vector3d with_plane(path::ArcPlane plane, Eigen::Vector3d p,
                                  const Eigen::Vector2d& in) {
  const path::PlaneAxes axes = path::axes_of(plane);
  p[axes.first] = in[0];
  p[axes.second] = in[1];
  return p;
}

inline bool moves_in_plane(const Segment& segment) {
  constexpr double no_motion = 1e-9;  // [mm], far below any increment
  return segment.kind == MoveKind::Arc ||
         (in_plane(segment.plane, segment.to) - in_plane(segment.plane, segment.from)).norm() >
             no_motion;
}

}  // namespace ridgeline::macro
