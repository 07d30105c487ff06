#pragma once

#include "core/units/product.hpp"
#include "part/lumps.hpp"

namespace ridgeline::part {

struct Features {
  std::vector<units::Hole> holes;
  std::vector<units::MilledFace> faces;
  std::vector<units::Remainder> remainders;
};

/// What every lump is: holes by their round walls, flats, slots and pockets by a plane bottom or a
/// common direction of their walls; what is neither, with the reason. The volume of a lump is
/// shared out by the shapes in it.
Features features_of(const Placed& part, const Envelope& envelope, const std::vector<Lump>& lumps);

}  // namespace ridgeline::part
