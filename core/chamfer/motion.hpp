#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/chamfer/route.hpp"

namespace ridgeline::chamfer {

/// A cutting point in the work frame.
struct CutPoint {
  double u = 0;
  Eigen::Vector3d P, G1, G2, C;
};

/// A block of the cut, from the point before.
struct CutBlock {
  Eigen::Vector3d end;           ///< of the ball centre; an arc's is the point's within tolerance
  double contact = 0;            ///< way of the middle of the chamfer [mm]
  double centre = 0;             ///< way of the ball centre [mm]
  std::optional<path::Arc> arc;  ///< of the ball centre; absent: straight
};

/// Once round the edge, in cutting order.
struct Round {
  std::vector<CutPoint> points;  ///< the first is not repeated at the end
  std::vector<CutBlock> blocks;  ///< from the first point round to it again, then past the seam
  CutPoint last;                 ///< where the blocks end
  double chord_error = 0;        ///< certified bound of the true curve to the blocks [mm]
  Eigen::Vector3d first_travel, last_travel;  ///< unit, of the ball centre at both ends
};

/// The middle of the chamfer.
inline Eigen::Vector3d middle(const CutPoint& p) {
  return (p.G1 + p.G2) / 2;
}

/// Does the round, as its points are ordered, climb? The tooth at the contact moves by omega x k,
/// with k from the ball centre to the middle of the chamfer and omega along -tool_axis for
/// a spindle that turns clockwise (M3). Climb milling: it moves against the travel of the tool.
/// Summed over the loop, as places where the contact is below the tip have no sense of their own.
bool is_climb(const std::vector<CutPoint>& points, const Eigen::Vector3d& tool_axis,
              tool::SpindleSense spindle, const Progress& progress = {});

/// What the motion of a job consists of besides its rounds.
struct MotionPlan {
  path::Motion motion;  ///< of the ball centre
  std::vector<std::string> warnings;
  double room = 0;  ///< of the tool's parts above the ball at the places looked at
};

/// Approach, lead-in, rounds, lead-out and retract (design: section 7). `borders`: the chamfer's
/// borders all round, dense, which a lead must not cut into.
MotionPlan plan(const Job& job, const geometry::Edge& edge, const Route& route, const Room& room,
                const std::vector<Round>& rounds, const std::vector<CutPoint>& borders,
                const Progress& progress = {});

}  // namespace ridgeline::chamfer
