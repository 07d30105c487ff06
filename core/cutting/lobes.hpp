#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/cutting/floquet.hpp"

namespace ridgeline::cutting {

/// A straight-fluted cut with mean directional coefficients: the zeroth-order solution of Altintas
/// and Budak. Angles from the direction where a chip of up-milling begins.
struct SteadyEngagement {
  double Kt = 0;  ///< tangential [N/mm2]
  double Kr = 0;  ///< radial [N/mm2]
  int teeth = 0;
  double entry = 0;  ///< [rad]
  double exit = 0;   ///< [rad]
};

/// A border of stability: this depth chatters at this frequency, at these spindle speeds.
struct LobePoint {
  double depth = 0;            ///< axial [mm]
  double frequency = 0;        ///< of the chatter [Hz]
  std::vector<double> speeds;  ///< of lobe 0, 1, ... [rev/s]
};

/// Both branches at each chatter frequency, where the depth is positive. Compliance: X feed, Y
/// across.
std::vector<LobePoint> zeroth_order_lobes(const Compliance& compliance,
                                          const SteadyEngagement& engagement,
                                          const std::vector<double>& frequencies, int lobes);

/// Depths to look through for one that chatters.
struct DepthRange {
  double from = 0;
  double to = 0;
  int steps = 0;
};

/// Smallest depth of cut that chatters at a speed [rev/s], by the Floquet multiplier of the cut
/// that `cut_of` gives for a depth: scanned in steps, then halved 12 times. nullopt: none in the
/// range.
std::optional<double> chatter_depth(const std::function<Cut(double depth)>& cut_of,
                                    const Compliance& compliance, double S,
                                    const DepthRange& depths, Engaging engaging);

}  // namespace ridgeline::cutting
