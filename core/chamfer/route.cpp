#include "core/chamfer/route.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/text.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector3d;
using geometry::EdgeKind;
using geometry::Side;

constexpr double opposite = -0.1;    ///< cosine: a tool axis this far against a way cannot take it
constexpr double finest_step = 0.2;  ///< of the search for the last clear point [mm]
constexpr double tight = 1e-9;       ///< [mm]
constexpr int samples_round = 12;
constexpr double sample_spacing = 1;  ///< along the tool, in radii of the part

Route through_hole(const geometry::Edge& edge, const Vector3d& tool_axis, double sense,
                   bool enters) {
  return {.tool_axis = tool_axis,
          .point = edge.frame.origin,
          .outward = sense * edge.frame.axes.col(2),
          .enters = enters};
}

Route through_bore(const Job& job, const Vector3d& tool_axis, double sense) {
  return {.tool_axis = tool_axis,
          .point = job.workpiece.position,
          .outward = sense * job.workpiece.axis.normalized(),
          .enters = true};
}

bool is_through(const Job& job) {
  const auto hole = std::ranges::find(job.workpiece.holes, job.hole, &geometry::Hole::name);
  return hole->walls == 2 && !hole->depth;
}

std::vector<Route> hole_routes(const Job& job, const geometry::Edge& edge) {
  const Vector3d A2 = edge.frame.axes.col(2);
  const double own = job.side == Side::Entry ? 1 : -1;
  std::vector<Route> all;
  if (job.edge == EdgeKind::Outer) {
    all.push_back(through_hole(edge, own * A2, own, false));
    if (is_through(job)) all.push_back(through_hole(edge, -own * A2, -own, true));
  } else {
    all.push_back(through_hole(edge, A2, 1, true));
    if (is_through(job)) all.push_back(through_hole(edge, -A2, -1, true));
  }
  return all;
}

std::vector<Route> bore_routes(const Job& job, const geometry::Edge& edge) {
  const Vector3d A1 = job.workpiece.axis.normalized();
  const double nearer = (edge.frame.origin - job.workpiece.position).dot(A1) < 0 ? -1 : 1;
  return {through_bore(job, nearer * A1, nearer), through_bore(job, -nearer * A1, -nearer)};
}

Route fixed_route(const Job& job, const geometry::Edge& edge, const Vector3d& axis) {
  const double along_A2 = axis.dot(edge.frame.axes.col(2));
  if (job.edge == EdgeKind::Outer) {
    const double own = job.side == Side::Entry ? 1 : -1;
    const bool from_outside = own * along_A2 > opposite;
    return through_hole(edge, axis, from_outside ? own : -own, !from_outside);
  }
  const double along_A1 = axis.dot(job.workpiece.axis.normalized());
  if (std::abs(along_A1) > std::abs(along_A2)) {
    return through_bore(job, axis, along_A1 < 0 ? -1 : 1);
  }
  return through_hole(edge, axis, along_A2 < 0 ? -1 : 1, true);
}

}  // namespace

std::vector<Route> routes(const Job& job, const geometry::Edge& edge) {
  if (const auto* axis = std::get_if<Vector3d>(&job.tool_axis)) {
    return {fixed_route(job, edge, axis->normalized())};
  }
  return std::get<Access>(job.tool_axis) == Access::Hole ? hole_routes(job, edge)
                                                         : bore_routes(job, edge);
}

void require_entry(const Job& job, const geometry::Edge& edge, const Route& route) {
  if (!route.enters) return;
  const double D = tool::cutting_radius(job.tool);
  const bool along_A2 = std::abs(route.outward.dot(edge.frame.axes.col(2))) > 0.999999;
  const double limit =
      along_A2 ? geometry::half_extents(edge.profile).minCoeff() : job.workpiece.inner_radius;
  if (D < limit) return;
  throw Error(ErrorCode::ToolTooLarge,
              std::string("the ball, diameter ") + text(2 * D, "mm") +
                  ", does not fit through the " + (along_A2 ? "hole" : "bore") + ", " +
                  text(2 * limit, "mm") + " across",
              {.field = "/tool", .value = text(2 * D, "mm"), .limit = text(2 * limit, "mm")});
}

Room::Room(const geometry::Solid& solid, const tool::Tool& tool, const Vector3d& tool_axis)
    : solid_(solid), D_(tool::cutting_radius(tool)) {
  const double top = 4 * solid.reach();
  std::vector<tool::Surface> parts = tool::neck_of(tool, top);
  for (const tool::Surface& part : tool::holder_of(tool, top)) parts.push_back(part);
  const Vector3d x = tool_axis.unitOrthogonal();
  const Vector3d y = tool_axis.cross(x);
  for (const tool::Surface& part : parts) {
    for (int i = 0; i < samples_round; ++i) {  // the lower rim
      const double w = 2 * std::numbers::pi * i / samples_round;
      samples_.push_back(
          {part.low * tool_axis + part.outer * (std::cos(w) * x + std::sin(w) * y), 0});
    }
    if (part.inner < part.outer) continue;  // a ring is its rim
    const double step = sample_spacing * part.outer;
    for (double h = part.low + part.outer; h < part.high && h < 2.5 * solid.reach(); h += step) {
      samples_.push_back({h * tool_axis, part.outer});
    }
  }
}

double Room::above(const Vector3d& c) const {
  double room = 1e300;
  for (const Sample& s : samples_) {
    // A bound that is already enough saves the exact distance.
    const double bound = geometry::distance(solid_.material(), c + s.offset) - s.radius;
    if (bound < room) room = std::min(room, solid_.distance(c + s.offset) - s.radius);
  }
  return room;
}

double Room::around(const Vector3d& c) const {
  return std::min(solid_.distance(c) - D_, above(c));
}

namespace {

/// Is everything clear by `clearance` from c up to the height `plane` along the tool axis?
bool is_clear_above(const Room& room, const Vector3d& axis, Vector3d c, double clearance,
                    double plane) {
  while (c.dot(axis) < plane) {
    const double spare = room.around(c) - clearance;
    if (spare < -tight) return false;
    c += std::max(spare, finest_step) * axis;
  }
  return true;
}

}  // namespace

Vector3d last_clear_point(const Room& room, const Route& route, const Vector3d& base,
                          double clearance, double plane) {
  const double far = 4 * room.solid().reach() + 2 * clearance + 2 * room.ball_radius() +
                     (base - route.point).norm();
  double h = far;
  while (h > 0) {
    const double spare = room.around(base + h * route.outward) - clearance;
    if (!(spare > finest_step)) break;
    h -= spare;
  }
  h = std::max(h, 0.0);
  const auto place = [&](double out) -> Vector3d { return base + out * route.outward; };
  while (h < far && !is_clear_above(room, route.tool_axis, place(h), clearance, plane)) {
    h += finest_step;
  }
  return place(std::min(h, far));
}

double extent(const geometry::Workpiece& workpiece, const Vector3d& direction) {
  const double middle = workpiece.position.dot(direction);
  if (workpiece.shape == geometry::BodyShape::ManifoldBlock) {
    const Vector3d local = geometry::block_frame(workpiece).axes.transpose() * direction;
    return middle + local.cwiseAbs().dot(workpiece.size) / 2;
  }
  const double along = workpiece.axis.normalized().dot(direction);
  return middle + std::abs(along) * workpiece.length / 2 +
         std::sqrt(std::max(0.0, 1 - along * along)) * workpiece.outer_radius;
}

}  // namespace ridgeline::chamfer
