#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace ridgeline::path {

enum class MoveKind { Rapid, Approach, LeadIn, Cut, LeadOut, Retract };
enum class ArcSense { Clockwise, CounterClockwise };  ///< seen from the positive third axis
enum class ArcPlane { XY, ZX, YZ };

/// A circular or helical arc from the end of the move before.
struct Arc {
  Eigen::Vector3d centre;  ///< the component along the plane's third axis is not used [mm]
  ArcPlane plane = ArcPlane::XY;
  ArcSense sense = ArcSense::CounterClockwise;
};

/// One move of the control point, straight unless it has an arc.
struct Move {
  MoveKind kind = MoveKind::Cut;
  Eigen::Vector3d to;  ///< work frame [mm]
  double feed = 0;     ///< [mm/s]; 0 for a rapid
  std::optional<Arc> arc;
};

/// The whole motion. The control point starts at `start`; the first move is a rapid.
struct Motion {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  std::vector<Move> moves;
};

}  // namespace ridgeline::path
