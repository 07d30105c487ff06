#include "jobs/units_figure.hpp"

#include <algorithm>
#include <cmath>

#include "core/units/contour.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using units::Segment;
using units::Unit;

constexpr double chord_angle = 0.05;  // [rad]: of drawn arcs

void add_points(std::vector<Vector2d>& points, const Segment& row) {
  points.emplace_back(row.start.z, row.start.r);
  if (!row.arc) return;
  const int n = std::clamp(
      static_cast<int>(std::ceil(units::length(row) / row.arc->radius / chord_angle)), 1, 200);
  for (int i = 1; i < n; ++i) {
    const units::Point p = units::point_at(row, static_cast<double>(i) / n);
    points.emplace_back(p.z, p.r);
  }
}

/// A band of half width w about the line from p along d, turned into the half section about p's
/// polar angle.
Loops band(const Vector3d& p, const Vector3d& d, double length, double w) {
  const double r = std::hypot(p.x(), p.y());
  const Vector2d at(p.z(), r);
  const double outwards = r > 1e-9 ? (d.x() * p.x() + d.y() * p.y()) / r : 0;
  Vector2d way(d.z(), outwards);
  way = way.norm() > 1e-9 ? Vector2d(way.normalized()) : Vector2d(0, -1);
  const Vector2d side = w * Vector2d(-way.y(), way.x());
  const Vector2d end = at + length * way;
  return {{at + side, end + side, end - side, at - side}};
}

}  // namespace

Loops half_section(const units::Region& region) {
  Loops loops;
  for (const units::Contour& contour : units::contours(region)) {
    loops.emplace_back();
    for (const Segment& row : contour) add_points(loops.back(), row);
  }
  return loops;
}

Loops half_section(const Unit& unit) {
  if (unit.hole && units::is_empty(unit.region)) {
    return band(unit.hole->start, unit.hole->direction, unit.hole->depth, unit.hole->diameter / 2);
  }
  if (unit.face) {
    const Vector3d& n = unit.face->normal;
    const double height = std::abs(n.dot(unit.face->point));
    const double z0 = unit.face->z0;
    const double z1 = unit.face->z1;
    if (std::abs(n.z()) < 0.5) {
      return {{{z0, height},
               {z1, height},
               {z1, height + unit.face->depth},
               {z0, height + unit.face->depth}}};
    }
    const double r = std::hypot(unit.face->point.x(), unit.face->point.y());
    const double w = std::max(unit.face->width / 2, 0.5);
    return band({r, 0, unit.face->point.z()}, n, unit.face->depth, w);
  }
  if (unit.remainder) {
    const units::Remainder& rest = *unit.remainder;
    return {{{rest.z0, rest.r0}, {rest.z1, rest.r0}, {rest.z1, rest.r1}, {rest.z0, rest.r1}}};
  }
  return half_section(unit.region);
}

int hue_of_unit(std::size_t i) {
  return static_cast<int>(std::lround(std::fmod(static_cast<double>(i) * 137.508, 360)));
}

}  // namespace ridgeline::jobs
