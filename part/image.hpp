#pragma once

#include <vector>

#include "part/meridian.hpp"

namespace ridgeline::part {

/// What free faces (neither coaxial nor across the axis) show in the half section, as cells whose
/// sides are lines, or the meridians that they end on. The product is never outside of them.
struct Image {
  struct Cell {
    double z0 = 0;
    double z1 = 0;
    units::Curve inner;
    units::Curve outer;
  };
  std::vector<Cell> cells;
};

/// Images of the faces in `free`, by number. Plane faces from their edges, exact; others from a
/// mesh.
Image image_of(const Placed& part, const TurnedFaces& turned, const std::vector<int>& free);

}  // namespace ridgeline::part
