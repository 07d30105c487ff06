#pragma once

#include <vector>

#include "core/cutting/compliance.hpp"

namespace ridgeline::cutting {

/// A piece of the tool with one radius, from the tip upwards.
struct BeamPart {
  double radius = 0;  ///< that carries load: of a fluted part about 0.8 of the cutting radius [mm]
  double length = 0;  ///< [mm]
};

/// A tool as a stepped beam held in its holder.
struct Beam {
  std::vector<BeamPart> parts;  ///< from the loaded point to the holder
  double modulus = 600e3;       ///< cemented carbide [N/mm2]
  double density = 14.5e-9;     ///< [t/mm3 = N s2/mm4]
  double tip_mass = 0;          ///< of the ball, at the loaded point [t]
  double damping = 0.02;        ///< of each mode: a guess, no model gives it
  double holder_stiffness = 0;  ///< of the clamping, across, at the holder [N/mm]; 0: rigid
};

/// What the beam gives at its loaded point. An estimate: the clamping and the damping decide and
/// are not known from geometry.
struct BeamModes {
  double static_stiffness = 0;  ///< of the beam, all modes [N/mm]
  Modes modes;                  ///< the first ones, in order of frequency
};

/// Hermite beam elements (Euler-Bernoulli, consistent mass). The last mode's stiffness is lowered
/// so that the modes together have the static compliance. Throws Error{BadInput}.
BeamModes beam_modes(const Beam& beam, int count);

}  // namespace ridgeline::cutting
