#pragma once

#include <vector>

#include "core/units/product.hpp"

namespace ridgeline::part {

/// A half section without the voids that it closes in, and what of them is worth a name.
struct Filled {
  units::Region section;
  std::vector<units::Remainder> voids;  ///< without names
};

/// Closes voids that no way in the half section leads to. Where the solid itself has no cavity,
/// faces that are not turned open them, and no turning tool goes that way; a void thinner than
/// free-form faces are known is none. Voids of a solid with a cavity stay, for planning to refuse.
Filled without_voids(units::Region section, bool solid_has_cavity);

}  // namespace ridgeline::part
