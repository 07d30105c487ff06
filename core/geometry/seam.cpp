// The seams of Solid: which faces meet where, and their curves as polylines.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/line_meetings.hpp"
#include "core/geometry/solid.hpp"

namespace ridgeline::geometry {
namespace {

constexpr double coincident = 1e-11;  ///< of the sizes: walls nearer than this are one
constexpr int seam_samples = 96;      ///< a seam that comes and goes within one step is not seen
constexpr int deepest_split = 14;
constexpr int end_bisections = 40;

bool are_parallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.cross(b).norm() <= parallel_sine;
}

double size(const Prism& prism) {
  return half_extents(prism.profile).norm();
}

/// The circular arc from a through p to b; straight when p is on the chord.
Piece arc_through(const Eigen::Vector3d& a, const Eigen::Vector3d& p, const Eigen::Vector3d& b,
                  std::size_t owner) {
  Piece piece;
  piece.a = a;
  piece.b = b;
  piece.owner = owner;
  const Eigen::Vector3d normal = (p - a).cross(b - p);
  if (normal.norm() <= 1e-9 * (b - a).squaredNorm()) return piece;
  // The centre is a + v with v.(p - a) = |p - a|^2 / 2, likewise for b, and v.normal = 0.
  Eigen::Matrix3d rows;
  rows << (p - a).transpose(), (b - a).transpose(), normal.transpose();
  const Eigen::Vector3d v = rows.partialPivLu().solve(
      Eigen::Vector3d((p - a).squaredNorm() / 2, (b - a).squaredNorm() / 2, 0));
  Spiral s;
  s.centre = a + v;
  s.z = normal.normalized();
  s.x = -v.normalized();
  s.y = s.z.cross(s.x);
  s.r0 = s.r1 = v.norm();
  s.w0 = 0;
  const Eigen::Vector3d end = b - s.centre;
  s.w1 = std::atan2(end.dot(s.y), end.dot(s.x));
  if (!(s.w1 > 0)) s.w1 += 2 * std::numbers::pi;
  s.h0 = s.h1 = 0;
  piece.bend = s.r0 * s.w1 * s.w1;
  piece.spiral = std::make_shared<const Spiral>(s);
  return piece;
}

}  // namespace

// Two walls, neither along the other: the generators of the smaller all meet the larger, as a rule.
// Two walls side by side, a wall and a plane along it, two planes: straight lines. The floor of a
// cavity meets its own wall in a corner of air, which nothing in the air is nearest to.
void Solid::add_meetings(const Face& one, const Face& two) {
  if (one.cell == two.cell && one.cell != 0) return;
  if (one.plane && two.plane) {
    const Plane& a = plane(one);
    const Plane& b = plane(two);
    if (are_parallel(a.normal, b.normal)) return;
    Eigen::Matrix3d rows;
    rows << a.normal.transpose(), b.normal.transpose(), a.normal.cross(b.normal).transpose();
    const Eigen::Vector3d right(a.normal.dot(a.point), b.normal.dot(b.point),
                                rows.row(2).dot(centre_));
    const Eigen::Vector3d point = rows.partialPivLu().solve(right);
    return follow(
        {SeamPart::Line{point, rows.row(2).transpose().normalized()}, one, two, -reach_, reach_});
  }
  if (one.plane || two.plane) {
    const Face& curved = one.plane ? two : one;
    const Face& flat = one.plane ? one : two;
    const double slope = plane(flat).normal.dot(wall(curved).frame.axes.col(2));
    if (std::abs(slope) <= parallel_sine) return add_lengthwise_cut(curved, flat);
    return follow({SeamPart::Generators{curved, flat, 0}, one, two, 0, 1});
  }
  if (are_parallel(wall(one).frame.axes.col(2), wall(two).frame.axes.col(2))) {
    return add_parallel_walls(one, two);
  }
  const bool first_is_smaller = size(wall(one)) <= size(wall(two));
  for (const int root : {0, 1}) {
    follow({first_is_smaller ? SeamPart::Generators{one, two, root}
                             : SeamPart::Generators{two, one, root},
            one, two, 0, 1});
  }
}

void Solid::add_line(const Face& one, const Face& two, const Prism& prism,
                     const Eigen::Vector2d& p) {
  const Eigen::Vector3d axis = prism.frame.axes.col(2);
  const double middle = axis.dot(centre_ - prism.frame.origin);
  const Eigen::Vector3d point = to_outer(prism.frame, {p.x(), p.y(), middle});
  follow({SeamPart::Line{point, axis}, one, two, -reach_, reach_});
}

void Solid::add_lengthwise_cut(const Face& curved, const Face& flat) {
  const Prism& prism = wall(curved);
  const Eigen::Vector3d normal = direction_to_local(prism.frame, plane(flat).normal);
  const double offset = normal.dot(to_local(prism.frame, plane(flat).point));
  const Eigen::Vector2d foot = offset * normal.head<2>();
  const Eigen::Vector2d along(-normal.y(), normal.x());
  const Roots roots = line_meetings(prism.profile, foot, along);
  for (int i = 0; i < roots.count; ++i) {
    add_line(curved, flat, prism, foot + roots.z[static_cast<std::size_t>(i)] * along);
  }
}

void Solid::add_parallel_walls(const Face& one, const Face& two) {
  const auto point = [&](double u) { return profile_at(wall(one).profile, u).p; };
  const auto gap = [&](double u) {
    const Eigen::Vector2d p = point(u);
    return height(two, to_outer(wall(one).frame, {p.x(), p.y(), 0}));
  };
  // Walls that lie in one another, as those of two holes of one axis, meet in no line: of a gap
  // that is but rounding the sign says nothing.
  const double rounding = coincident * (reach_ + size(wall(one)));
  int last = -1;  // sample with a gap
  double last_gap = 0;
  for (int i = 0; i <= seam_samples; ++i) {
    const double here = gap(static_cast<double>(i) / seam_samples);
    if (std::abs(here) <= rounding) continue;
    const bool crosses = last >= 0 && i - last <= 2 && (here > 0) != (last_gap > 0);
    double low = static_cast<double>(last) / seam_samples;
    double high = static_cast<double>(i) / seam_samples;
    const bool low_above = last_gap > 0;
    last = i;
    last_gap = here;
    if (!crosses) continue;
    for (int k = 0; k < end_bisections; ++k) {
      const double middle = (low + high) / 2;
      ((gap(middle) > 0) == low_above ? low : high) = middle;
    }
    add_line(one, two, wall(one), point((low + high) / 2));
  }
}

std::optional<Eigen::Vector3d> Solid::boundary_at(const SeamPart& part, double parameter) const {
  const std::optional<Eigen::Vector3d> p = seam_at(part, parameter);
  return p && is_on_seam(part, *p) ? p : std::nullopt;
}

// Where the seam is on the boundary at one end of a step only, its end is bisected.
void Solid::follow(const SeamPart& whole) {
  const double step = (whole.to - whole.from) / seam_samples;
  const auto parameter = [&](int i) { return whole.from + i * step; };
  std::optional<Eigen::Vector3d> before = boundary_at(whole, parameter(0));
  for (int i = 0; i < seam_samples; ++i) {
    std::optional<Eigen::Vector3d> after = boundary_at(whole, parameter(i + 1));
    double low = parameter(i), high = parameter(i + 1);
    if (before && after) {
      add({whole.curve, whole.one, whole.two, low, high}, *before, *after, 0);
    } else if (before || after) {
      double on = before ? low : high, off = before ? high : low;
      std::optional<Eigen::Vector3d> end;
      for (int k = 0; k < end_bisections; ++k) {
        const double middle = (on + off) / 2;
        const std::optional<Eigen::Vector3d> p = boundary_at(whole, middle);
        (p ? on : off) = middle;
        if (p) end = p;
      }
      if (end && before) add({whole.curve, whole.one, whole.two, low, on}, *before, *end, 0);
      if (end && after) add({whole.curve, whole.one, whole.two, on, high}, *end, *after, 0);
    }
    before = after;
  }
}

// A part is the arc through its ends and its middle; where that is seam_sag off at a quarter, two.
void Solid::add(const SeamPart& part, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                int depth) {
  if (a == b) return;
  const double middle = (part.from + part.to) / 2;
  const std::optional<Eigen::Vector3d> p = seam_at(part, middle);
  if (!p) return;
  const std::optional<Eigen::Vector3d> q = seam_at(part, (part.from + middle) / 2);
  const Piece piece = arc_through(a, *p, b, parts_.size());
  const bool follows = q && geometry::nearest(piece, *q).distance <= seam_sag;
  if (follows || depth >= deepest_split) {
    seam_pieces_.push_back(piece);
    parts_.push_back(part);
    return;
  }
  add({part.curve, part.one, part.two, part.from, middle}, a, *p, depth + 1);
  add({part.curve, part.one, part.two, middle, part.to}, *p, b, depth + 1);
}

}  // namespace ridgeline::geometry
