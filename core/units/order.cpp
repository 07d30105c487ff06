#include "core/units/order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/units/figure.hpp"

namespace ridgeline::units {
namespace {

/// Holes on the axis come before the boring bar (design 1.8-b), others last.
enum class Step { Face, BarOuter, AxisHole, BarInner, Groove, FaceMill, Hole, Unexplained };

/// The machining order within a process: reorder this table to change it.
constexpr std::array<Step, 8> order = {Step::Face,     Step::BarOuter,   Step::AxisHole,
                                       Step::BarInner, Step::Groove,     Step::FaceMill,
                                       Step::Hole,     Step::Unexplained};

Step step_of(const Unit& unit) {
  switch (unit.kind) {
    case UnitKind::FaceFront:
    case UnitKind::FaceBack: return Step::Face;
    case UnitKind::BarOuter: return Step::BarOuter;
    case UnitKind::BarInner: return Step::BarInner;
    case UnitKind::Groove: return Step::Groove;
    case UnitKind::FaceMill: return Step::FaceMill;
    case UnitKind::Hole: return is_turned(unit) ? Step::AxisHole : Step::Hole;
    case UnitKind::Unexplained: return Step::Unexplained;
  }
  return Step::Unexplained;
}

/// [0, 2 pi) from +X; rounding just below a full turn counts as 0.
double polar_angle(double x, double y) {
  const double angle = std::atan2(y, x);
  const double positive = angle < 0 ? angle + 2 * std::numbers::pi : angle;
  return positive > 2 * std::numbers::pi - 1e-9 ? 0 : positive;
}

/// The keys that decide between units of one rank, ascending.
std::array<double, 3> keys(const Unit& unit) {
  const double sign = unit.process == 1 ? 1 : -1;
  constexpr double grid = 1e-6;  // [mm], [rad]: equal parameters
  const auto coarse = [](double x) { return std::round(x / grid) * grid; };
  if (unit.kind == UnitKind::Hole && unit.hole) {
    const Eigen::Vector3d& p = unit.hole->start;
    return {-coarse(unit.hole->diameter), coarse(polar_angle(p.x(), p.y())), p.z()};
  }
  if (unit.kind == UnitKind::FaceMill && unit.face) {
    const MilledFace& face = *unit.face;
    const double bottom = unit.process == 1 ? -face.z0 : face.z1;  // S1002, S1005
    const Eigen::Vector3d& way = std::abs(face.normal.z()) < 0.99 ? face.normal : face.point;
    return {coarse(bottom), coarse(polar_angle(way.x(), way.y())), face.z0};
  }
  if (unit.remainder) return {unit.remainder->z0, unit.remainder->angle, unit.remainder->r0};
  const Box b = box(unit.region);
  return {sign > 0 ? coarse(b.z0) : -coarse(b.z1), -coarse(b.r1), 0};
}

}  // namespace

int rank(const Unit& unit) {
  const auto place = std::find(order.begin(), order.end(), step_of(unit)) - order.begin();
  return (unit.process - 1) * static_cast<int>(order.size()) + static_cast<int>(place);
}

void put_in_order(std::vector<Unit>& units) {
  std::stable_sort(units.begin(), units.end(), [](const Unit& p, const Unit& q) {
    const int i = rank(p);
    const int j = rank(q);
    return i != j ? i < j : keys(p) < keys(q);
  });
}

void number(std::vector<Unit>& units) {
  int next = 0;
  for (Unit& unit : units) unit.number = ++next;
}

}  // namespace ridgeline::units
