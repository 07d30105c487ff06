#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/progress.hpp"
#include "core/geometry/trace.hpp"
#include "core/path/motion.hpp"

namespace ridgeline::path {

/// Pieces of a whole motion, every move, in order, of the point that is `offset` from the control
/// point; their owner is the move's index. Straight moves that stand still give none.
std::vector<geometry::Piece> pieces_of(const Motion& motion, const Eigen::Vector3d& offset,
                                       const Progress& progress = {});

}  // namespace ridgeline::path
