#include "core/units/rework.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/units/figure.hpp"
#include "core/units/tolerance.hpp"
#include "core/units/tools.hpp"

namespace ridgeline::units {
namespace {

/// How a tool shape compares with the feature that it shall make.
struct Comparison {
  double share = 1;   ///< of the feature's material that it removes
  double excess = 0;  ///< farthest that it goes beyond the feature [mm]
};

Comparison compare(const Hole& edited, const Hole& feature) {
  const Eigen::Vector3d shift = edited.start - feature.start;
  const double along = shift.dot(feature.direction);
  const double aside = (shift - along * feature.direction).norm();
  const double turned = 1 - edited.direction.dot(feature.direction);
  if (turned > 1e-9 || aside > feature.diameter) return {0, edited.depth};
  const double wider = (edited.diameter - feature.diameter) / 2 + aside;
  const double deeper = along + edited.depth - feature.depth;
  const bool is_pointed = edited.bottom == HoleBottom::Cone && feature.bottom == HoleBottom::Flat;
  Comparison found;
  found.excess =
      std::max({wider, feature.bottom == HoleBottom::Through ? 0.0 : deeper,
                is_pointed ? edited.diameter / 2 / std::tan(edited.point_angle / 2) : 0});
  const double d = std::clamp((edited.diameter - 2 * aside) / feature.diameter, 0.0, 1.0);
  const double l = std::clamp((along + edited.depth) / feature.depth, 0.0, 1.0);
  const bool leaves_cone = edited.bottom == HoleBottom::Flat &&
                           feature.bottom == HoleBottom::Cone && deeper < equal_parameter;
  const double cone = feature.diameter / 6 / std::tan(feature.point_angle / 2);
  const double tip = feature.bottom == HoleBottom::Cone ? cone : 0;
  found.share = d * d * l * (leaves_cone ? feature.depth / (feature.depth + tip) : 1);
  return found;
}

Comparison compare(const MilledFace& edited, const MilledFace& feature) {
  if (edited.normal.dot(feature.normal) < 1 - 1e-9) return {0, edited.depth};
  const double lower = (feature.point - edited.point).dot(feature.normal);  // > 0: cuts deeper
  const double top = edited.depth - lower;
  const double depth = std::clamp((std::min(top, feature.depth) - std::max(-lower, 0.0)) /
                                      std::max(feature.depth, equal_parameter),
                                  0.0, 1.0);
  return {depth, std::max(0.0, lower)};
}

std::optional<Comparison> comparison(const Product& product, const Unit& unit) {
  if (!unit.feature) return std::nullopt;
  if (unit.kind == UnitKind::Hole && unit.hole && *unit.feature < product.holes.size()) {
    return compare(*unit.hole, product.holes[*unit.feature]);
  }
  if (unit.kind == UnitKind::FaceMill && unit.face && *unit.feature < product.faces.size()) {
    return compare(*unit.face, product.faces[*unit.feature]);
  }
  return std::nullopt;
}

double feature_volume(const Product& product, const Unit& unit) {
  return unit.kind == UnitKind::Hole ? product.holes[*unit.feature].volume
                                     : product.faces[*unit.feature].volume;
}

bool is_of_same_feature(const Unit& p, const Unit& q) {
  return p.kind == q.kind && p.feature && p.feature == q.feature;
}

}  // namespace

void warn_of_feature(const Product& product, Unit& unit) {
  unit.notes.clear();
  const std::optional<Comparison> found = comparison(product, unit);
  if (!found) {
    unit.notes.push_back("it is no feature of the product: what it cuts is product");
  } else if (found->excess > equal_parameter) {
    unit.notes.push_back("its shape runs into the product by " + std::to_string(found->excess) +
                         " mm");
  }
}

void share_features(Program& program) {
  for (std::size_t i = 0; i < program.units.size(); ++i) {
    Unit& unit = program.units[i];
    if (unit.kind == UnitKind::Unexplained || is_turned(unit)) continue;
    const std::optional<Comparison> own = comparison(program.product, unit);
    unit.volume = 0;
    if (!own) continue;
    double before = 0;
    for (std::size_t j = 0; j < i; ++j) {
      const Unit& other = program.units[j];
      if (is_of_same_feature(unit, other)) {
        before = std::max(before, comparison(program.product, other)->share);
      }
    }
    unit.volume = std::max(0.0, own->share - before) * feature_volume(program.product, unit);
  }
}

std::optional<Unit> rest_of_feature(const Program& program, const Unit& edited) {
  const std::optional<Comparison> found = comparison(program.product, edited);
  if (!found || found->share > 1 - 1e-9) return std::nullopt;
  const auto is_same = [&](const auto& other) {
    return other.kind == edited.kind && other.feature == edited.feature;
  };
  const auto finishes = [&](const Unit& unit) {
    return unit.state != State::Edited && is_same(unit);
  };
  if (std::any_of(program.units.begin(), program.units.end(), finishes) ||
      std::any_of(program.removed.begin(), program.removed.end(), is_same)) {
    return std::nullopt;
  }
  Unit rest = edited;
  rest.state = State::Auto;
  rest.notes.clear();
  if (edited.kind == UnitKind::Hole) {
    rest.hole = program.product.holes[*edited.feature];
  } else {
    rest.face = program.product.faces[*edited.feature];
  }
  rest.tools = usual_tools(rest);
  return rest;
}

}  // namespace ridgeline::units
