#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/chamfer/job.hpp"
#include "core/geometry/ridge.hpp"
#include "core/geometry/solid.hpp"
#include "core/tool/surface.hpp"

namespace ridgeline::chamfer {

/// A straight way in from outside, of the ball centre. Work frame.
struct Route {
  Eigen::Vector3d tool_axis;  ///< unit, tip to spindle
  Eigen::Vector3d point;      ///< on the way's line
  Eigen::Vector3d outward;    ///< unit, along the line
  bool enters = false;        ///< through the hole or the bore
};

/// The ways for a job's tool axis, best first (one, or two where the sense is free): inner edges
/// through the hole, or through the bore when the axis is nearer to A1; outer edges from outside,
/// or through the hole when the axis points the other way.
std::vector<Route> routes(const Job& job, const geometry::Edge& edge);

/// Throws Error{ToolTooLarge} when the ball does not fit through the hole or the bore.
void require_entry(const Job& job, const geometry::Edge& edge, const Route& route);

/// How much room the tool has. The ball is exact; the other parts are sampled, for choosing a way:
/// the measuring of the finished motion decides.
class Room {
public:
  Room(const geometry::Solid& solid, const tool::Tool& tool, const Eigen::Vector3d& tool_axis);

  /// Of the whole tool, ball centre at c.
  double around(const Eigen::Vector3d& c) const;
  /// Of neck, shank and holder.
  double above(const Eigen::Vector3d& c) const;
  const geometry::Solid& solid() const { return solid_; }
  double ball_radius() const { return D_; }

private:
  struct Sample {
    Eigen::Vector3d offset;
    double radius;
  };
  const geometry::Solid& solid_;
  double D_;
  std::vector<Sample> samples_;
};

/// The lowest point of a route's line, coming in, at which everything is still clear by
/// `clearance`, and from which it stays clear by as much on the way along the tool axis to the
/// height `plane`; not below `base`.
Eigen::Vector3d last_clear_point(const Room& room, const Route& route, const Eigen::Vector3d& base,
                                 double clearance, double plane);

/// How far the workpiece reaches along a direction: max of x . direction over it.
double extent(const geometry::Workpiece& workpiece, const Eigen::Vector3d& direction);

}  // namespace ridgeline::chamfer
