#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/path/motion.hpp"

namespace ridgeline::chamfer {

/// One block: from the end of the block before to point `end`, straight or along an arc.
struct ArcBlock {
  std::size_t end = 0;
  bool is_arc = false;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< in the first two coordinates
  bool is_counter_clockwise = true;
  double error = 0;  ///< bound of the polyline's distance to the block [mm]
};

/// Fewest blocks, greedily, that follow the polyline of `points` from the first to the last within
/// `tolerance`: circular in the first two coordinates, the third linear in the angle (a helical
/// arc of a control), of less than half a turn each, through the points where blocks meet.
/// Certified: between two points the polyline is no farther off than at them and the sag of the
/// arc there. Needs two points at least.
std::vector<ArcBlock> fit_arcs(const std::vector<Eigen::Vector3d>& points, double tolerance);

}  // namespace ridgeline::chamfer
