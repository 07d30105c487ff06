#include "core/units/zones.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/error.hpp"
#include "core/units/overlay.hpp"
#include "core/units/tolerance.hpp"

namespace ridgeline::units {
namespace {

constexpr double usual_overlap = 5;             // [mm]
constexpr double drill_slope_tolerance = 0.02;  // of dr/dz = tan 59 deg = 1.664: half a degree
constexpr double equal_radius = 1e-4;           // [mm]

/// What lies around S between its ends.
struct Around {
  Region outer, inner, between;
};

Around around(const Region& shadow, double far) {
  Around found;
  const std::vector<Cell>& cells = shadow.cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    const Curve axis{.a = {0, cell.z0}, .b = {0, cell.z1}};
    const Curve edge{.a = {far, cell.z0}, .b = {far, cell.z1}};
    const bool is_first = i == 0 || cells[i - 1].z0 != cell.z0;
    const bool is_last = i + 1 == cells.size() || cells[i + 1].z0 != cell.z0;
    if (is_first && range(cell.inner, cell.z0, cell.z1).max > merge_tolerance) {
      found.inner.cells.push_back({cell.z0, cell.z1, axis, cell.inner});
    }
    if (is_last) {
      found.outer.cells.push_back({cell.z0, cell.z1, cell.outer, edge});
    } else {
      found.between.cells.push_back({cell.z0, cell.z1, cell.outer, cells[i + 1].inner});
    }
  }
  return found;
}

enum class End { Low, High };

/// Does a cell of `region` go on, at that end in z, into a cell of `rest`?
bool is_open(const Region& region, const Region& rest, End end) {
  for (const Cell& cell : region.cells) {
    const double z = end == End::Low ? cell.z0 : cell.z1;
    for (const Cell& other : rest.cells) {
      if (std::abs((end == End::Low ? other.z1 : other.z0) - z) > merge_tolerance) continue;
      const double r0 = std::max(radius_at(cell.inner, z), radius_at(other.inner, z));
      const double r1 = std::min(radius_at(cell.outer, z), radius_at(other.outer, z));
      if (r1 - r0 > vertex_tolerance) return true;
    }
  }
  return false;
}

void refuse_cavities(const Region& shadow, double far) {
  const Box extents = box(shadow);
  const Region all = rectangle(0, far, extents.z0 - 1, extents.z1 + 1);
  for (const Region& piece : pieces(difference_of(all, shadow))) {
    const Box b = box(piece);
    if (b.z0 < extents.z0 || b.z1 > extents.z1 || b.r1 > far - merge_tolerance) continue;
    throw Error(ErrorCode::Unsupported, "the product has a closed cavity of " +
                                            std::to_string(volume(piece)) + " mm3 between Z " +
                                            std::to_string(b.z0) + " and " + std::to_string(b.z1) +
                                            " mm; no tool reaches it");
  }
}

Region below(const Region& region, double z) {
  const Box b = box(region);
  return intersection_of(region, rectangle(0, b.r1 + 1, b.z0 - 1, z));
}

Region above(const Region& region, double z) {
  const Box b = box(region);
  return intersection_of(region, rectangle(0, b.r1 + 1, z, b.z1 + 1));
}

/// One zone or, where the split divides it, two that know each other.
void add_split(std::vector<Zone>& found, UnitKind kind, const Region& region, double z,
               double overlap) {
  const Region first = below(region, z);
  const Region second = above(region, z);
  if (is_empty(first) || is_empty(second)) {
    if (!is_empty(region)) {
      found.push_back({.kind = kind, .process = is_empty(second) ? 1 : 2, .region = region});
    }
    return;
  }
  const std::size_t n = found.size();
  found.push_back({.kind = kind,
                   .process = 1,
                   .region = first,
                   .ends_at_split = true,
                   .split = z,
                   .overlap = overlap,
                   .beyond = n + 1});
  found.push_back({.kind = kind,
                   .process = 2,
                   .region = second,
                   .ends_at_split = true,
                   .split = z,
                   .overlap = overlap,
                   .beyond = n});
}

bool is_drill_cone(const Cell& cell, double open_end_sign) {
  if (is_arc(cell.outer)) return false;
  const double slope = slope_at(cell.outer, cell.z0) * open_end_sign;
  return std::abs(slope - std::tan(drill_point_angle / 2)) < drill_slope_tolerance;
}

bool is_straight(const Cell& cell) {
  return !is_arc(cell.outer) && std::abs(cell.outer.a.r - cell.outer.b.r) < equal_radius;
}

/// A bore that a drill makes: it ends in the cone of a drill, or is too narrow for a boring bar
/// (design 1.8-b). The drill goes in from the open end.
std::optional<Hole> axis_hole(const Region& bore, bool front_open, bool back_open,
                              double smallest_bar) {
  std::vector<Cell> cells = bore.cells;  // from the open end inwards
  const bool from_front = front_open;
  if (!from_front) std::reverse(cells.begin(), cells.end());
  const double sign = from_front ? 1 : -1;
  const auto far_end = [&](const Cell& cell) { return from_front ? cell.z1 : cell.z0; };
  const auto near_end = [&](const Cell& cell) { return from_front ? cell.z0 : cell.z1; };
  Hole hole;
  hole.direction = {0, 0, sign};
  hole.start = {0, 0, near_end(cells.front())};
  if (front_open && back_open) {
    double narrowest = HUGE_VAL;
    for (const Cell& cell : cells) {
      narrowest = std::min(narrowest, range(cell.outer, cell.z0, cell.z1).min);
    }
    if (2 * narrowest >= smallest_bar) return std::nullopt;
    hole.diameter = 2 * narrowest;
    hole.bottom = HoleBottom::Through;
    hole.depth = std::abs(far_end(cells.back()) - hole.start.z());
  } else {
    const bool has_cone = cells.size() > 1 && is_drill_cone(cells.back(), -sign) &&
                          radius_at(cells.back().outer, far_end(cells.back())) < equal_radius;
    const Cell& wall = cells[cells.size() - (has_cone ? 2 : 1)];
    const double r = radius_at(wall.outer, far_end(wall));
    if (!has_cone && (!is_straight(wall) || 2 * r >= smallest_bar)) return std::nullopt;
    if (has_cone &&
        std::abs(radius_at(cells.back().outer, near_end(cells.back())) - r) > equal_radius) {
      return std::nullopt;
    }
    hole.diameter = 2 * r;
    hole.bottom = has_cone ? HoleBottom::Cone : HoleBottom::Flat;
    hole.depth = std::abs(far_end(wall) - hole.start.z());
    for (const Cell& cell : std::span(cells).first(cells.size() - (has_cone ? 1 : 0))) {
      if (2 * range(cell.outer, cell.z0, cell.z1).min < hole.diameter - 2 * equal_radius) {
        return std::nullopt;  // a neck before it
      }
    }
  }
  hole.steps = {{hole.diameter, hole.diameter, hole.depth}};
  return hole;
}

void add_bore(std::vector<Zone>& found, const Region& bore, bool front_open, bool back_open,
              const Split& split, const Parameters& parameters) {
  Region rest = bore;
  if (std::optional<Hole> hole =
          axis_hole(bore, front_open, back_open, parameters.smallest_boring_bar)) {
    const Box b = box(bore);
    Region drilled = intersection_of(bore, rectangle(0, hole->diameter / 2, b.z0, b.z1));
    hole->volume = volume(drilled);
    rest = difference_of(bore, drilled);
    found.push_back({.kind = UnitKind::Hole,
                     .process = hole->direction.z() > 0 ? 1 : 2,
                     .region = std::move(drilled),
                     .hole = std::move(hole)});
  }
  if (is_empty(rest)) return;
  if (front_open && back_open) {
    add_split(found, UnitKind::BarInner, rest, split.inner, split.inner_overlap);
  } else {
    found.push_back(
        {.kind = UnitKind::BarInner, .process = front_open ? 1 : 2, .region = std::move(rest)});
  }
}

}  // namespace

std::vector<Zone> zones(const Product& product, const Region& stock, const Split& split,
                        const Parameters& parameters) {
  const Region& S = product.shadow;
  const Box s = box(S);
  const Box t = box(stock);
  const double far = std::max(s.r1, t.r1) + 1;
  refuse_cavities(S, far);
  const Around rings = around(S, far);
  const Region front = rectangle(0, far, std::min(t.z0, s.z0) - 1, s.z0);
  const Region back = rectangle(0, far, s.z1, std::max(t.z1, s.z1) + 1);

  std::vector<Zone> found;
  found.push_back({.kind = UnitKind::FaceFront, .process = 1, .region = front});
  found.push_back({.kind = UnitKind::FaceBack, .process = 2, .region = back});
  add_split(found, UnitKind::BarOuter, rings.outer, split.outer, split.outer_overlap);
  const Region outside[] = {front, back, rings.outer};
  const Region rest = union_of(outside);
  for (const Region& bore : pieces(rings.inner)) {
    const Region reach[] = {rest, rings.between};
    const Region open = union_of(reach);
    add_bore(found, bore, is_open(bore, open, End::Low), is_open(bore, open, End::High), split,
             parameters);
  }
  const Region beside[] = {rest, rings.inner};
  const Region open = union_of(beside);
  for (const Region& groove : pieces(rings.between)) {
    const bool low = is_open(groove, open, End::Low);
    const bool high = is_open(groove, open, End::High);
    const Box b = box(groove);
    const bool is_first = low != high ? low : (b.z0 + b.z1) / 2 < split.outer;
    found.push_back({.kind = UnitKind::Groove, .process = is_first ? 1 : 2, .region = groove});
  }
  return found;
}

Split usual_split(const Product& product) {
  const Box s = box(product.shadow);
  const Around rings = around(product.shadow, s.r1 + 1);
  Split split{(s.z0 + s.z1) / 2, (s.z0 + s.z1) / 2, usual_overlap, usual_overlap};
  double z0 = HUGE_VAL, z1 = -HUGE_VAL;
  for (const Cell& cell : rings.outer.cells) {
    if (range(cell.inner, cell.z0, cell.z1).max < s.r1 - equal_radius) continue;
    z0 = std::min(z0, cell.z0);
    z1 = std::max(z1, cell.z1);
  }
  split.outer = (z0 + z1) / 2;
  double narrowest = HUGE_VAL;
  for (const Cell& cell : rings.inner.cells) {
    const double r = range(cell.outer, cell.z0, cell.z1).min;
    if (r > narrowest - equal_radius) continue;
    narrowest = r;
    split.inner = (cell.z0 + cell.z1) / 2;
  }
  const double room = (s.z1 - s.z0) / 10;
  split.outer_overlap = std::min(usual_overlap, room);
  split.inner_overlap = std::min(usual_overlap, room);
  return split;
}

}  // namespace ridgeline::units
