#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/chamfer/motion.hpp"

namespace ridgeline::chamfer {

/// Straight blocks from point to point. Fewer than two points: none.
std::vector<CutBlock> straight_blocks(const std::vector<CutPoint>& points);

/// Helical arcs about the tool axis that follow the points' centres within `tolerance`.
struct Blocks {
  std::vector<CutBlock> blocks;
  double error = 0;  ///< certified [mm]
};

/// Throws Error{Unsupported} when the tool axis is not a machine axis: there is no plane of arcs.
Blocks arc_blocks(const std::vector<CutPoint>& points, const Eigen::Vector3d& tool_axis,
                  double tolerance);

}  // namespace ridgeline::chamfer
