#pragma once

#include <optional>
#include <string_view>

#include "core/units/product.hpp"
#include "part/placed.hpp"

namespace ridgeline::part {

/// A turning axis given by the operator: also says that the part is turned, whatever its shape.
struct GivenAxis {
  std::optional<Eigen::Vector3d> point;  ///< in file coordinates; absent: found, in the direction
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

struct TurnedPart {
  units::Product product;
  geometry::Frame placement;  ///< the product's frame in file coordinates
};

/// A STEP file as the product of a turning program. Throws Error{BadFile, AbsurdSize} of read_step;
/// SeveralSolids when not exactly one of several solids is turned; NotTurned (design 1.8-d) with
/// what speaks against it.
TurnedPart read_product(std::string_view step, const std::optional<GivenAxis>& axis = {});

/// A STEP file as stock: its shadow about its own turning axis, low end at Z = 0. Same errors.
units::Region read_stock(std::string_view step);

}  // namespace ridgeline::part
