#include "core/path/arc.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/error.hpp"
#include "core/base/tolerance.hpp"

namespace ridgeline::path {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// Steps of equal angle that keep the chord error r (1 - cos(step/2)) <= tolerance.
int arc_steps(const ArcShape& arc, double tolerance) {
  if (!(tolerance > 0)) {
    throw Error(ErrorCode::BadInput,
                "arc tolerance " + std::to_string(tolerance) + " mm must be greater than 0");
  }
  const double radius = std::max(arc.start_radius, arc.end_radius);
  // A quarter turn at most: the bound holds for the nearly circular spiral too.
  const double widest = std::numbers::pi / 2;
  const double cosine = std::max(std::cos(widest / 2), 1 - tolerance / radius);
  const double steps = std::ceil(std::abs(arc.sweep) / (2 * std::acos(cosine)) - 1e-9);
  if (!(steps <= arc_steps_limit)) {
    throw Error(ErrorCode::ToleranceTooSmall,
                "an arc of radius " + std::to_string(radius) + " mm needs more than " +
                    std::to_string(arc_steps_limit) + " chords for the tolerance");
  }
  return std::max(1, static_cast<int>(steps));
}

/// A tool axis this near to a machine axis is that axis [rad].
constexpr double machine_axis_angle = 1e-7;

}  // namespace

std::optional<int> machine_axis(const Eigen::Vector3d& tool_axis) {
  for (int n = 0; n < 3; ++n) {
    const Eigen::Vector3d across = tool_axis - tool_axis[n] * Eigen::Vector3d::Unit(n);
    if (across.norm() <= machine_axis_angle) return n;
  }
  return std::nullopt;
}

Eigen::Matrix3d tilted_axes(const Eigen::Vector3d& tool_axis) {
  // Rx(A) Ry(B) e_z = (sin B, -sin A cos B, cos A cos B)
  const double B = std::asin(std::clamp(tool_axis.x(), -1.0, 1.0));
  const double A = std::atan2(-tool_axis.y(), tool_axis.z());
  return (Eigen::AngleAxisd(A, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(B, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

ArcShape arc_shape(const Eigen::Vector3d& from, const Move& move) {
  if (!move.arc) throw Error(ErrorCode::BadInput, "the move has no arc");
  const auto [i, j, k] = axes_of(move.arc->plane);
  ArcShape arc;
  arc.first = move.arc->axes.col(i);
  arc.second = move.arc->axes.col(j);
  arc.third = move.arc->axes.col(k);
  const Eigen::Vector3d& centre = move.arc->centre;
  arc.centre = centre + (from - centre).dot(arc.third) * arc.third;

  const Eigen::Vector3d a = from - arc.centre;
  const Eigen::Vector3d b = move.to - arc.centre;
  const Eigen::Vector2d p(a.dot(arc.first), a.dot(arc.second));
  const Eigen::Vector2d q(b.dot(arc.first), b.dot(arc.second));
  arc.start_radius = p.norm();
  arc.end_radius = q.norm();
  if (!(arc.start_radius > 0 && arc.end_radius > 0)) {
    throw Error(ErrorCode::BadInput, "an end of the arc lies on its centre");
  }
  arc.start_angle = std::atan2(p.y(), p.x());
  arc.rise = b.dot(arc.third);

  // Angle from p to q in the sense of the arc, in (0, 2 pi]; coinciding ends are the full circle.
  const double sign = move.arc->sense == ArcSense::CounterClockwise ? 1 : -1;
  const double cross = p.x() * q.y() - p.y() * q.x();
  double angle = sign * std::atan2(cross, p.dot(q));
  if ((p - q).norm() <= coincident_ends) {
    angle = two_pi;
  } else if (angle <= 0) {
    angle += two_pi;
  }
  arc.sweep = sign * angle;
  return arc;
}

Eigen::Vector3d point_at(const ArcShape& arc, double t) {
  const double angle = arc.start_angle + t * arc.sweep;
  const double radius = arc.start_radius + t * (arc.end_radius - arc.start_radius);
  return arc.centre + radius * (std::cos(angle) * arc.first + std::sin(angle) * arc.second) +
         t * arc.rise * arc.third;
}

double length(const Eigen::Vector3d& from, const Move& move) {
  if (!move.arc) return (move.to - from).norm();
  const ArcShape arc = arc_shape(from, move);
  const double radius = (arc.start_radius + arc.end_radius) / 2;
  return std::hypot(radius * arc.sweep, arc.rise);
}

std::vector<Eigen::Vector3d> sampled(const Eigen::Vector3d& from, const Move& move,
                                     double tolerance) {
  std::vector<Eigen::Vector3d> points;
  if (move.arc) {
    const ArcShape arc = arc_shape(from, move);
    const int steps = arc_steps(arc, tolerance);
    points.reserve(static_cast<std::size_t>(steps));
    for (int n = 1; n < steps; ++n) points.push_back(point_at(arc, n / double(steps)));
  }
  points.push_back(move.to);
  return points;
}

Motion linearised(const Motion& motion, double tolerance, const Progress& progress) {
  Motion lines{motion.start, {}};
  Eigen::Vector3d from = motion.start;
  lines.moves.reserve(motion.moves.size());
  for (std::size_t i = 0; i < motion.moves.size(); ++i) {
    progress.step(i, motion.moves.size(), "moves");
    const Move& move = motion.moves[i];
    for (const Eigen::Vector3d& point : sampled(from, move, tolerance)) {
      lines.moves.push_back({move.kind, point, move.feed, std::nullopt});
    }
    from = move.to;
  }
  return lines;
}

}  // namespace ridgeline::path
