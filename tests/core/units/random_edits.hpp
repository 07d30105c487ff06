#pragma once

#include <vector>

#include "core/units/edit.hpp"
#include "core/units/figure.hpp"
#include "core/units/plan.hpp"
#include "tests/core/units/shapes.hpp"

/// Random edits as an operator makes them, for the property tests.
namespace ridgeline::units::random_edits {

using shapes::between;
using shapes::pick;
using shapes::Random;

inline double rounded(double x) {
  return std::round(x * 1000) / 1000;
}

/// Another end of the chain, an offset chain, another start line, another face depth, another hole.
inline Unit changed(Random& random, Unit unit) {
  const Box b = box(unit.region);
  if (unit.kind == UnitKind::Hole && unit.hole) {
    if (pick(random, 0, 1) != 0)
      unit.hole->diameter = rounded(unit.hole->diameter * between(random, 0.5, 1.2));
    else
      unit.hole->depth = rounded(unit.hole->depth * between(random, 0.3, 1.2));
    return unit;
  }
  if (unit.kind == UnitKind::FaceMill && unit.face) {
    unit.face->depth = rounded(unit.face->depth * between(random, 0.2, 1.3));
    return unit;
  }
  if (unit.shape.empty()) return unit;
  const double dz = rounded(between(random, -1, 1) * std::max(1.0, b.z1 - b.z0));
  const double dr = rounded(between(random, -0.5, 0.5) * std::max(1.0, b.r1 - b.r0));
  switch (pick(random, 0, 3)) {
    case 0: unit.shape.back().end.z += dz; break;
    case 1: unit.shape.back().end.r = std::max(0.0, unit.shape.back().end.r + dr); break;
    case 2:
      for (Segment& segment : unit.shape) {
        segment.start.r = std::max(0.0, segment.start.r + dr);
        segment.end.r = std::max(0.0, segment.end.r + dr);
        if (segment.arc) segment.arc.reset();
      }
      break;
    default: unit.start.r = std::max(0.0, unit.start.r + dr); break;
  }
  return unit;
}

inline Unit inserted(Random& random, const Program& program) {
  const Box s = box(program.stock);
  Unit unit;
  unit.kind = pick(random, 0, 1) != 0 ? UnitKind::BarOuter : UnitKind::BarInner;
  unit.process = pick(random, 1, 2);
  const double z0 = rounded(between(random, s.z0, s.z1));
  const double z1 = rounded(between(random, s.z0, s.z1));
  const double r0 = rounded(between(random, 0, s.r1));
  const double r1 = rounded(between(random, 0, s.r1));
  unit.start = {unit.kind == UnitKind::BarOuter ? s.r1 : 0, z0};
  unit.shape = {{{r0, z0}, {r1, z1}, {}}};
  return unit;
}

inline std::vector<Edit> any(Random& random, const Program& program) {
  std::vector<Edit> edits;
  const int n = pick(random, 0, 4) == 0 ? 2 : 1;
  const int count = static_cast<int>(program.units.size());
  int last = -1;
  for (int i = 0; i < n; ++i) {
    const int number = pick(random, 1, count);
    if (number == last) continue;
    last = number;
    const int kind = pick(random, 0, 11);
    if (kind == 0) {
      edits.push_back(RemoveUnit{number});
    } else if (kind == 1) {
      edits.push_back(InsertUnit{number, inserted(random, program)});
    } else {
      edits.push_back(
          ChangeUnit{number, changed(random, program.units[static_cast<std::size_t>(number - 1)])});
    }
  }
  return edits;
}

/// A turned product without milled features: outer profile, perhaps a bore from one end or through.
inline Product product(Random& random, double step) {
  Region body = region_of(shapes::profile(random, step));
  const Box b = box(body);
  const int bore = pick(random, 0, 3);
  if (bore > 0) {
    double narrowest = b.r1;
    for (const Cell& cell : body.cells)
      narrowest = std::min(narrowest, range(cell.outer, cell.z0, cell.z1).min);
    const double r = narrowest * between(random, 0.3, 0.7);
    const double z = between(random, 0.2, 0.8) * b.z1;
    const double wide = narrowest * between(random, 0.7, 0.9);
    if (bore == 1) body = difference_of(body, rectangle(0, r, -1, z));
    if (bore == 2) body = difference_of(body, rectangle(0, r, z, b.z1 + 1));
    if (bore == 3) {
      body = difference_of(body, rectangle(0, r, -1, b.z1 + 1));
      body = difference_of(body, rectangle(0, wide, -1, z));
    }
  }
  if (pick(random, 0, 2) == 0) {  // a face groove from the back
    const double r = b.r1 * between(random, 0.3, 0.7);
    body = difference_of(body, rectangle(r, r + b.r1 * 0.1, b.z1 * 0.8, b.z1 + 1));
  }
  Product found;
  std::vector<Region> all = pieces(body);
  found.shadow = *std::max_element(all.begin(), all.end(), [](const Region& p, const Region& q) {
    return volume(p) < volume(q);
  });
  const Box s = box(found.shadow);
  for (Cell& cell : found.shadow.cells) {  // low end to Z 0
    const auto move = [&](Curve& curve) {
      curve.a.z -= s.z0;
      curve.b.z -= s.z0;
    };
    cell.z0 -= s.z0;
    cell.z1 -= s.z0;
    move(cell.inner);
    move(cell.outer);
  }
  found.volume = volume(found.shadow);
  found.x_length = found.y_length = 2 * s.r1;
  return found;
}

}  // namespace ridgeline::units::random_edits
