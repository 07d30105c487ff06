#pragma once

#include <cmath>

namespace ridgeline {

/// A function of one variable with its first two derivatives; the second may be approximate.
struct RootSample {
  double value = 0;
  double slope = 0;
  double second = 0;
};

struct Root {
  double x = 0;
  double residual = 0;  ///< f(x)
  int iterations = 0;   ///< evaluations of f
  bool converged = false;
};

/// Root of f in [low, high], where f is negative before it and positive after it. Halley steps from
/// x; a step that leaves the bracket is replaced by its middle. Done when |f(x)| <= tolerance, or
/// when the bracket has no number left inside: then converged tells whether f really vanishes.
template <class Function>
Root rising_root(const Function& f, double low, double high, double x, double tolerance) {
  constexpr int max_iterations = 100;
  Root root{.x = x};
  while (root.iterations < max_iterations) {
    const RootSample sample = f(root.x);
    ++root.iterations;
    root.residual = sample.value;
    if (std::abs(sample.value) <= tolerance) {
      root.converged = true;
      return root;
    }
    (sample.value < 0 ? low : high) = root.x;
    const double halley = sample.slope * sample.slope - 0.5 * sample.value * sample.second;
    double next = root.x - sample.value * sample.slope / halley;
    if (!(next > low && next < high)) next = low + 0.5 * (high - low);
    if (!(next > low && next < high)) return root;
    root.x = next;
  }
  return root;
}

}  // namespace ridgeline
