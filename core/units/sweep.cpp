#include <algorithm>
#include <cmath>

#include "core/units/overlay.hpp"
#include "core/units/passes.hpp"
#include "core/units/tolerance.hpp"

namespace ridgeline::units {
namespace {

constexpr double chord_angle = 0.02;  // [rad] of the shank behind an arc; the nose itself is exact

Contour disc(const Point& c, double R) {
  const Point left{c.r, c.z - R};
  const Point right{c.r, c.z + R};
  const Segment::Round round{c, R, Sense::CounterClockwise};
  return {{left, right, round}, {right, left, round}};
}

/// Convex hull, counter-clockwise with z to the right.
Contour hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& p, const Point& q) { return p.z < q.z || (p.z == q.z && p.r < q.r); });
  const auto turn = [](const Point& a, const Point& b, const Point& c) {
    return (b.z - a.z) * (c.r - a.r) - (b.r - a.r) * (c.z - a.z);
  };
  std::vector<Point> loop;
  for (int half = 0; half < 2; ++half) {
    const std::size_t base = loop.size();
    for (const Point& p : points) {
      while (loop.size() >= base + 2 && turn(loop[loop.size() - 2], loop.back(), p) <= 0) {
        loop.pop_back();
      }
      loop.push_back(p);
    }
    loop.pop_back();
    std::reverse(points.begin(), points.end());
  }
  Contour contour;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    contour.push_back({loop[i], loop[(i + 1) % loop.size()], {}});
  }
  return contour;
}

/// A tool seen in the half section: its nose, and its shank as wide as the nose behind it.
struct Tool {
  double R = 0;
  double shank = 0;
  double width = 0;  ///< of a grooving tool, from its corner outwards; 0: a nose
  Approach approach = Approach::Outer;
};

std::vector<Point> shank_at(const Tool& tool, const Point& c) {
  const double R = std::max(tool.R, 1e-3);
  const double h = tool.shank;
  if (tool.width > 0) {
    const double back = tool.approach == Approach::Front ? c.z - h : c.z + h;
    return {{c.r, c.z}, {c.r + tool.width, c.z}, {c.r, back}, {c.r + tool.width, back}};
  }
  switch (tool.approach) {
    case Approach::Outer:
      return {{c.r, c.z - R}, {c.r, c.z + R}, {c.r + h, c.z - R}, {c.r + h, c.z + R}};
    case Approach::Inner:
      return {{c.r, c.z - R}, {c.r, c.z + R}, {c.r - h, c.z - R}, {c.r - h, c.z + R}};
    case Approach::Front:
      return {{c.r - R, c.z}, {c.r + R, c.z}, {c.r - R, c.z - h}, {c.r + R, c.z - h}};
    case Approach::Back: break;
  }
  return {{c.r - R, c.z}, {c.r + R, c.z}, {c.r - R, c.z + h}, {c.r + R, c.z + h}};
}

/// The band that a nose leaves along an arc.
Region arc_band(const Segment& path, double R) {
  const Segment::Round& round = *path.arc;
  const auto at = [&](const Point& p, double radius) {
    const double f = radius / round.radius;
    return Point{round.centre.r + f * (p.r - round.centre.r),
                 round.centre.z + f * (p.z - round.centre.z)};
  };
  const double outer = round.radius + R;
  const double inner = round.radius - R;
  const Sense back = round.sense == Sense::Clockwise ? Sense::CounterClockwise : Sense::Clockwise;
  Contour contour{{at(path.start, outer), at(path.end, outer),
                   Segment::Round{round.centre, outer, round.sense}}};
  if (inner > merge_tolerance) {
    contour.push_back({at(path.end, outer), at(path.end, inner), {}});
    contour.push_back(
        {at(path.end, inner), at(path.start, inner), Segment::Round{round.centre, inner, back}});
    contour.push_back({at(path.start, inner), at(path.start, outer), {}});
  } else {
    contour.push_back({at(path.end, outer), round.centre, {}});
    contour.push_back({round.centre, at(path.start, outer), {}});
  }
  return region_of(contour);
}

void add_line(std::vector<Region>& parts, const Tool& tool, const Point& p, const Point& q) {
  std::vector<Point> corners = shank_at(tool, p);
  for (const Point& corner : shank_at(tool, q)) corners.push_back(corner);
  parts.push_back(region_of(hull(std::move(corners))));
}

void add(std::vector<Region>& parts, const Tool& tool, const Segment& path) {
  if (tool.R > merge_tolerance) {
    parts.push_back(region_of(disc(path.start, tool.R)));
    parts.push_back(region_of(disc(path.end, tool.R)));
  }
  if (!path.arc) {
    const double l = std::hypot(path.end.r - path.start.r, path.end.z - path.start.z);
    if (l > merge_tolerance && tool.R > merge_tolerance) {
      const double nr = tool.R * (path.end.z - path.start.z) / l;
      const double nz = -tool.R * (path.end.r - path.start.r) / l;
      parts.push_back(region_of(hull({{path.start.r + nr, path.start.z + nz},
                                      {path.start.r - nr, path.start.z - nz},
                                      {path.end.r + nr, path.end.z + nz},
                                      {path.end.r - nr, path.end.z - nz}})));
    }
    add_line(parts, tool, path.start, path.end);
    return;
  }
  if (tool.R > merge_tolerance) parts.push_back(arc_band(path, tool.R));
  const int n =
      std::max(1, static_cast<int>(std::ceil(length(path) / path.arc->radius / chord_angle)));
  // Chords of the way cut the corner: the shank is narrower by that.
  Tool shank = tool;
  const double turn = length(path) / path.arc->radius / n;
  shank.R = std::max(0.0, tool.R - path.arc->radius * (1 - std::cos(turn / 2)));
  for (int i = 0; i < n; ++i) {
    add_line(parts, shank, point_at(path, static_cast<double>(i) / n),
             point_at(path, static_cast<double>(i + 1) / n));
  }
}

Region drilled(const TurningStep& step) {
  const double R = step.drill_diameter / 2;
  const double sign = step.drill_to > step.drill_from ? 1 : -1;
  const double shoulder = step.drill_to - sign * R / std::tan(drill_point_angle / 2);
  const double out = step.drill_from - sign * turning_clearance;
  return region_of(hull({{0, out}, {R, out}, {R, shoulder}, {0, step.drill_to}}));
}

}  // namespace

Region swept(const TurningStep& step) {
  if (step.kind == TurningStep::Kind::Drill) return drilled(step);
  const Tool tool{step.tool.nose_radius, step.tool.depth_of_cut, step.width, step.approach};
  std::vector<Region> parts;
  for (const TurningMove& move : step.moves) {
    if (move.kind == TurningMove::Kind::Feed) add(parts, tool, move.path);
  }
  return union_of(parts);
}

TurningCheck check_turning(const Program& program, const Unit& unit, const TurningPaths& paths) {
  std::vector<Region> all;
  for (const TurningStep& step : paths.steps) all.push_back(swept(step));
  const Region tool = union_of(all);
  TurningCheck check;
  check.gouge = volume(intersection_of(tool, program.product.shadow));
  const Region rest = difference_of(unit.region, tool);
  check.left = volume(rest);
  check.thickness = thickness(rest);
  return check;
}

}  // namespace ridgeline::units
