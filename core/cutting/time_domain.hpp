#pragma once

#include "core/cutting/iterate.hpp"

namespace ridgeline::cutting {

/// How far the time is stepped.
struct TimeOptions {
  int max_revolutions = 100;
  double largest = 1;       ///< displacement, of the radius, that ends the run as unstable
  double tolerance = 1e-8;  ///< sum |D - D a revolution before|^2 over sum |D|^2
};

/// What a cut settles to. Flip: repeats after two tooth periods, not after one. Unstable: neither.
enum class Stability { Stable, Flip, Unstable };

/// Revolution after revolution of the same cut, step by step, until it repeats.
struct TimeDomain {
  std::optional<double> e;  ///< of the last revolution [mm]
  bool converged = false;
  int revolutions = 0;
  std::vector<double> change;  ///< of each revolution against the one before, as the tolerance
  double tooth_change = 0;     ///< of the last against itself one tooth period before, likewise
  double flip_change = 0;      ///< two tooth periods before
  Forces F;                    ///< of the last revolution, N samples
  Deflections D;
};

/// The time-domain method ("conventional method 2"), from rest: modal equations with the force
/// linear between samples, predicted, corrected once; the surface is kept as the history of the
/// deflection. Throws Error{Unsupported} for a measured response, which has no equation of motion,
/// and Error{NotConverged} when the vibration outgrows the tool.
TimeDomain time_domain(const Cut& cut, const Compliance& compliance, double S,
                       const TimeOptions& options, const Progress& progress = {});

/// What the end of a run shows: a change under 3 % rms counts as none. The tooth period of a cutter
/// with unlike teeth is the revolution.
Stability stability_of(const TimeDomain& run);

/// Runs the time domain with three earlier teeth, which is what a tool that chatters really meets,
/// and tells what it settles to. The iteration cannot: its fixed point exists where the cut is
/// unstable (design: section 4).
Stability stability(const Cut& cut, const Compliance& compliance, double S,
                    const Progress& progress = {});

}  // namespace ridgeline::cutting
