#pragma once

#include "core/units/program.hpp"

namespace ridgeline::units {

/// The bookkeeping of a program. Turned overlaps are measured from the regions, not taken from how
/// they were made: what is covered more often than once is declared where it lies in an extension
/// over a split, else undeclared; what is not covered is left.
Volumes measured_volumes(const Program& program);

}  // namespace ridgeline::units
