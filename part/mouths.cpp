#include "part/mouths.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace ridgeline::part {
namespace {

using Eigen::Vector3d;

constexpr double smooth = 4 * std::numbers::pi / 180;  // [rad]: an edge that is none
constexpr double same_radius = 1e-4;                   // [mm]
constexpr double parallel = 1e-5;                      // [rad]

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// Faces that are one surface, as the number of the first of them.
std::vector<int> classes_of(const Model& model) {
  std::vector<int> classes(model.faces.size());
  std::iota(classes.begin(), classes.end(), 0);
  for (std::size_t i = 0; i < model.faces.size(); ++i) {
    const Face& a = model.faces[i];
    if (a.surface.kind != SurfaceKind::Cylinder && a.surface.kind != SurfaceKind::Cone) continue;
    for (std::size_t j = 0; j < i; ++j) {
      const Face& b = model.faces[j];
      const bool is_same =
          b.surface.kind == a.surface.kind && b.side * a.side > 0 &&
          std::abs(b.surface.radius - a.surface.radius) < same_radius &&
          std::abs(b.surface.half_angle - a.surface.half_angle) < parallel &&
          is_same_axis({a.surface.origin, a.surface.axis}, {b.surface.origin, b.surface.axis});
      if (!is_same) continue;
      classes[i] = classes[j];
      break;
    }
  }
  return classes;
}

/// A sharp convex edge between a round wall and something else.
struct Rim {
  int edge = 0;
  int neighbour = 0;  ///< class
};

bool is_across(const Surface& plane, const Surface& wall) {
  return plane.kind == SurfaceKind::Plane && plane.axis.cross(wall.axis).norm() < parallel;
}

bool is_coaxial(const Surface& a, const Surface& wall) {
  if (a.kind == SurfaceKind::Plane || a.kind == SurfaceKind::Other) return false;
  if (a.kind == SurfaceKind::Sphere) {
    return (a.origin - wall.origin).cross(wall.axis).norm() < same_place;
  }
  return is_same_axis({a.origin, a.axis}, {wall.origin, wall.axis});
}

std::vector<Rim> rims_of(const Model& model, const std::vector<int>& classes, int wall) {
  std::vector<Rim> rims;
  for (std::size_t e = 0; e < model.edges.size(); ++e) {
    const Edge& edge = model.edges[e];
    if (edge.faces.size() != 2 || edge.is_seam) continue;
    const int a = classes[index(edge.faces[0])];
    const int b = classes[index(edge.faces[1])];
    if (a == b || (a != wall && b != wall)) continue;
    if (!edge.is_convex || edge.angle < smooth) continue;
    const int other = a == wall ? b : a;
    const Surface& surface = model.faces[index(other)].surface;
    const Surface& base = model.faces[index(wall)].surface;
    if (is_coaxial(surface, base)) continue;
    rims.push_back({static_cast<int>(e), other});
  }
  return rims;
}

/// Rims that share vertices.
std::vector<std::vector<Rim>> chains_of(const Model& model, std::vector<Rim> rims) {
  std::vector<std::vector<Rim>> chains;
  while (!rims.empty()) {
    std::vector<Rim> chain{rims.back()};
    rims.pop_back();
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const Edge& edge = model.edges[index(chain[i].edge)];
      for (auto next = rims.begin(); next != rims.end();) {
        const Edge& other = model.edges[index(next->edge)];
        const bool meets = std::ranges::any_of(edge.vertices, [&](int v) {
          return v >= 0 && (v == other.vertices[0] || v == other.vertices[1]);
        });
        if (!meets) {
          ++next;
          continue;
        }
        chain.push_back(*next);
        next = rims.erase(next);
      }
    }
    chains.push_back(std::move(chain));
  }
  return chains;
}

bool is_closed(const Model& model, const std::vector<Rim>& chain, bool& crosses) {
  std::map<int, int> degree;
  for (const Rim& rim : chain) {
    const Edge& edge = model.edges[index(rim.edge)];
    if (edge.vertices[0] == edge.vertices[1]) continue;
    for (const int v : edge.vertices) ++degree[v];
  }
  crosses = std::ranges::any_of(degree, [](const auto& one) { return one.second > 2; });
  return std::ranges::all_of(degree, [](const auto& one) { return one.second % 2 == 0; });
}

Vector3d middle_of(const Model& model, const std::vector<Rim>& chain) {
  Vector3d low = Vector3d::Constant(HUGE_VAL);
  Vector3d high = -low;
  for (const Rim& rim : chain) {
    for (const Vector3d& p : model.edges[index(rim.edge)].points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  return (low + high) / 2;
}

/// Where the axis of the hole is nearest to that of the wall.
void place(Mouth& mouth, const Vector3d& on_hole, const Vector3d& direction,
           const Vector3d& middle) {
  const Vector3d u = mouth.wall.direction;
  const Vector3d d = direction.normalized();
  const Vector3d n = u.cross(d);
  mouth.angle = std::atan2(n.norm(), std::abs(u.dot(d)));
  const Vector3d w = on_hole - mouth.wall.point;
  const double b = u.dot(d);
  const double t = n.squaredNorm() < 1e-12 ? 0 : (b * u.dot(w) - d.dot(w)) / n.squaredNorm();
  mouth.point = on_hole + t * d;
  mouth.eccentricity = n.norm() < 1e-6 ? 0 : std::abs(w.dot(n)) / n.norm();
  mouth.out = (middle - mouth.point).dot(d) < 0 ? Vector3d(-d) : d;
}

using Neighbours = std::vector<const Face*>;

Neighbours of_kind(const Neighbours& all, SurfaceKind kind) {
  Neighbours found;
  std::ranges::copy_if(all, std::back_inserter(found),
                       [&](const Face* face) { return face->surface.kind == kind; });
  return found;
}

bool are_equal_parallel(const Neighbours& cylinders) {
  return std::ranges::all_of(cylinders, [&](const Face* face) {
    return std::abs(face->surface.radius - cylinders[0]->surface.radius) < same_radius &&
           face->surface.axis.cross(cylinders[0]->surface.axis).norm() < parallel;
  });
}

/// Slot (2 corners) and rounded rectangle (4): extents between the corner axes, square to them.
void measure_corners(Mouth& mouth, const Neighbours& corners, const Vector3d& middle) {
  const Vector3d d = corners[0]->surface.axis;
  Vector3d centre = Vector3d::Zero();
  for (const Face* face : corners) centre += face->surface.origin - face->surface.origin.dot(d) * d;
  centre /= static_cast<double>(corners.size());
  Vector3d far = Vector3d::Zero();
  std::vector<Vector3d> from_centre;
  for (const Face* face : corners) {
    from_centre.push_back(face->surface.origin - face->surface.origin.dot(d) * d - centre);
  }
  const double r = corners[0]->surface.radius;
  mouth.radius = r;
  if (corners.size() == 2) {
    far = from_centre[0];
    mouth.length = 2 * far.norm() + 2 * r;
    mouth.width = 2 * r;
  } else {
    const Vector3d first = from_centre.front();
    std::ranges::sort(from_centre, {}, [&first](const Vector3d& v) { return (v - first).norm(); });
    const Vector3d side_a = from_centre[1] - from_centre[0];
    const Vector3d side_b = from_centre[2] - from_centre[0];
    far = side_a.norm() > side_b.norm() ? side_a : side_b;
    mouth.length = std::max(side_a.norm(), side_b.norm()) + 2 * r;
    mouth.width = std::min(side_a.norm(), side_b.norm()) + 2 * r;
  }
  place(mouth, centre, d, middle);
  const Vector3d along = (mouth.wall.direction - mouth.wall.direction.dot(d) * d).normalized();
  mouth.skew = std::atan2(along.cross(far).norm(), std::abs(along.dot(far)));
}

Mouth classified(const Model& model, int wall, const std::vector<Rim>& chain) {
  const Face& base = model.faces[index(wall)];
  Mouth mouth;
  mouth.wall = {base.surface.origin, base.surface.axis};
  mouth.wall_radius = base.surface.radius;
  mouth.is_bore = base.side < 0;
  std::set<int> numbers;
  for (const Rim& rim : chain) numbers.insert(rim.neighbour);
  Neighbours all;
  for (const int i : numbers) all.push_back(&model.faces[index(i)]);
  const Neighbours cylinders = of_kind(all, SurfaceKind::Cylinder);
  const Neighbours planes = of_kind(all, SurfaceKind::Plane);
  const Neighbours cones = of_kind(all, SurfaceKind::Cone);
  const Vector3d middle = middle_of(model, chain);
  mouth.point = middle;
  bool crosses = false;
  if (!is_closed(model, chain, crosses)) {
    mouth.why = "its edge is not closed on one round wall";
  } else if (cylinders.size() == 1 && all.size() == 1) {
    const Surface& hole = cylinders[0]->surface;
    mouth.radius = hole.radius;
    place(mouth, hole.origin, hole.axis, middle);
    mouth.kind = Mouth::Kind::Round;
    if (crosses || std::abs(hole.radius - mouth.wall_radius) < same_radius) {
      mouth.kind = Mouth::Kind::EqualDiameters;
      mouth.why = "hole and wall have equal diameters: their edge has corners";
    }
  } else if (cones.size() == 1 && all.size() == 1) {
    mouth.radius = cones[0]->surface.radius;
    place(mouth, cones[0]->surface.origin, cones[0]->surface.axis, middle);
    mouth.kind = Mouth::Kind::Countersunk;
    mouth.why = "it is countersunk: a cone meets the wall";
  } else if (planes.size() == 2 && cylinders.size() == 2 && all.size() == 4 &&
             are_equal_parallel(cylinders)) {
    mouth.kind = Mouth::Kind::Slot;
    measure_corners(mouth, cylinders, middle);
  } else if (planes.size() == 4 && cylinders.size() == 4 && all.size() == 8 &&
             are_equal_parallel(cylinders)) {
    mouth.kind = Mouth::Kind::RoundedRectangle;
    measure_corners(mouth, cylinders, middle);
  } else if (planes.size() == 4 && all.size() == 4) {
    mouth.kind = Mouth::Kind::Rectangle;
    mouth.why = "a rectangle without round corners is no hole shape of the library";
  } else {
    mouth.why = "its edge runs over " + std::to_string(all.size()) + " surfaces (" +
                std::to_string(planes.size()) + " plane, " + std::to_string(cylinders.size()) +
                " round, " + std::to_string(cones.size()) + " cones)";
  }
  return mouth;
}

/// Every edge of two cylinders is seen from both: the narrower one is the hole.
bool is_seen_from_hole(const Model& model, int wall, const std::vector<Rim>& chain) {
  return std::ranges::any_of(chain, [&](const Rim& rim) {
    const Surface& other = model.faces[index(rim.neighbour)].surface;
    const double wider = other.radius - model.faces[index(wall)].surface.radius;
    const bool is_later = rim.neighbour > wall;  // of two equal ones
    return other.kind == SurfaceKind::Cylinder &&
           (wider > same_radius || (wider > -same_radius && is_later));
  });
}

}  // namespace

std::vector<Mouth> mouths_of(const Model& model) {
  const std::vector<int> classes = classes_of(model);
  std::vector<Mouth> mouths;
  for (std::size_t i = 0; i < model.faces.size(); ++i) {
    const int wall = static_cast<int>(i);
    if (classes[i] != wall || model.faces[i].surface.kind != SurfaceKind::Cylinder) continue;
    for (const std::vector<Rim>& chain : chains_of(model, rims_of(model, classes, wall))) {
      const bool is_end = std::ranges::all_of(chain, [&](const Rim& rim) {
        return is_across(model.faces[index(rim.neighbour)].surface, model.faces[i].surface);
      });
      if (!is_end && !is_seen_from_hole(model, wall, chain)) {
        mouths.push_back(classified(model, wall, chain));
      }
    }
  }
  return mouths;
}

std::string name(Mouth::Kind kind) {
  switch (kind) {
    case Mouth::Kind::Round: return "round";
    case Mouth::Kind::Slot: return "slot";
    case Mouth::Kind::RoundedRectangle: return "rounded_rectangle";
    case Mouth::Kind::Rectangle: return "rectangle";
    case Mouth::Kind::Countersunk: return "countersunk";
    case Mouth::Kind::EqualDiameters: return "equal_diameters";
    case Mouth::Kind::Mixed: return "mixed";
  }
  return "mixed";
}

}  // namespace ridgeline::part
