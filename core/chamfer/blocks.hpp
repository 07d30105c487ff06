#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "core/chamfer/motion.hpp"

namespace ridgeline::chamfer {

/// Straight blocks from point to point. Fewer than two points: none.
std::vector<CutBlock> straight_blocks(const std::vector<CutPoint>& points,
                                      const Progress& progress = {});

/// How arcs follow a polyline of points.
struct ArcWish {
  Eigen::Vector3d tool_axis = Eigen::Vector3d::UnitZ();  ///< unit
  ArcFrame frame = ArcFrame::WorkPlane;
  double tolerance = 0;       ///< of the true curve to the arcs [mm]; above sampling_error
  double sampling_error = 0;  ///< certified bound of the true curve to the polyline [mm]
  std::size_t step = 0;       ///< so many points a block whatever it misses; 0: as far as it may go
};

/// Helical arcs, and lines where these are as good.
struct Blocks {
  std::vector<CutBlock> blocks;
  std::vector<std::size_t> index;  ///< of the point that each block ends at
  double error = 0;                ///< certified bound of the true curve to the blocks [mm]
};

/// Arcs about the tool axis when it is a machine axis, about that of the tilted work plane
/// otherwise; for coordinates of the work frame about X, Y or Z, whichever gives fewest.
Blocks arc_blocks(std::span<const CutPoint> points, const ArcWish& wish,
                  const Progress& progress = {});

}  // namespace ridgeline::chamfer
