#include "part/bores.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace ridgeline::part {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double full = 2 * pi - 1e-3;  // [rad]
constexpr double same_radius = 1e-4;    // [mm]
constexpr double point = 1e-3;          // [mm]: a cone ends in a point
constexpr double along_z = 1 - 1e-9;    // cosine

const Face& face_at(const Placed& part, int number) {
  return part.model().faces[static_cast<std::size_t>(number)];
}

bool is_round_wall(const Face& face) {
  return face.side < 0 &&
         (face.surface.kind == SurfaceKind::Cylinder || face.surface.kind == SurfaceKind::Cone);
}

template <class F>
void for_each_edge(const Face& face, const F& f) {
  for (const std::vector<EdgeUse>& loop : face.loops)
    for (const EdgeUse& use : loop) f(use.edge);
}

/// A stretch of wall along the axis, t measured from the axis point.
struct Stretch {
  double t0 = 0, t1 = 0;
  double r0 = 0, r1 = 0;  ///< at t0 and t1
};

/// All walls about one axis.
struct Group {
  Axis axis;
  std::vector<int> walls;
  std::vector<int> planes;
  std::vector<Stretch> stretches;  ///< ascending in t
  bool closed_low = false;         ///< a bottom ends it at its least t
  bool closed_high = false;
};

std::vector<Group> groups_of(const Placed& part, const std::vector<int>& faces) {
  std::vector<Group> groups;
  for (const int number : faces) {
    const Face& face = face_at(part, number);
    if (!is_round_wall(face)) continue;
    const Axis axis{face.surface.origin, face.surface.axis};
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return is_same_axis(group.axis, axis);
    });
    if (same != groups.end())
      same->walls.push_back(number);
    else
      groups.push_back({.axis = axis, .walls = {number}, .planes = {}, .stretches = {}});
  }
  return groups;
}

/// Do the walls close round the axis somewhere?
bool is_closed_round(const Placed& part, const Group& group) {
  for (const int wall : group.walls) {
    const Face& face = face_at(part, wall);
    double sweep = 0;
    for (const int other : group.walls) {
      const Face& second = face_at(part, other);
      if (second.surface.kind == face.surface.kind &&
          std::abs(second.surface.radius - face.surface.radius) < same_radius)
        sweep += second.sweep;
    }
    if (sweep > full) return true;
  }
  return false;
}

double radius_at(const Surface& surface, const Axis& axis, double t) {
  if (surface.kind == SurfaceKind::Cylinder) return surface.radius;
  const double from = (axis.point + t * axis.direction - surface.origin).dot(surface.axis);
  return std::max(0.0, surface.radius + std::tan(surface.half_angle) * from);
}

void add_stretches(const Placed& part, Group& group) {
  for (const int wall : group.walls) {
    const Face& face = face_at(part, wall);
    Stretch one{HUGE_VAL, -HUGE_VAL};
    for_each_edge(face, [&](int edge) {
      const Placed::Extent extent = part.extent(edge, group.axis.direction);
      const double origin = group.axis.point.dot(group.axis.direction);
      one.t0 = std::min(one.t0, extent.low - origin);
      one.t1 = std::max(one.t1, extent.high - origin);
    });
    one.r0 = radius_at(face.surface, group.axis, one.t0);
    one.r1 = radius_at(face.surface, group.axis, one.t1);
    const auto same =
        std::find_if(group.stretches.begin(), group.stretches.end(), [&](const Stretch& other) {
          return std::abs(other.r0 - other.r1) < same_radius &&
                 std::abs(one.r0 - one.r1) < same_radius &&
                 std::abs(other.r0 - one.r0) < same_radius;
        });
    if (same != group.stretches.end()) {
      same->t0 = std::min(same->t0, one.t0);
      same->t1 = std::max(same->t1, one.t1);
    } else {
      group.stretches.push_back(one);
    }
  }
  std::sort(group.stretches.begin(), group.stretches.end(),
            [](const Stretch& p, const Stretch& q) { return p.t0 + p.t1 < q.t0 + q.t1; });
}

/// Planes across the axis that touch a wall: bottoms and steps.
void add_planes(const Placed& part, const std::vector<int>& faces, Group& group) {
  const Stretch& low = group.stretches.front();
  const Stretch& high = group.stretches.back();
  for (const int number : faces) {
    const Face& face = face_at(part, number);
    if (face.surface.kind != SurfaceKind::Plane) continue;
    if (face.surface.axis.cross(group.axis.direction).norm() > same_direction) continue;
    bool touches = false;
    double widest = 0;
    for_each_edge(face, [&](int edge) {
      const Edge& e = part.model().edges[static_cast<std::size_t>(edge)];
      for (const int other : e.faces)
        touches |= std::find(group.walls.begin(), group.walls.end(), other) != group.walls.end();
      for (const Eigen::Vector3d& p : e.points) {
        const Eigen::Vector3d d = p - group.axis.point;
        widest = std::max(widest, (d - d.dot(group.axis.direction) * group.axis.direction).norm());
      }
    });
    double reach = 0;
    for (const Stretch& one : group.stretches) reach = std::max({reach, one.r0, one.r1});
    if (!touches || widest > reach + same_radius) continue;
    group.planes.push_back(number);
    const double t = (face.surface.origin - group.axis.point).dot(group.axis.direction);
    if (std::abs(t - low.t0) < same_radius) group.closed_low = true;
    if (std::abs(t - high.t1) < same_radius) group.closed_high = true;
  }
  if (low.r0 < point) group.closed_low = true;
  if (high.r1 < point) group.closed_high = true;
}

/// A step that leaves the middle open closes nothing: a counterbore seen from its far end.
void open_steps(const Placed& part, Group& group) {
  const auto ends_in_air = [&](double t) {
    return !part.contains(group.axis.point + t * group.axis.direction);
  };
  const double beyond = 1e-3;
  if (group.closed_low && ends_in_air(group.stretches.front().t0 - beyond) &&
      group.stretches.front().r0 > point)
    group.closed_low = false;
  if (group.closed_high && ends_in_air(group.stretches.back().t1 + beyond) &&
      group.stretches.back().r1 > point)
    group.closed_high = false;
}

/// Turns the group round so that t runs the way the drill goes.
void direct(Group& group) {
  bool reverse = false;
  if (group.closed_low != group.closed_high) {
    reverse = group.closed_low;
  } else {
    const Eigen::Vector3d& d = group.axis.direction;
    const Eigen::Vector3d low = group.axis.point + group.stretches.front().t0 * d;
    const Eigen::Vector3d high = group.axis.point + group.stretches.back().t1 * d;
    if (std::abs(d.z()) > along_z)
      reverse = d.z() < 0;  // through along Z: from the front
    else
      reverse = high.head<2>().norm() > low.head<2>().norm() + same_radius;  // from outside
  }
  if (!reverse) return;
  group.axis.direction = -group.axis.direction;
  std::swap(group.closed_low, group.closed_high);
  std::reverse(group.stretches.begin(), group.stretches.end());
  for (Stretch& one : group.stretches) one = {-one.t1, -one.t0, one.r1, one.r0};
}

/// Where the axis enters the envelope at the mouth; the mouth itself where that lies deeper.
double start_of(const Envelope& envelope, const Group& group) {
  const double outer = group.stretches.front().t0;
  const double inner = group.stretches.back().t1;
  const auto at = [&](double t) -> Eigen::Vector3d {
    return group.axis.point + t * group.axis.direction;
  };
  const auto is_in = [&](double t) { return envelope.is_inside(at(t), 0); };
  const double margin = 2 * std::max(group.stretches.front().r0, 1.0);
  double outside = outer - margin;
  if (is_in(outside)) return outer;
  constexpr int steps = 400;
  double inside = outside;
  for (int i = 1; i <= steps; ++i) {
    const double t = std::lerp(outer - margin, inner, static_cast<double>(i) / steps);
    if (is_in(t)) {
      inside = t;
      break;
    }
    outside = t;
  }
  if (inside <= outside) return outer;
  for (int k = 0; k < 60; ++k) {
    const double middle = std::midpoint(outside, inside);
    (is_in(middle) ? inside : outside) = middle;
  }
  return inside;
}

units::Hole hole_of(const Envelope& envelope, const Group& group) {
  units::Hole hole;
  const double start = start_of(envelope, group);
  hole.start = group.axis.point + start * group.axis.direction;
  hole.direction = group.axis.direction;
  const Stretch& last = group.stretches.back();
  const bool has_cone = group.closed_high && last.r0 - last.r1 > same_radius && last.r1 < point;
  hole.bottom = has_cone            ? units::HoleBottom::Cone
                : group.closed_high ? units::HoleBottom::Flat
                                    : units::HoleBottom::Through;
  if (has_cone) hole.point_angle = 2 * std::atan2(last.r0 - last.r1, last.t1 - last.t0);
  double narrowest = HUGE_VAL;
  double end = last.t0;
  const std::size_t count = group.stretches.size() - (has_cone ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    const Stretch& one = group.stretches[i];
    const double from = i == 0 ? start : one.t0;
    hole.steps.push_back({2 * one.r0, 2 * one.r1, one.t1 - from});
    narrowest = std::min({narrowest, one.r0, one.r1});
    end = std::max(i == 0 ? one.t1 : end, one.t1);
  }
  if (count == 0) {  // nothing but a cone: a centre mark
    narrowest = last.r0;
    end = last.t0;
  }
  hole.diameter = 2 * narrowest;
  hole.depth = end - start;
  return hole;
}

}  // namespace

std::vector<Bore> bores_of(const Placed& part, const Envelope& envelope,
                           const std::vector<int>& faces) {
  std::vector<Bore> bores;
  for (Group& group : groups_of(part, faces)) {
    if (!is_closed_round(part, group)) continue;
    add_stretches(part, group);
    add_planes(part, faces, group);
    open_steps(part, group);
    direct(group);
    Bore bore;
    bore.hole = hole_of(envelope, group);
    bore.faces = group.walls;
    bore.faces.insert(bore.faces.end(), group.planes.begin(), group.planes.end());
    bores.push_back(std::move(bore));
  }
  return bores;
}

}  // namespace ridgeline::part
