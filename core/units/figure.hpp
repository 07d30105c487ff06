#pragma once

#include "core/units/program.hpp"

namespace ridgeline::units {

/// Writes start and FIG of a turned unit for its region (S801 to S806): faces their diagonal, bars
/// the chain of the product side in feed order, others their outline.
void draw_figure(Unit& unit);

/// The plane region that start and FIG of a turned unit say (S1101 to S1104; holes on the axis
/// S1107 to S1109): what would be cut if all of it were material. Throws Error{BadInput} for a FIG
/// that bounds nothing.
Region figure_region(const Unit& unit);

/// For each z the least or the greatest r of a region, with steps in between. Ascending in z.
enum class Limit { Least, Greatest };
std::vector<Segment> limit_of(const Region& region, Limit limit);

/// Does the kind turn? Holes do when they lie on the turning axis.
bool is_turned(const Unit& unit);

}  // namespace ridgeline::units
