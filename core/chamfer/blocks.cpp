#include "core/chamfer/blocks.hpp"

#include <algorithm>
#include <cmath>

#include "core/chamfer/arcs.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::chamfer {
namespace {

path::ArcPlane plane_of(const Eigen::Vector3d& tool_axis) {
  constexpr double aligned = 1e-9;
  if (1 - std::abs(tool_axis.z()) < aligned) return path::ArcPlane::XY;
  if (1 - std::abs(tool_axis.y()) < aligned) return path::ArcPlane::ZX;
  if (1 - std::abs(tool_axis.x()) < aligned) return path::ArcPlane::YZ;
  throw Error(ErrorCode::Unsupported,
              "arcs need a tool along X, Y or Z; this one is tilted: ask for lines",
              {.field = "/output/arcs", .value = "true", .limit = "false"});
}

CutBlock block_over(const std::vector<CutPoint>& points, std::size_t from, std::size_t to) {
  CutBlock block{.to = points[to], .contact = 0, .centre = 0, .arc = {}};
  for (std::size_t i = from + 1; i <= to; ++i) {
    block.contact += (middle(points[i]) - middle(points[i - 1])).norm();
    block.centre += (points[i].C - points[i - 1].C).norm();
  }
  return block;
}

}  // namespace

std::vector<CutBlock> straight_blocks(const std::vector<CutPoint>& points) {
  std::vector<CutBlock> blocks;
  for (std::size_t i = 1; i < points.size(); ++i) blocks.push_back(block_over(points, i - 1, i));
  return blocks;
}

Blocks arc_blocks(const std::vector<CutPoint>& points, const Eigen::Vector3d& tool_axis,
                  double tolerance) {
  const path::ArcPlane plane = plane_of(tool_axis);
  Blocks result;
  if (points.size() < 2) return result;
  const auto [i, j, k] = path::axes_of(plane);
  std::vector<Eigen::Vector3d> turned;
  for (const CutPoint& p : points) turned.push_back({p.C[i], p.C[j], p.C[k]});
  std::size_t from = 0;
  for (const ArcBlock& fitted : fit_arcs(turned, tolerance)) {
    CutBlock block = block_over(points, from, fitted.end);
    if (fitted.is_arc) {
      path::Arc arc;
      arc.plane = plane;
      arc.centre = block.to.C;
      arc.centre[i] = fitted.centre.x();
      arc.centre[j] = fitted.centre.y();
      arc.sense = fitted.is_counter_clockwise ? path::ArcSense::CounterClockwise
                                              : path::ArcSense::Clockwise;
      block.arc = arc;
    }
    result.error = std::max(result.error, fitted.error);
    result.blocks.push_back(block);
    from = fitted.end;
  }
  return result;
}

}  // namespace ridgeline::chamfer
