#include "part/pockets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "part/outline.hpp"

namespace ridgeline::part {
namespace {

constexpr double parallel = 1e-6;  // sine or cosine
constexpr std::array<std::string_view, 6> kinds = {"plane",  "cylinder", "cone",
                                                   "sphere", "torus",    "free-form"};

const Face& face_at(const Placed& part, int number) {
  return part.model().faces[static_cast<std::size_t>(number)];
}

Eigen::Vector3d outward(const Face& plane) {
  return plane.side * plane.surface.axis;
}

/// Faces seen along a direction n out of the pocket: floors across it, walls along it.
struct View {
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();
  std::vector<int> floors;
  std::vector<int> walls;
  double floor_area = 0;
};

std::optional<View> seen_along(const Placed& part, const std::vector<int>& faces,
                               const Eigen::Vector3d& n) {
  View view;
  view.n = n;
  for (const int number : faces) {
    const Face& face = face_at(part, number);
    if (face.surface.kind == SurfaceKind::Plane) {
      const double c = outward(face).dot(n);
      if (c > 1 - parallel) {
        view.floors.push_back(number);
        view.floor_area += face.area;
      } else if (std::abs(c) < parallel) {
        view.walls.push_back(number);
      } else {
        return std::nullopt;
      }
    } else if (face.surface.kind == SurfaceKind::Cylinder &&
               face.surface.axis.cross(n).norm() < parallel) {
      view.walls.push_back(number);
    } else {
      return std::nullopt;
    }
  }
  return view;
}

std::vector<Eigen::Vector3d> directions(const Placed& part, const std::vector<int>& faces) {
  std::vector<Eigen::Vector3d> found;
  std::vector<Eigen::Vector3d> normals;
  for (const int number : faces) {
    const Face& face = face_at(part, number);
    if (face.surface.kind == SurfaceKind::Plane) {
      found.push_back(outward(face));
      normals.push_back(outward(face));
    } else if (face.surface.kind == SurfaceKind::Cylinder) {
      found.push_back(face.surface.axis);
      found.push_back(-face.surface.axis);
    }
  }
  for (std::size_t i = 1; i < normals.size(); ++i) {
    const Eigen::Vector3d d = normals[0].cross(normals[i]);
    if (d.norm() < 1e-3) continue;
    found.push_back(d.normalized());
    found.push_back(-d.normalized());
  }
  return found;
}

std::vector<Eigen::Vector3d> points_of(const Placed& part, const std::vector<int>& faces) {
  std::vector<Eigen::Vector3d> points;
  for (const int number : faces) {
    for (const std::vector<EdgeUse>& loop : face_at(part, number).loops) {
      for (const EdgeUse& use : loop) {
        const Edge& edge = part.model().edges[static_cast<std::size_t>(use.edge)];
        points.insert(points.end(), edge.points.begin(), edge.points.end());
      }
    }
  }
  return points;
}

/// How well a view fits: a bottom first, then the way to the outside.
double merit(const Placed& part, const View& view, const std::vector<int>& faces) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const std::vector<Eigen::Vector3d> points = points_of(part, faces);
  for (const Eigen::Vector3d& p : points) middle += p;
  middle /= static_cast<double>(points.size());
  const Eigen::Vector3d radial(middle.x(), middle.y(), 0);
  const double outwards = radial.norm() > 1e-9 ? view.n.dot(radial.normalized()) : 0;
  return view.floor_area > 0 ? view.floor_area + 1e-6 * outwards : -2 + outwards;
}

struct Reach {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  double length() const { return high - low; }
};

Reach reach(const Placed& part, const std::vector<int>& faces, const Eigen::Vector3d& d) {
  Reach found;
  for (const int number : faces) {
    for (const std::vector<EdgeUse>& loop : face_at(part, number).loops) {
      for (const EdgeUse& use : loop) {
        const Placed::Extent e = part.extent(use.edge, d);
        found.low = std::min(found.low, e.low);
        found.high = std::max(found.high, e.high);
      }
    }
  }
  return found;
}

/// Two walls that face each other across the pocket.
struct Gap {
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  double width = 0;
};
std::optional<Gap> narrowest_gap(const Placed& part, const View& view) {
  std::optional<Gap> found;
  for (const int i : view.walls) {
    for (const int j : view.walls) {
      const Face& p = face_at(part, i);
      const Face& q = face_at(part, j);
      if (p.surface.kind != SurfaceKind::Plane || q.surface.kind != SurfaceKind::Plane) continue;
      if (outward(p).dot(outward(q)) > -1 + parallel) continue;
      const double width = (q.surface.origin - p.surface.origin).dot(outward(p));
      if (width <= 1e-6 || (found && width >= found->width)) continue;
      found = Gap{outward(p), width};
    }
  }
  return found;
}

/// Depth of the removed material above the bottom: as far as the envelope reaches along n.
double depth_above(const Placed& part, const Envelope& envelope, const View& view,
                   const std::vector<int>& faces, double bottom) {
  std::vector<Eigen::Vector3d> points;
  const std::vector<int>& base = view.floors.empty() ? faces : view.floors;
  for (Eigen::Vector3d p : points_of(part, base)) {
    p -= (p.dot(view.n) - bottom) * view.n;
    points.push_back(p);
  }
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) middle += p;
  middle /= static_cast<double>(points.size());
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (const double t : {0.001, 0.5}) points.push_back(points[i] + t * (middle - points[i]));
  }
  points.push_back(middle);
  const double far = 2 * (part.model().high - part.model().low).norm();
  double depth = 0;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d above = p + 1e-6 * view.n;
    if (!envelope.is_inside(above, 0)) continue;
    depth = std::max(depth, 1e-6 + envelope.distance_to_end(above, view.n, far));
  }
  return depth;
}

std::string form_of(const View& view, const std::optional<Gap>& gap, int round_walls) {
  const std::size_t flat_walls = view.walls.size() - static_cast<std::size_t>(round_walls);
  if (gap && flat_walls == 2) return "slot";
  if (flat_walls >= 3 || round_walls > 0) return "pocket";
  return view.walls.empty() ? "flat" : "step";
}

std::string refusal(const Placed& part, const std::vector<int>& faces) {
  std::array<int, kinds.size()> count{};
  for (const int number : faces) {
    ++count[static_cast<std::size_t>(face_at(part, number).surface.kind)];
  }
  std::string text = "its " + std::to_string(faces.size()) + " faces (";
  bool is_first = true;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (count[i] == 0) continue;
    text += (is_first ? "" : ", ") + std::to_string(count[i]) + " " + std::string(kinds[i]);
    is_first = false;
  }
  return text + ") have no common direction that a mill could follow";
}

}  // namespace

Pocket pocket_of(const Placed& part, const Envelope& envelope, const std::vector<int>& faces) {
  std::optional<View> best;
  double most = -HUGE_VAL;
  for (const Eigen::Vector3d& n : directions(part, faces)) {
    const std::optional<View> view = seen_along(part, faces, n);
    if (!view) continue;
    const double merit_here = merit(part, *view, faces);
    if (merit_here <= most) continue;
    most = merit_here;
    best = view;
  }
  if (!best) return {std::nullopt, refusal(part, faces)};

  units::MilledFace found;
  const Eigen::Vector3d n = best->n;
  found.normal = n;
  const Reach along = reach(part, best->floors.empty() ? faces : best->floors, n);
  const double bottom = along.low;
  int round_walls = 0;
  for (const int wall : best->walls) {
    const Face& face = face_at(part, wall);
    if (face.surface.kind != SurfaceKind::Cylinder || face.side > 0) continue;
    ++round_walls;
    found.corner_radius = found.corner_radius > 0
                              ? std::min(found.corner_radius, face.surface.radius)
                              : face.surface.radius;
  }
  const std::optional<Gap> gap = narrowest_gap(part, *best);
  found.form = form_of(*best, gap, round_walls);
  if (gap) {
    found.width = gap->width;
    found.length = reach(part, faces, n.cross(gap->across).normalized()).length();
    if (found.length < found.width && found.form == "pocket") std::swap(found.length, found.width);
  }
  found.depth = depth_above(part, envelope, *best, faces, bottom);
  found.outline = best->floors.empty() ? through_outline(part, faces, n, bottom)
                                       : floor_outline(part, best->floors, n, bottom);
  const std::vector<Eigen::Vector3d> corners =
      points_of(part, best->floors.empty() ? faces : best->floors);
  found.point = Eigen::Vector3d::Zero();
  found.z0 = HUGE_VAL;
  found.z1 = -HUGE_VAL;
  for (Eigen::Vector3d p : corners) {
    p -= (p.dot(n) - bottom) * n;
    found.point += p / static_cast<double>(corners.size());
    found.z0 = std::min(found.z0, p.z());
    found.z1 = std::max(found.z1, p.z());
  }
  return {found, {}};
}

}  // namespace ridgeline::part
