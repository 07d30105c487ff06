#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace ridgeline::part {

/// The greatest value of a function with one maximum from low to high, by golden section: 1e-6 of
/// the range is 1e-12 of the value, which is level there.
template <class F>
double greatest(double low, double high, const F& f) {
  constexpr int steps = 28;
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double at_a = f(a), at_b = f(b);
  double found = std::max(at_a, at_b);
  for (int k = 0; k < steps; ++k) {
    if (at_a > at_b) {
      high = std::exchange(b, a);
      at_b = at_a;
      a = high - ratio * (high - low);
      found = std::max(found, at_a = f(a));
    } else {
      low = std::exchange(a, b);
      at_a = at_b;
      b = low + ratio * (high - low);
      found = std::max(found, at_b = f(b));
    }
  }
  return found;
}

}  // namespace ridgeline::part
