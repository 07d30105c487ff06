#include "part/meridian.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "part/greatest.hpp"
#include "part/profile_fit.hpp"

namespace ridgeline::part {
namespace {

using units::Curve;
using units::Point;

constexpr double pi = std::numbers::pi;
constexpr double fit_tolerance = 2e-5;  // [mm], of free-form meridians

double radius_of(const Eigen::Vector3d& p) {
  return std::hypot(p.x(), p.y());
}

bool is_about_axis(const Surface& s) {
  return is_same_axis({}, {s.origin, s.axis});
}

/// Every normal meets the axis: a surface of revolution about it.
bool is_revolution(const Face& face) {
  if (face.samples.size() < 9) return false;
  return std::all_of(face.samples.begin(), face.samples.end(), [](const Sample& sample) {
    const double r = radius_of(sample.point);
    const double across =
        sample.normal.y() * sample.point.x() - sample.normal.x() * sample.point.y();
    return std::abs(across) < 1e-5 * std::max(r, 1.0);
  });
}

bool is_turned_face(const Face& face) {
  const Surface& s = face.surface;
  switch (s.kind) {
    case SurfaceKind::Cylinder:
    case SurfaceKind::Cone:
    case SurfaceKind::Torus: return is_about_axis(s);
    case SurfaceKind::Sphere: return radius_of(s.origin) <= same_place;
    case SurfaceKind::Other: return is_revolution(face);
    case SurfaceKind::Plane: return false;
  }
  return false;
}

template <class F>
void for_each_edge(const Face& face, const F& f) {
  for (const std::vector<EdgeUse>& loop : face.loops) {
    for (const EdgeUse& use : loop) f(use.edge);
  }
}

Placed::Extent extent_of(const Placed& part, const Face& face) {
  Placed::Extent all{HUGE_VAL, -HUGE_VAL};
  for_each_edge(face, [&](int edge) {
    const Placed::Extent one = part.extent_along_z(edge);
    all.low = std::min(all.low, one.low);
    all.high = std::max(all.high, one.high);
  });
  return all;
}

void add_straight(const Placed& part, const Face& face, int number, std::vector<Meridian>& found) {
  const Surface& s = face.surface;
  const Placed::Extent e = extent_of(part, face);
  if (!(e.high - e.low > 1e-9)) return;
  const double growth =
      s.kind == SurfaceKind::Cone ? std::tan(s.half_angle) * (s.axis.z() < 0 ? -1 : 1) : 0;
  const auto r = [&](double z) { return s.radius + growth * (z - s.origin.z()); };
  Meridian one;
  one.curve = {.a = {std::max(r(e.low), 0.0), e.low}, .b = {std::max(r(e.high), 0.0), e.high}};
  one.z0 = e.low;
  one.z1 = e.high;
  one.side = face.side > 0 ? 1 : -1;
  one.face = number;
  found.push_back(one);
}

using Angles = std::array<double, 2>;

/// How far an edge that bends about goes beyond its points.
void add_extremes(const Placed& part, int number, const std::vector<double>& angles,
                  const std::function<double(const Eigen::Vector3d&)>& angle_at,
                  std::vector<Angles>& steps) {
  const auto n = angles.size() - 1;
  const auto [least, most] = std::minmax_element(angles.begin(), angles.end());
  if (*most - *least < 1e-9) return;  // a circle about the axis
  for (std::size_t i = 0; i <= n; ++i) {
    const std::size_t before = i == 0 ? i : i - 1;
    const std::size_t after = std::min(i + 1, n);
    for (const double sign : {-1.0, 1.0}) {
      const double here = sign * angles[i];
      if (here < sign * angles[before] || here < sign * angles[after]) continue;
      const auto t = [n](std::size_t k) { return static_cast<double>(k) / static_cast<double>(n); };
      const double beyond = greatest(t(before), t(after), [&](double at) {
        const double angle = angle_at(part.edge_point(number, at));
        return sign * (angles[i] + std::remainder(angle - angles[i], 2 * pi));
      });
      if (beyond <= here) continue;
      steps.push_back({std::min(sign * beyond, angles[i]), std::max(sign * beyond, angles[i])});
    }
  }
}

/// Angles of a tube's circle that a face reaches: its edges run over all of them.
std::vector<Angles> reached(const Placed& part, const Face& face, double R, double zc) {
  const auto angle_at = [&](const Eigen::Vector3d& p) {
    return std::atan2(p.z() - zc, radius_of(p) - R);
  };
  std::vector<Angles> steps;
  for_each_edge(face, [&](int number) {
    const Edge& edge = part.model().edges[static_cast<std::size_t>(number)];
    std::vector<double> angles;
    for (const Eigen::Vector3d& p : edge.points) {
      const double angle = angle_at(p);
      angles.push_back(
          angles.empty() ? angle : angles.back() + std::remainder(angle - angles.back(), 2 * pi));
    }
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
      steps.push_back({std::min(angles[i], angles[i + 1]), std::max(angles[i], angles[i + 1])});
    }
    if (!edge.is_seam && edge.kind != CurveKind::Line) {
      add_extremes(part, number, angles, angle_at, steps);
    }
  });
  for (auto& step : steps) {  // into [-pi/2, 3 pi/2), the order of the halves
    const double turns = std::floor((step[0] + pi / 2 + 1e-9) / (2 * pi));
    for (double& angle : step) angle -= 2 * pi * turns;
  }
  std::sort(steps.begin(), steps.end());
  std::vector<Angles> merged;
  for (const auto& step : steps) {
    if (!merged.empty() && step[0] <= merged.back()[1] + 1e-7) {
      merged.back()[1] = std::max(merged.back()[1], step[1]);
    } else {
      merged.push_back(step);
    }
  }
  return merged;
}

/// A face of a sphere is in one piece and may cover a pole without an edge there: the solid then
/// ends at the sphere.
std::vector<Angles> with_poles(const Placed& part, const Face& face, double R, double zc,
                               const std::vector<Angles>& steps) {
  if (steps.empty()) return {};
  Angles all = steps.front();
  for (const auto& step : steps) all = {std::min(all[0], step[0]), std::max(all[1], step[1])};
  const auto is_covered = [&](double pole) {
    const double shy = 1e-3 * R;
    return part.contains({0, 0, zc + pole * (R - shy)}) == (face.side > 0) &&
           part.contains({0, 0, zc + pole * (R + shy)}) == (face.side < 0);
  };
  if (all[0] > -pi / 2 && is_covered(-1)) all[0] = -pi / 2;
  if (all[1] < pi / 2 && is_covered(1)) all[1] = pi / 2;
  return {all};
}

/// Half `side` of the circle about (R, zc) between two angles.
void add_half(int number, double face_side, const Point& centre, double tube, int side, double v0,
              double v1, std::vector<Meridian>& found) {
  const double from = std::max(v0, side > 0 ? -pi / 2 : pi / 2);
  const double to = std::min(v1, side > 0 ? pi / 2 : 3 * pi / 2);
  if (to - from < 1e-9) return;
  const auto z_at = [&](double v) {
    for (const double pole : {-pi / 2, pi / 2, 3 * pi / 2}) {
      if (std::abs(v - pole) < 1e-7) return centre.z + tube * std::round(std::sin(pole));
    }
    return centre.z + tube * std::sin(v);
  };
  Meridian one;
  one.z0 = std::min(z_at(from), z_at(to));
  one.z1 = std::max(z_at(from), z_at(to));
  one.curve = {.a = centre, .b = {}, .radius = tube, .side = side};
  one.side = face_side * side > 0 ? 1 : -1;
  one.face = number;
  if (one.z1 - one.z0 < 1e-9) return;
  if (units::range(one.curve, one.z0, one.z1).max > 1e-9) found.push_back(one);
}

/// Torus; a sphere is a torus whose circle of centres is a point.
void add_tube(const Placed& part, const Face& face, int number, std::vector<Meridian>& found) {
  const Surface& s = face.surface;
  const bool is_sphere = s.kind == SurfaceKind::Sphere;
  const double tube = is_sphere ? s.radius : s.minor_radius;
  double R = is_sphere ? 0 : s.radius;
  if (!face.samples.empty()) {  // the inner part of a spindle torus shows its circle from behind
    const Eigen::Vector3d& p = face.samples.front().point;
    const double off = std::hypot(radius_of(p) - R, p.z() - s.origin.z()) - tube;
    if (std::abs(off) > 1e-3) R = -R;
  }
  const Point centre{R, s.origin.z()};
  std::vector<Angles> steps = reached(part, face, R, centre.z);
  if (is_sphere) steps = with_poles(part, face, tube, centre.z, steps);
  for (const auto& [v0, v1] : steps) {
    for (const double turn : {0.0, -2 * pi}) {
      add_half(number, face.side, centre, tube, 1, v0 + turn, v1 + turn, found);
      if (R > 0) add_half(number, face.side, centre, tube, -1, v0 + turn, v1 + turn, found);
    }
  }
}

/// Edges by how far they run along the meridian, those that run across it left out: a seam first,
/// or a cut through the axis.
std::vector<int> edges_along(const Placed& part, const Face& face) {
  struct Run {
    double along;
    int edge;
  };
  std::vector<Run> runs;
  for_each_edge(face, [&](int number) {
    const Edge& edge = part.model().edges[static_cast<std::size_t>(number)];
    Run run{0, number};
    for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
      run.along += std::hypot(radius_of(edge.points[i + 1]) - radius_of(edge.points[i]),
                              edge.points[i + 1].z() - edge.points[i].z());
    }
    const auto is_same = [number](const Run& other) { return other.edge == number; };
    if (run.along > same_place && std::ranges::none_of(runs, is_same)) runs.push_back(run);
  });
  std::ranges::stable_sort(runs, std::ranges::greater(), &Run::along);
  std::vector<int> edges;
  edges.reserve(runs.size());
  for (const Run& run : runs) edges.push_back(run.edge);
  return edges;
}

bool is_covered(const Point& p, const std::vector<FittedPiece>& pieces) {
  return std::ranges::any_of(pieces, [&](const FittedPiece& piece) {
    if (p.z < piece.z0 - same_place || p.z > piece.z1 + same_place) return false;
    const double slope = units::slope_at(piece.curve, std::clamp(p.z, piece.z0, piece.z1));
    return std::abs(units::radius_at(piece.curve, p.z) - p.r) < 1e-3 * std::hypot(1, slope);
  });
}

/// Where along an edge, t from `in` to `out`, the pieces end.
double end_of_cover(const std::function<Point(double)>& profile,
                    const std::vector<FittedPiece>& pieces, double in, double out) {
  for (int k = 0; k < 40; ++k) {
    const double middle = std::midpoint(in, out);
    (is_covered(profile(middle), pieces) ? in : out) = middle;
  }
  return out;
}

/// The meridian of a free-form face by its edges: of each after the first what the ones before do
/// not cover, such as the rest beyond a slot that cuts the seam short.
std::vector<FittedPiece> free_profile(const Placed& part, const Face& face) {
  std::vector<FittedPiece> pieces;
  for (const int edge : edges_along(part, face)) {
    const std::function<Point(double)> profile = [&](double t) {
      const Eigen::Vector3d p = part.edge_point(edge, t);
      return Point{radius_of(p), p.z()};
    };
    constexpr int n = 64;
    std::vector<FittedPiece> found;
    const auto t = [](int i) { return static_cast<double>(i) / n; };
    const auto is_open = [&](int i) { return !is_covered(profile(t(i)), pieces); };
    for (int i = 0; i <= n; ++i) {
      if (!is_open(i)) continue;
      int last = i;
      while (last < n && is_open(last + 1)) ++last;
      const double from = i == 0 ? 0 : end_of_cover(profile, pieces, t(i - 1), t(i));
      const double to = last == n ? 1 : end_of_cover(profile, pieces, t(last + 1), t(last));
      const auto run = [&](double x) { return profile(std::lerp(from, to, x)); };
      const std::vector<FittedPiece> more = fitted_along(run, fit_tolerance);
      found.insert(found.end(), more.begin(), more.end());
      i = last;
    }
    pieces.insert(pieces.end(), found.begin(), found.end());
  }
  return pieces;
}

void add_free(const Placed& part, const Face& face, int number, std::vector<Meridian>& found) {
  for (const FittedPiece& piece : free_profile(part, face)) {
    const double z = (piece.z0 + piece.z1) / 2;
    const double r = units::radius_at(piece.curve, z);
    const auto nearest = std::min_element(
        face.samples.begin(), face.samples.end(), [&](const Sample& p, const Sample& q) {
          return std::hypot(radius_of(p.point) - r, p.point.z() - z) <
                 std::hypot(radius_of(q.point) - r, q.point.z() - z);
        });
    const Eigen::Vector3d& at = nearest->point;
    const double outwards =
        (nearest->normal.x() * at.x() + nearest->normal.y() * at.y()) / radius_of(at);
    found.push_back({piece.curve, piece.z0, piece.z1, outwards > 0 ? 1 : -1, number});
  }
}

std::optional<Shoulder> shoulder(const Placed& part, const Face& face, int number) {
  if (face.surface.kind != SurfaceKind::Plane) return std::nullopt;
  if (face.surface.axis.head<2>().norm() > same_direction) return std::nullopt;
  Shoulder found{face.surface.origin.z(), HUGE_VAL, 0, number};
  bool holds_axis = false;
  for_each_edge(face, [&](int e) {
    const Edge& edge = part.model().edges[static_cast<std::size_t>(e)];
    for (std::size_t i = 0; i < edge.points.size(); ++i) {
      const double r = radius_of(edge.points[i]);
      found.r0 = std::min(found.r0, r);
      found.r1 = std::max(found.r1, r);
    }
  });
  // The axis pierces the face when the edges turn about it an odd number of times in all.
  double turned = 0;
  for (const std::vector<EdgeUse>& loop : face.loops) {
    for (const EdgeUse& use : loop) {
      const Edge& edge = part.model().edges[static_cast<std::size_t>(use.edge)];
      for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
        const Eigen::Vector3d& p = edge.points[i];
        const Eigen::Vector3d& q = edge.points[i + 1];
        turned += (use.is_reversed ? -1 : 1) *
                  std::atan2(p.x() * q.y() - p.y() * q.x(), p.x() * q.x() + p.y() * q.y());
      }
    }
  }
  holds_axis = std::abs(turned) > pi;
  if (holds_axis) found.r0 = 0;
  return found;
}

/// Is the face bounded on its outside by circles about the axis alone?
bool is_turned_plane(const Placed& part, const Face& face) {
  const std::vector<EdgeUse>* outer = nullptr;
  double widest = 0;
  for (const std::vector<EdgeUse>& loop : face.loops) {
    for (const EdgeUse& use : loop) {
      for (const Eigen::Vector3d& p :
           part.model().edges[static_cast<std::size_t>(use.edge)].points) {
        if (radius_of(p) <= widest) continue;
        widest = radius_of(p);
        outer = &loop;
      }
    }
  }
  if (outer == nullptr) return false;
  return std::all_of(outer->begin(), outer->end(), [&](const EdgeUse& use) {
    const Edge& edge = part.model().edges[static_cast<std::size_t>(use.edge)];
    return edge.kind != CurveKind::Line &&
           std::all_of(edge.points.begin(), edge.points.end(), [&](const Eigen::Vector3d& p) {
             return std::abs(radius_of(p) - widest) < same_place;
           });
  });
}

}  // namespace

TurnedFaces turned_faces(const Placed& part) {
  const std::vector<Face>& faces = part.model().faces;
  TurnedFaces found;
  for (const Face& face : faces) {
    found.is_coaxial.push_back(is_turned_face(face) ? 1 : 0);
    found.area += face.area;
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Face& face = faces[i];
    const int number = static_cast<int>(i);
    if (found.is_coaxial[i] != 0) {
      found.round_area += face.area;
      switch (face.surface.kind) {
        case SurfaceKind::Cylinder:
        case SurfaceKind::Cone: add_straight(part, face, number, found.meridians); break;
        case SurfaceKind::Sphere:
        case SurfaceKind::Torus: add_tube(part, face, number, found.meridians); break;
        default: add_free(part, face, number, found.meridians);
      }
    } else if (const std::optional<Shoulder> one = shoulder(part, face, number)) {
      found.shoulders.push_back(*one);
      if (is_turned_plane(part, face)) found.plane_area += face.area;
    }
  }
  return found;
}

}  // namespace ridgeline::part
