#pragma once

#include <complex>

#include "core/cutting/iterate.hpp"

namespace ridgeline::cutting {

/// Which chips the perturbed cut has. Frozen: those of the steady cut, as the literature's lobes.
/// Moving: also what entering and leaving the stock a little earlier does.
enum class Engaging { Frozen, Moving };

/// Dominant Floquet multiplier of a steady cut: by how much a small deviation from it grows from
/// tooth to tooth (from revolution to revolution of a cutter with unlike teeth). The cut chatters
/// where |mu| > 1: near -1 it flips. `D` is the steady deflection over N samples or a tooth pitch.
/// Linear theory on the samples of the cut, force linear between them. Throws Error{Unsupported}
/// for a measured response.
std::complex<double> floquet_multiplier(const Cut& cut, const Compliance& compliance, double S,
                                        const Deflections& D, Engaging engaging);

}  // namespace ridgeline::cutting
