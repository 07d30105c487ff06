#pragma once

#include <string>

#include "core/cutting/time_domain.hpp"

namespace ridgeline::cutting {

enum class Method { Iterate, Rigid, TimeDomain };

/// One engagement at one speed and how to predict it.
struct Engagement {
  Cut cut;
  Compliance compliance;
  double S = 0;  ///< spindle speed [rev/s]
  IterateOptions options;
  TimeOptions time;
  bool fall_back = true;  ///< to the time domain when the iteration does not converge
};

/// A prediction and the way that gave it.
struct Predicted {
  Method method = Method::Iterate;  ///< TimeDomain after a fall-back
  bool fell_back = false;
  Prediction
      prediction;  ///< after a fall-back: e, F, D of the time domain, the rest of the iteration
  int revolutions = 0;         ///< of the time domain
  std::vector<double> change;  ///< of the time domain, per revolution
};

/// Predicts by the method asked for; a cut whose iteration does not converge is stepped through
/// time instead. The time domain moves by modes: of a measured response by those fitted to it.
/// Throws Error{NotConverged} when neither gives an answer and a fall-back was
/// wanted.
Predicted predict(const Engagement& engagement, Method method, const Deflections& start = {},
                  const Progress& progress = {});

}  // namespace ridgeline::cutting
