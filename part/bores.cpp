#include "part/bores.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
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
  for (const std::vector<EdgeUse>& loop : face.loops) {
    for (const EdgeUse& use : loop) f(use.edge);
  }
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
    if (same != groups.end()) {
      same->walls.push_back(number);
    } else {
      groups.push_back({.axis = axis, .walls = {number}, .planes = {}, .stretches = {}});
    }
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
          std::abs(second.surface.radius - face.surface.radius) < same_radius) {
        sweep += second.sweep;
      }
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
      for (const int other : e.faces) {
        touches |= std::find(group.walls.begin(), group.walls.end(), other) != group.walls.end();
      }
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
      group.stretches.front().r0 > point) {
    group.closed_low = false;
  }
  if (group.closed_high && ends_in_air(group.stretches.back().t1 + beyond) &&
      group.stretches.back().r1 > point) {
    group.closed_high = false;
  }
}

/// Does the product, turned, stand in the way of a drill along Z, beyond the air before its mouth?
bool is_blocked_along_z(const Envelope& envelope, const Eigen::Vector3d& mouth, double R,
                        double sense) {
  const double r = mouth.head<2>().norm();
  const double beside = R - same_radius;
  std::vector<std::array<double, 2>> met;  // along the way out
  for (const units::Cell& cell : envelope.shadow().cells) {
    if (units::range(cell.inner, cell.z0, cell.z1).min > r + beside ||
        units::range(cell.outer, cell.z0, cell.z1).max < r - beside) {
      continue;
    }
    const double a = sense * (cell.z0 - mouth.z()), b = sense * (cell.z1 - mouth.z());
    met.push_back({std::min(a, b), std::max(a, b)});
  }
  std::sort(met.begin(), met.end());
  double end = same_radius;  // of the material about the mouth, such as a pocket's
  for (const auto& [from, to] : met) {
    if (to <= end) continue;
    if (from > end) return true;
    end = to + same_radius;
  }
  return false;
}

/// The same for any direction, by places on the axis: a bore's other wall is met.
bool is_blocked(const Envelope& envelope, const Eigen::Vector3d& mouth, double R,
                const Eigen::Vector3d& outwards) {
  if (std::abs(outwards.z()) > along_z) {
    return is_blocked_along_z(envelope, mouth, R, outwards.z() > 0 ? 1 : -1);
  }
  constexpr int steps = 400;
  const units::Box box = units::box(envelope.shadow());
  const double far = 2 * box.r1 + box.z1 - box.z0;
  bool has_left = false;
  for (int i = 1; i <= steps; ++i) {
    const bool is_in = envelope.is_inside(mouth + far * i / steps * outwards, 0);
    if (is_in && has_left) return true;
    has_left |= !is_in;
  }
  return false;
}

void turn_round(Group& group) {
  group.axis.direction = -group.axis.direction;
  std::swap(group.closed_low, group.closed_high);
  std::reverse(group.stretches.begin(), group.stretches.end());
  for (Stretch& one : group.stretches) one = {-one.t1, -one.t0, one.r1, one.r0};
}

/// Can the mouth at the least t be reached from outside?
bool is_open(const Envelope& envelope, const Group& group) {
  const Stretch& first = group.stretches.front();
  const Eigen::Vector3d mouth = group.axis.point + first.t0 * group.axis.direction;
  return !is_blocked(envelope, mouth, first.r0, -group.axis.direction);
}

/// Do the stretches follow each other and nowhere widen along t? Then a drill makes them.
bool narrows(const Group& group) {
  double end = -HUGE_VAL;
  double r = HUGE_VAL;
  for (const Stretch& one : group.stretches) {
    if (one.t0 < end - same_radius || one.r0 > r + same_radius || one.r1 > one.r0 + same_radius) {
      return false;
    }
    end = one.t1;
    r = one.r1;
  }
  return true;
}

/// Turns the group round so that t runs the way the drill goes: into a blind hole, from the wider
/// end, from the front, from outside; but not from an end that cannot be reached.
void direct(const Envelope& envelope, Group& group) {
  if (group.closed_low != group.closed_high) {
    if (group.closed_low) turn_round(group);
    return;
  }
  const Eigen::Vector3d& d = group.axis.direction;
  const Eigen::Vector3d low = group.axis.point + group.stretches.front().t0 * d;
  const Eigen::Vector3d high = group.axis.point + group.stretches.back().t1 * d;
  const bool is_along_z = std::abs(d.z()) > along_z;
  if (is_along_z ? d.z() < 0 : high.head<2>().norm() > low.head<2>().norm() + same_radius) {
    turn_round(group);
  }
  Group other = group;
  turn_round(other);
  const bool is_wider_behind = narrows(other) && !narrows(group);
  const bool must_ask = is_along_z || is_wider_behind;
  if (!must_ask || !is_open(envelope, other)) return;
  if (is_wider_behind || !is_open(envelope, group)) group = std::move(other);
}

/// Of a through hole that widens again behind its narrowest stretch, that part, from its own end.
std::optional<Group> taken_from_behind(const Envelope& envelope, Group& group) {
  if (group.closed_high || narrows(group)) return std::nullopt;
  double narrowest = HUGE_VAL;
  for (const Stretch& one : group.stretches) narrowest = std::min({narrowest, one.r0, one.r1});
  std::size_t count = group.stretches.size();
  while (std::min(group.stretches[count - 1].r0, group.stretches[count - 1].r1) >
             narrowest + same_radius ||
         group.stretches[count - 1].r1 > group.stretches[count - 1].r0 + same_radius) {
    if (--count == 0) return std::nullopt;
  }
  Group front = group;
  Group behind = group;
  front.stretches.resize(count);
  behind.stretches.erase(behind.stretches.begin(),
                         behind.stretches.begin() + static_cast<std::ptrdiff_t>(count));
  if (behind.stretches.empty()) return std::nullopt;
  turn_round(behind);
  behind.closed_high = true;  // by the narrower hole
  behind.walls.clear();
  behind.planes.clear();
  if (!narrows(front) || !narrows(behind) || !is_open(envelope, behind)) return std::nullopt;
  group = std::move(front);
  return behind;
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
    direct(envelope, group);
    const auto add = [&](const Group& one) {
      Bore bore{hole_of(envelope, one), one.walls};
      bore.faces.insert(bore.faces.end(), one.planes.begin(), one.planes.end());
      bores.push_back(std::move(bore));
    };
    const std::optional<Group> behind = taken_from_behind(envelope, group);
    add(group);
    if (behind) add(*behind);
  }
  return bores;
}

}  // namespace ridgeline::part
