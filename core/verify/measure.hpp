#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "core/geometry/workpiece.hpp"
#include "core/path/motion.hpp"
#include "core/tool/tool.hpp"

namespace ridgeline::verify {

/// What a motion is measured against. Work frame, mm, rad. Knows nothing of the solver.
struct Subject {
  geometry::Workpiece workpiece;
  geometry::Edge edge;
  tool::Tool tool;
  Eigen::Vector3d tool_axis = Eigen::Vector3d::UnitZ();  ///< tip to spindle
  double control_to_centre =
      0;             ///< ball centre = control point + this * tool_axis: D for tip, 0 for centre
  double width = 0;  ///< asked [mm]
  double clearance = 0;  ///< asked of rapids
};

/// Where a value was taken.
struct Place {
  std::size_t move = 0;   ///< index of the move
  Eigen::Vector3d point;  ///< work frame
};

/// What the cut measures (design: section 9).
struct Report {
  double width_min = 0, width_max = 0;        ///< over the loop, in each VP(u)
  double width_min_at = 0, width_max_at = 0;  ///< u
  double overcut = 0;                         ///< deepest cut outside the chamfer band, >= 0
  std::optional<Place> overcut_at;
  std::optional<double> neck_clearance;  ///< neck and shank to the material; nullopt: not described
  std::optional<Place> neck_at;
  std::optional<double> holder_clearance;
  std::optional<Place> holder_at;
  double rapid_clearance = 0;  ///< smallest distance of ball, neck, shank and holder in rapids
  double closing_error = 0;    ///< where the cut loop ends against where it began
  double path_length = 0;      ///< all moves [mm]
  double cutting_time = 0;     ///< [s], each feed move at its own feed
};

/// Measures the polyline (and arcs) of a motion. Throws Error{BadInput} when it never meets the
/// edge.
Report measure(const Subject& subject, const path::Motion& motion);

}  // namespace ridgeline::verify
