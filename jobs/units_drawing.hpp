#pragma once

#include <string>

#include "core/units/program.hpp"

namespace ridgeline::jobs {

/// Name of the product, or what a program is.
std::string title_of(const units::Program& program);

/// The half section of a program as SVG: stock, product, every unit in its colour, milled features
/// where they are, and a legend.
std::string units_svg(const units::Program& program);

/// The tree and the volumes for a terminal.
std::string units_text(const units::Program& program);

}  // namespace ridgeline::jobs
