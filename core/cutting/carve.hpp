#pragma once

#include <Eigen/Core>

#include "core/cutting/height_map.hpp"

namespace ridgeline::cutting {

/// Height of the lowest point at (x, y) of a ball of radius r whose centre went straight from one
/// point to another; `none` where it never came.
double swept_height(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double r,
                    const Eigen::Vector2d& at, double none);

/// Takes away what that ball, and the shank above it, leaves no room for.
void carve(HeightMap& map, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double r);

/// A block with a flat top: nodes `cell` apart over [min, max] in X and Y.
HeightMap block_map(const Eigen::Vector3d& min, const Eigen::Vector3d& max, double cell);

}  // namespace ridgeline::cutting
