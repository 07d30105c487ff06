#pragma once

#include <optional>

#include "core/units/product.hpp"
#include "part/lumps.hpp"

namespace ridgeline::part {

/// A drilled hole of a lump and the faces that it takes up.
struct Bore {
  units::Hole hole;
  std::vector<int> faces;
};

/// Concave cylinders and cones that close round one axis, with the planes across it between them
/// and at their bottom; grouped as one hole where they follow each other.
std::vector<Bore> bores_of(const Placed& part, const Envelope& envelope,
                           const std::vector<int>& faces);

}  // namespace ridgeline::part
