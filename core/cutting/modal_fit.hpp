#pragma once

#include "core/cutting/compliance.hpp"

namespace ridgeline::cutting {

/// Modes that follow a measured response.
struct ModalFit {
  Modes modes;
  double misfit = 0;  ///< rms of fit - measurement over rms of the measurement, over all lines
};

/// Fits one mode to each peak: frequency and damping by Gauss-Newton, stiffness linear. Throws
/// Error{NotConverged} when the response has no peak or the modes miss it by more than a third.
ModalFit fit_modes(const MeasuredResponse& measured);

/// The compliance with modes fitted to what is a measurement; for what needs an equation of motion.
/// Throws as fit_modes() does.
Compliance with_modes(const Compliance& compliance);

/// Is a direction a measured response?
bool is_measured(const Compliance& compliance);

}  // namespace ridgeline::cutting
