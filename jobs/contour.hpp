#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace ridgeline::jobs {

/// Closed curves where a field over a rectangle is zero, each with the negative side on its left,
/// found by marching squares on cells x cells; what touches the border of the rectangle is closed
/// along it.
std::vector<std::vector<Eigen::Vector2d>> contours(
    const std::function<double(const Eigen::Vector2d&)>& field, const Eigen::Vector2d& min,
    const Eigen::Vector2d& max, int cells);

}  // namespace ridgeline::jobs
