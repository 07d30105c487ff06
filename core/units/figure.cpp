#include "core/units/figure.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/units/overlay.hpp"
#include "core/units/tolerance.hpp"

namespace ridgeline::units {
namespace {

constexpr double on_axis = 1e-6;  // [mm]

bool is_near(const Point& p, const Point& q) {
  return std::hypot(p.r - q.r, p.z - q.z) <= 4 * vertex_tolerance;
}

/// Longest contour by extent: the outer one.
const Contour& outer_loop(const std::vector<Contour>& loops) {
  return *std::max_element(loops.begin(), loops.end(), [](const Contour& p, const Contour& q) {
    return area(region_of(p)) < area(region_of(q));
  });
}

std::vector<Segment> reversed(std::vector<Segment> segments) {
  std::reverse(segments.begin(), segments.end());
  for (Segment& segment : segments) {
    std::swap(segment.start, segment.end);
    if (segment.arc) {
      segment.arc->sense =
          segment.arc->sense == Sense::Clockwise ? Sense::CounterClockwise : Sense::Clockwise;
    }
  }
  return segments;
}

void draw_face(Unit& unit) {
  const Box b = box(unit.region);
  const bool is_front = unit.kind == UnitKind::FaceFront;
  unit.start = {b.r1, is_front ? b.z0 : b.z1};  // S801, S802
  unit.shape = {{unit.start, {b.r0, is_front ? b.z1 : b.z0}, {}}};
}

void draw_bar(Unit& unit) {
  const Box b = box(unit.region);
  const bool is_outer = unit.kind == UnitKind::BarOuter;
  unit.start = {is_outer ? b.r1 : b.r0, unit.process == 1 ? b.z0 : b.z1};  // S803 to S806
  unit.shape = simplified(limit_of(unit.region, is_outer ? Limit::Least : Limit::Greatest));
  if (unit.process == 2) unit.shape = reversed(std::move(unit.shape));
}

void draw_outline(Unit& unit) {
  const std::vector<Contour> loops = contours(unit.region);
  unit.shape = outer_loop(loops);
  unit.is_closed = true;
  unit.start = unit.shape.front().start;
}

[[noreturn]] void refuse(const Unit& unit, const std::string& what) {
  throw Error(ErrorCode::BadInput, "unit " + std::to_string(unit.number) + ": " + what);
}

Region bar_region(const Unit& unit) {
  Contour contour = unit.shape;
  const Point first = contour.front().start;
  const Point last = contour.back().end;
  const double r = unit.start.r;
  contour.push_back({last, {r, last.z}, {}});
  contour.push_back({{r, last.z}, {r, first.z}, {}});
  contour.push_back({{r, first.z}, first, {}});
  return region_of(contour);
}

Region hole_region(const Unit& unit) {
  const Hole& hole = *unit.hole;
  const double sign = hole.direction.z() > 0 ? 1 : -1;
  const double z0 = hole.start.z();
  const double z1 = z0 + sign * hole.depth;
  const double R = hole.diameter / 2;
  Contour contour{{{0, z0}, {R, z0}, {}}, {{R, z0}, {R, z1}, {}}};
  if (hole.bottom == HoleBottom::Cone) {
    const double tip = z1 + sign * R / std::tan(hole.point_angle / 2);
    contour.push_back({{R, z1}, {0, tip}, {}});
    contour.push_back({{0, tip}, {0, z0}, {}});
  } else {
    contour.push_back({{R, z1}, {0, z1}, {}});
    contour.push_back({{0, z1}, {0, z0}, {}});
  }
  return region_of(contour);
}

}  // namespace

std::vector<Segment> limit_of(const Region& region, Limit limit) {
  const bool is_least = limit == Limit::Least;
  std::vector<Segment> found;
  const std::vector<Cell>& cells = region.cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool is_first = i == 0 || cells[i - 1].z0 != cells[i].z0;
    const bool is_last = i + 1 == cells.size() || cells[i + 1].z0 != cells[i].z0;
    if (is_least ? !is_first : !is_last) continue;
    Segment next = segment_of(is_least ? cells[i].inner : cells[i].outer, cells[i].z0, cells[i].z1);
    if (!found.empty()) {
      if (is_near(found.back().end, next.start)) {
        next.start = found.back().end;
      } else {
        found.push_back({found.back().end, next.start, {}});
      }
    }
    found.push_back(next);
  }
  return found;
}

bool is_turned(const Unit& unit) {
  if (unit.kind == UnitKind::FaceMill || unit.kind == UnitKind::Unexplained) return false;
  if (unit.kind != UnitKind::Hole) return true;
  return unit.hole && unit.hole->start.head<2>().norm() < on_axis &&
         unit.hole->direction.head<2>().norm() < 1e-9;
}

void draw_figure(Unit& unit) {
  unit.shape.clear();
  unit.is_closed = false;
  if (is_empty(unit.region)) return;
  switch (unit.kind) {
    case UnitKind::FaceFront:
    case UnitKind::FaceBack: draw_face(unit); break;
    case UnitKind::BarOuter:
    case UnitKind::BarInner: draw_bar(unit); break;
    case UnitKind::Groove: draw_outline(unit); break;
    case UnitKind::Hole:
    case UnitKind::FaceMill:
    case UnitKind::Unexplained: break;
  }
}

Region figure_region(const Unit& unit) {
  if (unit.kind == UnitKind::Hole) return hole_region(unit);
  if (unit.shape.empty()) refuse(unit, "its shape has no rows; at least 1 is needed");
  const Segment& first = unit.shape.front();
  if (unit.is_closed || unit.kind == UnitKind::Groove) {
    Contour contour = unit.shape;
    if (!is_near(contour.back().end, contour.front().start)) {
      contour.push_back({contour.back().end, contour.front().start, {}});
    }
    return region_of(contour);
  }
  if (unit.kind == UnitKind::FaceFront || unit.kind == UnitKind::FaceBack) {
    return rectangle(std::min(first.start.r, first.end.r), std::max(first.start.r, first.end.r),
                     std::min(first.start.z, first.end.z), std::max(first.start.z, first.end.z));
  }
  return bar_region(unit);
}

}  // namespace ridgeline::units
