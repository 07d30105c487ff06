#pragma once

#include <optional>

#include "core/cutting/compliance.hpp"
#include "core/cutting/cut.hpp"

namespace ridgeline::cutting {

/// A time domain that keeps the surface itself, as a height map over the plane that is cut, and
/// takes off it what each edge sweeps at each step: what the iteration is compared with in time.
/// Ball, one plane and its grooves.
struct SurfaceRun {
  std::optional<double> e;  ///< of the last revolution [mm]
  int revolutions = 0;
};
SurfaceRun surface_run(const Cut& cut, const Compliance& compliance, double S, int revolutions,
                       double cell);

}  // namespace ridgeline::cutting
