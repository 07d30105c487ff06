#pragma once

#include <vector>

#include "core/units/contour.hpp"

/// What a turning tool for bars may come near to.
namespace ridgeline::units {

struct Interval {
  double z0 = 0;
  double z1 = 0;
};

/// A unit of bars seen so that the tool always comes from the far side of r and advances along
/// `way`: +1 to greater Z (process 1), -1 to smaller.
struct Bar {
  Region region;
  Region filled;  ///< the product with all that its tool cannot see
  bool is_outer = true;
  int way = 1;
};

/// The product and what lies behind its skin, as a tool from outside or from the bore sees it.
Region filled_behind(const Region& shadow, bool is_outer);

/// Where the centre of a nose may go at the nearest: the skin of the product at a distance, in
/// ascending Z, from z0 to z1. On the axis where the product is solid (bores).
std::vector<Segment> skin_of(const Bar& bar, double distance, double z0, double z1);

/// Where a skin leaves the line at r free, in ascending Z, within z0 to z1.
std::vector<Interval> free_on(const Bar& bar, const std::vector<Segment>& skin, double r, double z0,
                              double z1);

/// The steepest that the product side of a bar falls behind a nose that moves on [rad].
double steepest_fall(const Bar& bar);

}  // namespace ridgeline::units
