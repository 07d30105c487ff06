#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/solid.hpp"
#include "core/geometry/trace.hpp"
#include "core/tool/surface.hpp"

namespace ridgeline::verify {

/// Smallest distance of surfaces to the material along a path of the ball centre, and where.
struct Clearance {
  double value = 0;       ///< [mm]; negative: they meet
  std::size_t piece = 0;  ///< of the path
  Eigen::Vector3d point;  ///< of the tool there, work frame
};

/// What a clearance may be smaller than the one reported: nothing is passed by between samples.
/// Branch and bound over path and surface: distances to the convex cells of the material bound each
/// part of both from below. [mm] and relative.
inline constexpr double clearance_tolerance = 1e-5;
inline constexpr double clearance_relative = 2e-2;

/// Needs a path and at least one surface. `axis`: unit, tip to spindle.
Clearance clearance(const geometry::Solid& solid, const geometry::Trace& path,
                    const Eigen::Vector3d& axis, const std::vector<tool::Surface>& surfaces,
                    const Progress& progress = {});

}  // namespace ridgeline::verify
