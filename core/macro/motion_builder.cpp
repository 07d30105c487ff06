#include "core/macro/motion_builder.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace ridgeline::macro {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double no_radius = 1e-6;    // [mm]
constexpr double same_point = 1e-7;   // [mm]
constexpr double rapid_feed = 20000;  // [mm/min], for the time only

}  // namespace

MotionBuilder::MotionBuilder(Result& result)
    : recorder_(result, std::numeric_limits<std::size_t>::max(), rapid_feed) {
  recorder_.shift_index({});  // work and machine coordinates are the same
}

void MotionBuilder::rapid(const Vector3d& to) {
  Segment segment;
  segment.from = at_;
  segment.to = at_ = to;
  recorder_.move(segment);
}

void MotionBuilder::line(const Vector3d& to, double feed) {
  Segment segment;
  segment.kind = MoveKind::Line;
  segment.from = at_;
  segment.to = at_ = to;
  segment.feed = feed;
  recorder_.move(segment);
}

void MotionBuilder::arc(const Vector3d& to, const Vector3d& centre, path::ArcPlane plane,
                        bool counter_clockwise, double feed) {
  const Vector2d c = in_plane(plane, centre);
  const Vector2d a = in_plane(plane, at_) - c;
  const Vector2d b = in_plane(plane, to) - c;
  if (a.norm() < no_radius) return;
  Segment segment;
  segment.kind = MoveKind::Arc;
  segment.plane = plane;
  segment.counter_clockwise = counter_clockwise;
  segment.from = at_;
  segment.to = at_ = to;
  segment.centre = centre;
  segment.feed = feed;
  double sweep = std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x());
  if (!counter_clockwise) sweep = -sweep;
  sweep = std::fmod(sweep, 2 * std::numbers::pi);
  if (sweep < 0) sweep += 2 * std::numbers::pi;
  segment.sweep = (a - b).norm() < same_point ? 2 * std::numbers::pi : sweep;
  recorder_.move(segment);
}

}  // namespace ridgeline::macro
