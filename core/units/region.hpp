#pragma once

#include <vector>

#include "core/units/curve.hpp"

namespace ridgeline::units {

/// Between two curves from z0 to z1; inner.r <= outer.r there.
struct Cell {
  double z0 = 0;
  double z1 = 0;
  Curve inner;
  Curve outer;
};

/// A plane region of the half section, bounded by lines and circles: cells in slabs. Cells of one
/// slab share z0 and z1 exactly and do not touch; slabs do not overlap; sorted by z0, then by r.
/// Only the functions of overlay.hpp and contour.hpp make regions.
struct Region {
  std::vector<Cell> cells;
};

inline bool is_empty(const Region& region) {
  return region.cells.empty();
}

/// Volume of the region revolved about the axis [mm^3].
double volume(const Region& region);

/// Area of the region [mm^2].
double area(const Region& region);

/// Extents of a region; all 0 for the empty one.
struct Box {
  double r0 = 0;
  double r1 = 0;
  double z0 = 0;
  double z1 = 0;
};
Box box(const Region& region);

/// Greatest radial thickness of the cells where they are widest [mm], a bound from above for the
/// diameter of the greatest circle inside. Used to tell slivers from work.
double thickness(const Region& region);

/// Is the point inside or within `margin` of it along r?
bool covers(const Region& region, const Point& point, double margin = 0);

/// r0 <= r <= r1, z0 <= z <= z1.
Region rectangle(double r0, double r1, double z0, double z1);

/// The connected pieces; pieces that meet in a point are apart. Ordered by their least z, then r.
std::vector<Region> pieces(const Region& region);

}  // namespace ridgeline::units
