#include "core/units/volumes.hpp"

#include <algorithm>

#include "core/units/figure.hpp"
#include "core/units/overlay.hpp"

namespace ridgeline::units {
namespace {

bool is_milled(const Unit& unit) {
  return unit.kind == UnitKind::FaceMill || (unit.kind == UnitKind::Hole && !is_turned(unit));
}

/// What no unit removes of a feature whose unit was taken out.
double left_of_feature(const Program& program, const Removed& removed) {
  if (!removed.feature) return 0;
  const Product& product = program.product;
  double left = 0;
  if (removed.kind == UnitKind::Hole) left = product.holes[*removed.feature].volume;
  if (removed.kind == UnitKind::FaceMill) left = product.faces[*removed.feature].volume;
  if (removed.kind == UnitKind::Unexplained) left = product.remainders[*removed.feature].volume;
  for (const Unit& unit : program.units) {
    if (unit.kind == removed.kind && unit.feature == removed.feature) left -= unit.volume;
  }
  return std::max(left, 0.0);
}

}  // namespace

Volumes measured_volumes(const Program& program) {
  Volumes v;
  v.stock = volume(program.stock);
  v.product = program.product.volume;
  const Region T = difference_of(program.stock, program.product.shadow);
  v.turned = volume(T);
  std::vector<Region> regions;
  std::vector<Region> cores;
  double in_regions = 0;
  double in_cores = 0;
  for (const Unit& unit : program.units) {
    if (unit.kind == UnitKind::Unexplained) {
      v.unexplained += unit.volume;
    } else if (is_milled(unit)) {
      v.units += unit.volume;
    } else {
      regions.push_back(unit.region);
      cores.push_back(unit.core);
      in_regions += volume(unit.region);
      in_cores += volume(unit.core);
    }
  }
  v.units += in_regions;
  const Region covered = union_of(regions);
  v.overlap_undeclared = in_cores - volume(union_of(cores));
  v.overlap_declared = in_regions - volume(covered) - v.overlap_undeclared;
  v.left = volume(difference_of(T, covered));
  for (std::size_t i = 0; i < program.removed.size(); ++i) {
    const Removed& one = program.removed[i];
    const auto is_same = [&](const Removed& other) {  // its parts may be taken out one by one
      return other.kind == one.kind && other.feature == one.feature;
    };
    if (std::none_of(program.removed.begin(),
                     program.removed.begin() + static_cast<std::ptrdiff_t>(i), is_same)) {
      v.left += left_of_feature(program, one);
    }
  }
  return v;
}

}  // namespace ridgeline::units
