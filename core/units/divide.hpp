#pragma once

#include <span>

#include "core/units/program.hpp"
#include "core/units/zones.hpp"

namespace ridgeline::units {

/// What shall be divided into turned units.
struct Division {
  Region remaining;  ///< R: material that no unit removes yet
  Region turned;     ///< T: all that is turned in the program
  Region blocked;    ///< cores of edited units: no extension enters them
  std::span<const Zone> zones;
  std::span<const Removed> removed;
  int process = 1;  ///< of the edited unit: what is left on the side of process 1 is its own work
};

struct Divided {
  std::vector<Unit> units;  ///< one for each connected piece, not ordered
  double left = 0;          ///< what nobody takes [mm^3]
  std::vector<std::string> notes;
};

/// S407 to S409 and S801 to S806, and the rule "v2" of design 1.9: extensions over the split only
/// where the section goes on beyond it, never into an edited core.
Divided divide(const Division& division);

}  // namespace ridgeline::units
