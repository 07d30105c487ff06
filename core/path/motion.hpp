#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace ridgeline::path {

enum class MoveKind { Rapid, Approach, LeadIn, Cut, LeadOut, Retract };
/// "rapid", "approach", "lead_in", "cut", "lead_out", "retract".
constexpr std::string_view name(MoveKind kind) {
  constexpr std::array<std::string_view, 6> names{"rapid", "approach", "lead_in",
                                                  "cut",   "lead_out", "retract"};
  return names.at(static_cast<std::size_t>(kind));
}
enum class ArcSense { Clockwise, CounterClockwise };  ///< seen from the positive third axis
enum class ArcPlane { XY, ZX, YZ };

/// A circular or helical arc from the end of the move before. Ends that coincide in the plane: a
/// full circle. The geometry is in arc.hpp.
struct Arc {
  Eigen::Vector3d centre;  ///< the component along the plane's third axis is not used [mm]
  ArcPlane plane = ArcPlane::XY;
  ArcSense sense = ArcSense::CounterClockwise;
  /// The axes that `plane` refers to, as columns in the work frame (a tilted work plane). `centre`
  /// is in the work frame all the same.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// One move of the control point, straight unless it has an arc.
struct Move {
  MoveKind kind = MoveKind::Cut;
  Eigen::Vector3d to;      ///< work frame [mm]
  double feed = 0;         ///< [mm/s]; 0 for a rapid
  std::optional<Arc> arc;  ///< only with a feed
};

/// The whole motion. The control point starts at `start`; the first move is a rapid.
struct Motion {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  std::vector<Move> moves;
};

}  // namespace ridgeline::path
