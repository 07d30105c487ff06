#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/units/region.hpp"

namespace ridgeline::units {

/// The most operands of one overlay: a cell tells its operands as bits.
constexpr std::size_t overlay_limit = 64;

/// A cell that no curve of any operand enters, and the operands that cover it.
struct OverlayCell {
  double z0 = 0;
  double z1 = 0;
  const Curve* inner = nullptr;
  const Curve* outer = nullptr;
  std::uint64_t covered = 0;  ///< bit i: operand i
};

/// The operands cut along all their limits, curves and crossings. Every boolean of them is a choice
/// of cells, so the parts of any division add up to the whole. Points into the operands, which must
/// outlive it.
struct Overlay {
  std::vector<OverlayCell> cells;  ///< sorted as the cells of a Region, none empty
};

/// One oriented piece of the boundary of an operand, from z0 to z1. Crossing it outwards adds
/// `winding` to the winding number of the operand.
struct BoundaryPiece {
  const Curve* curve = nullptr;
  double z0 = 0;
  double z1 = 0;
  int operand = 0;
  int winding = 0;
};

/// Cuts everything by everything; an operand covers where its winding number is not 0.
Overlay overlay(std::vector<BoundaryPiece> boundary);

/// Of regions, at most overlay_limit.
Overlay overlay(std::span<const Region* const> operands);

/// The cells that `choose(covered)` takes, merged into as few as they can be.
template <class Choose>
Region select(const Overlay& overlay, const Choose& choose);

Region intersection_of(const Region& a, const Region& b);
Region difference_of(const Region& a, const Region& b);
/// All of them together, any number.
Region union_of(std::span<const Region> regions);
/// Volume of what only one of them has [mm^3].
double symmetric_difference(const Region& a, const Region& b);

namespace detail {

/// Builds a region from cells that come in order.
class RegionBuilder {
public:
  void add(const OverlayCell& cell);
  Region finish();

private:
  void close_slab();

  Region region_;
  std::vector<Cell> slab_;
  std::size_t last_ = 0;  ///< first cell of the last slab in region_
  const Curve* open_ = nullptr;
};

}  // namespace detail

template <class Choose>
Region select(const Overlay& overlay, const Choose& choose) {
  detail::RegionBuilder builder;
  for (const OverlayCell& cell : overlay.cells) {
    if (choose(cell.covered)) builder.add(cell);
  }
  return builder.finish();
}

}  // namespace ridgeline::units
