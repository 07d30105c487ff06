#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/macro/cycle.hpp"

namespace ridgeline::macro {

/// A point of the ideal section with its normal out of the material.
struct Surface {
  Eigen::Vector2d point, normal;
  bool is_worked = true;  ///< else it must only not be cut
};

/// The section that a cycle shall leave (design section 1.3), from its drawing.
std::vector<Surface> ideal(const Cycle& cycle);

}  // namespace ridgeline::macro
