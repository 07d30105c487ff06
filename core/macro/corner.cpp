#include "core/macro/corner.hpp"

#include <cmath>
#include <limits>

#include "core/macro/alarm.hpp"

namespace ridgeline::macro {

namespace {

using Eigen::Vector2d;

// Below this sine of the turn two moves are tangent.
constexpr double tangent_sine = 1e-9;
// Points closer than this need no move between them [mm].
constexpr double same_point = 1e-7;
// Programmed ends are rounded to 0.001 mm: offset paths that should touch may miss by this [mm].
constexpr double touch = 2e-3;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Vector2d radius_at(const Segment& segment, const Eigen::Vector3d& point) {
  return in_plane(segment.plane, point) - in_plane(segment.plane, segment.centre);
}

Vector2d arc_tangent(const Segment& segment, const Eigen::Vector3d& point) {
  const Vector2d left = left_of(radius_at(segment, point).normalized());
  return segment.counter_clockwise ? left : Vector2d(-left);
}

// The offset path of a move: a line through a point, or a circle.
struct OffsetPath {
  bool is_arc = false;
  Vector2d point;      ///< on the line; centre of the circle
  Vector2d direction;  ///< of the line
  double radius = 0;
};

OffsetPath offset_path(const Segment& segment) {
  if (segment.kind != MoveKind::Arc) {
    const Vector2d direction = start_tangent(segment);
    return {false, in_plane(segment.plane, segment.from) + segment.offset * left_of(direction),
            direction, 0};
  }
  const double radius = radius_at(segment, segment.to).norm();
  const double offset_radius =
      segment.counter_clockwise ? radius - segment.offset : radius + segment.offset;
  if (offset_radius < -touch) raise(AlarmNumber::Interference, "the arc is smaller than the tool");
  return {true, in_plane(segment.plane, segment.centre), {}, std::max(offset_radius, 0.0)};
}

Vector2d line_line(const OffsetPath& a, const OffsetPath& b, const Vector2d& otherwise) {
  const double sine = cross(a.direction, b.direction);
  if (std::abs(sine) < tangent_sine) return otherwise;
  return a.point + cross(b.point - a.point, b.direction) / sine * a.direction;
}

Vector2d nearer(const Vector2d& a, const Vector2d& b, const Vector2d& to) {
  return (a - to).squaredNorm() <= (b - to).squaredNorm() ? a : b;
}

Vector2d line_arc(const OffsetPath& line, const OffsetPath& arc, const Vector2d& corner) {
  const double along = (arc.point - line.point).dot(line.direction);
  const Vector2d foot = line.point + along * line.direction;
  const double distance = (arc.point - foot).norm();
  if (distance > arc.radius + touch) raise(AlarmNumber::NoIntersection, "line and arc");
  const double half = std::sqrt(std::max(0.0, arc.radius * arc.radius - distance * distance));
  return nearer(foot + half * line.direction, foot - half * line.direction, corner);
}

Vector2d arc_arc(const OffsetPath& a, const OffsetPath& b, const Vector2d& corner) {
  const Vector2d between = b.point - a.point;
  const double distance = between.norm();
  if (distance > a.radius + b.radius + touch || distance < std::abs(a.radius - b.radius) - touch ||
      distance == 0) {
    raise(AlarmNumber::NoIntersection, "arc and arc");
  }
  const double along =
      (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
  const double half = std::sqrt(std::max(0.0, a.radius * a.radius - along * along));
  const Vector2d unit = between / distance;
  const Vector2d foot = a.point + along * unit;
  return nearer(foot + half * left_of(unit), foot - half * left_of(unit), corner);
}

Vector2d inside_point(const Segment& first, const Segment& second, const Vector2d& corner,
                      const Vector2d& otherwise) {
  const OffsetPath a = offset_path(first);
  const OffsetPath b = offset_path(second);
  if (!a.is_arc && !b.is_arc) return line_line(a, b, otherwise);
  if (!a.is_arc) return line_arc(a, b, corner);
  if (!b.is_arc) return line_arc(b, a, corner);
  return arc_arc(a, b, corner);
}

}  // namespace

Vector2d start_tangent(const Segment& segment) {
  if (segment.kind == MoveKind::Arc) return arc_tangent(segment, segment.from);
  return (in_plane(segment.plane, segment.to) - in_plane(segment.plane, segment.from)).normalized();
}

Vector2d end_tangent(const Segment& segment) {
  if (segment.kind == MoveKind::Arc) return arc_tangent(segment, segment.to);
  return start_tangent(segment);
}

CornerPath corner_path(const Segment& first, const Segment& second) {
  const Vector2d corner = in_plane(second.plane, second.from);
  const Vector2d t1 = end_tangent(first);
  const Vector2d t2 = start_tangent(second);
  const Vector2d q1 = corner + first.offset * left_of(t1);
  const Vector2d q2 = corner + second.offset * left_of(t2);
  const double sine = cross(t1, t2);
  const double cosine = t1.dot(t2);
  const bool changes = first.offset != second.offset;

  if (std::abs(sine) < tangent_sine && cosine > 0 && !changes) return {q1, {}, q1};
  const bool changes_side = (first.offset > 0) != (second.offset > 0);
  const bool is_inside = sine * second.offset > 0;
  if (changes_side) return {q1, {q2}, q2};
  if (is_inside) {
    const Vector2d meet = inside_point(first, second, corner, q2);
    return {meet, {}, meet};
  }

  CornerPath path{q1, {}, q2};
  std::vector<Vector2d> points;
  if (cosine >= 0) {
    const OffsetPath a{false, q1, t1, 0};
    const OffsetPath b{false, q2, t2, 0};
    points.push_back(line_line(a, b, q2));
  } else {
    points.push_back(q1 + std::abs(first.offset) * t1);
    points.push_back(q2 - std::abs(second.offset) * t2);
  }
  if (first.kind != MoveKind::Arc) {  // a line is longer, an arc ends perpendicular
    path.end = points.front();
    points.erase(points.begin());
  }
  if (second.kind != MoveKind::Arc) {
    path.begin = points.empty() ? path.end : points.back();
  } else if (points.empty() || (points.back() - q2).norm() > same_point) {
    points.push_back(q2);
  }
  for (const Vector2d& point : points) {
    const Vector2d& last = path.extra.empty() ? path.end : path.extra.back();
    if ((point - last).norm() > same_point) path.extra.push_back(point);
  }
  return path;
}

}  // namespace ridgeline::macro
