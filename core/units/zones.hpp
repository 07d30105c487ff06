#pragma once

#include <vector>

#include "core/units/program.hpp"

namespace ridgeline::units {

/// A part of the half section around the product that belongs to one kind of unit and one process
/// (S407 to S409, document 004). Zones do not overlap; with S they fill the section.
struct Zone {
  UnitKind kind = UnitKind::BarOuter;
  int process = 1;
  Region region;
  bool ends_at_split = false;  ///< the same kind of the other process goes on beyond the split
  double split = 0;            ///< Z of the split, where it ends there
  double overlap = 0;          ///< declared extension over the split
  std::optional<std::size_t> beyond = {};  ///< the zone on the other side of the split
  std::optional<Hole> hole = {};           ///< a hole on the axis
};

/// Front and back; outer, split; every inner void, split where both ends are open, else wholly of
/// the process that reaches it; holes on the axis; grooves. `stock` bounds them. Throws
/// Error{Unsupported} for a closed cavity.
std::vector<Zone> zones(const Product& product, const Region& stock, const Split& split,
                        const Parameters& parameters);

/// Where the split goes when the operator does not say: outer in the middle of the largest
/// diameter, inner in the middle of the narrowest stretch of the bore, overlaps 5 mm.
Split usual_split(const Product& product);

}  // namespace ridgeline::units
