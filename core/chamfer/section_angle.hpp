#pragma once

#include "core/chamfer/section.hpp"

namespace ridgeline::chamfer {

struct TableAngle {
  double delta = 0;  ///< [rad]
  double slope = 0;  ///< d delta / d phi, of the piece that phi is on
};

/// delta of a table at phi: linear between entries, periodic in 2 pi.
TableAngle table_angle(const AngleTable& table, double phi);

/// Throws Error{BadInput} unless the table has entries, ascending in phi within one turn.
void require_table(const AngleTable& table);

}  // namespace ridgeline::chamfer
