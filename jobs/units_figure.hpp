#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/units/program.hpp"

/// The half section of a program as loops of points (z, r), for pictures.
namespace ridgeline::jobs {

using Loops = std::vector<std::vector<Eigen::Vector2d>>;

/// The boundary of a region, arcs as chords; what an even number of loops encloses is a hole.
Loops half_section(const units::Region& region);

/// What a unit removes; drilled holes and milled faces turned into the half section.
Loops half_section(const units::Unit& unit);

/// Hue of the i-th unit [degrees]: a golden angle apart, so that neighbours never look alike.
int hue_of_unit(std::size_t i);

}  // namespace ridgeline::jobs
