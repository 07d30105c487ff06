#pragma once

#include <optional>
#include <string>

#include "core/units/product.hpp"
#include "part/lumps.hpp"

namespace ridgeline::part {

/// A flat, step, slot or pocket of some faces, or why they are none.
struct Pocket {
  std::optional<units::MilledFace> face;
  std::string why;
};

/// All walls run along one direction; a plane across it is the bottom, or the pocket goes through.
Pocket pocket_of(const Placed& part, const Envelope& envelope, const std::vector<int>& faces);

}  // namespace ridgeline::part
