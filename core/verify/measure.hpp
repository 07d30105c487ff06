#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>

#include "core/base/progress.hpp"
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

/// What the cut measures (design: section 9). Feed moves cut; of the tool, the ball cuts and neck,
/// shank and holder must stay clear.
struct Report {
  double width_min = 0, width_max = 0;        ///< over the loop, in each VP(u); 0: an uncut place
  double width_min_at = 0, width_max_at = 0;  ///< u
  /// Deepest cut outside the chamfer band anywhere on the body, by feed moves (see overcut.hpp) or
  /// by the ball in rapids; 0 when there is none.
  double overcut = 0;
  std::optional<Place> overcut_at;  ///< ball centre
  /// Neck and shank to the material along the whole motion; nullopt: not described. Negative: they
  /// meet. Proven to clearance_tolerance (clearance.hpp).
  std::optional<double> neck_clearance;
  std::optional<Place> neck_at;            ///< point of the tool
  std::optional<double> holder_clearance;  ///< likewise, the holder
  std::optional<Place> holder_at;
  /// Smallest distance of all that is described of the tool in rapids; infinite: no rapid moves.
  double rapid_clearance = std::numeric_limits<double>::infinity();
  std::optional<Place> rapid_at;
  double closing_error = 0;  ///< start of the cut to the last half of its loop, worst of all passes
  double path_length = 0;    ///< all moves [mm]
  double cutting_time = 0;   ///< [s], each feed move at its own feed
};

/// Measures the polyline (and arcs) of a motion. Throws Error{BadInput} when the values are not
/// finite, a feed move has no feed, or the motion never meets the edge.
Report measure(const Subject& subject, const path::Motion& motion, const Progress& progress = {});

}  // namespace ridgeline::verify
