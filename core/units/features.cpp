#include "core/units/features.hpp"

#include "core/units/tolerance.hpp"

namespace ridgeline::units {
namespace {

/// Design 1.8-j: the spindle whose free end the tool comes from, along the axis or leaning; across
/// the axis both reach it. `way` is the part along Z of the unit vector in which the tool advances.
int process_of(double way, double z, const Split& split) {
  if (way > across_axis) return 1;
  if (way < -across_axis) return 2;
  return z < split.outer ? 1 : 2;
}

}  // namespace

std::vector<Unit> feature_units(const Product& product, const Split& split) {
  std::vector<Unit> units;
  for (std::size_t i = 0; i < product.holes.size(); ++i) {
    Unit unit;
    unit.kind = UnitKind::Hole;
    unit.hole = product.holes[i];
    unit.feature = i;
    unit.process = process_of(unit.hole->direction.z(), unit.hole->start.z(), split);
    unit.volume = unit.hole->volume;
    units.push_back(std::move(unit));
  }
  for (std::size_t i = 0; i < product.faces.size(); ++i) {
    Unit unit;
    unit.kind = UnitKind::FaceMill;
    unit.face = product.faces[i];
    unit.feature = i;
    unit.process = process_of(-unit.face->normal.z(), (unit.face->z0 + unit.face->z1) / 2, split);
    unit.volume = unit.face->volume;
    units.push_back(std::move(unit));
  }
  for (std::size_t i = 0; i < product.remainders.size(); ++i) {
    Unit unit;
    unit.kind = UnitKind::Unexplained;
    unit.remainder = product.remainders[i];
    unit.feature = i;
    unit.process = process_of(0, (unit.remainder->z0 + unit.remainder->z1) / 2, split);
    unit.volume = unit.remainder->volume;
    units.push_back(std::move(unit));
  }
  return units;
}

}  // namespace ridgeline::units
