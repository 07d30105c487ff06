#pragma once

#include <vector>

#include "core/units/product.hpp"
#include "part/placed.hpp"

namespace ridgeline::part {

/// Loops of the lowest floor, projected along n onto n.p = bottom; the loop of greatest extent
/// first.
std::vector<std::vector<units::FaceEdge>> floor_outline(const Placed& part,
                                                        const std::vector<int>& floors,
                                                        const Eigen::Vector3d& n, double bottom);

/// The plan of a pocket without a floor: its walls projected along n.
std::vector<std::vector<units::FaceEdge>> through_outline(const Placed& part,
                                                          const std::vector<int>& walls,
                                                          const Eigen::Vector3d& n, double bottom);

}  // namespace ridgeline::part
