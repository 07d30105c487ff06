#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/path/motion.hpp"

namespace ridgeline::jobs {

/// A range of moves [from, to) that cut one after another.
struct CutRange {
  std::size_t from = 0;
  std::size_t to = 0;
};
std::vector<CutRange> cut_ranges(const path::Motion& motion);

/// Shifts along a polyline of control points.
struct Shifts {
  std::vector<Eigen::Vector3d> at;     ///< where each shift belongs
  std::vector<Eigen::Vector3d> shift;  ///< as many
  bool closed = false;                 ///< the last goes over into the first
};
/// The shift at the nearest place of the polyline, linear between its points.
Eigen::Vector3d shift_at(const Shifts& shifts, const Eigen::Vector3d& point);

/// The first of the moves that lead the tool to a range of cuts.
std::size_t lead_of(const path::Motion& motion, const CutRange& cut);

/// The motion with one range of cuts shifted. What leads to it and away from it goes along, as far
/// as the moves before, and after it the lead-out and the way along the tool axis.
path::Motion shifted(const path::Motion& motion, const CutRange& cut, const Shifts& shifts,
                     const Eigen::Vector3d& tool_axis);

}  // namespace ridgeline::jobs
