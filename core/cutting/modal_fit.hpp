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

}  // namespace ridgeline::cutting
