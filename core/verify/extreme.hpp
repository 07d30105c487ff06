#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace ridgeline::verify {

/// A largest value and the (real) index where it is.
struct Extreme {
  double value = 0;
  double at = 0;
};

/// Largest value of f between the indices low and high: golden section, f with one peak there.
template <typename Function>
Extreme golden_maximum(const Function& f, double low, double high, double settled) {
  constexpr double g = 0.6180339887498949;
  double x1 = high - g * (high - low);
  double x2 = low + g * (high - low);
  double f1 = f(x1);
  double f2 = f(x2);
  while (high - low > settled) {
    if (f1 > f2) {
      high = x2;
      x2 = x1;
      f2 = f1;
      x1 = high - g * (high - low);
      f1 = f(x1);
    } else {
      low = x1;
      x1 = x2;
      f1 = f2;
      x2 = low + g * (high - low);
      f2 = f(x2);
    }
  }
  return f1 > f2 ? Extreme{f1, x1} : Extreme{f2, x2};
}

/// Closed: index n is index 0 again.
enum class Ends { Open, Closed };

/// Largest value of a function sampled at the whole indices 0 .. n-1.
/// Peaks are refined best first, while what they may still gain over their sample (the step to a
/// neighbour) could beat the best so far by more than `worth`.
template <typename Function>
Extreme sampled_maximum(const std::vector<double>& samples, const Function& f, Ends ends,
                        double worth) {
  const bool closed = ends == Ends::Closed;
  constexpr double settled = 1e-4;        // of an index step
  constexpr std::size_t most_peaks = 24;  // on a flat stretch every sample is one
  const std::size_t n = samples.size();
  const auto before = [&](std::size_t i) { return i > 0 ? i - 1 : closed ? n - 1 : 0; };
  const auto after = [&](std::size_t i) { return i + 1 < n ? i + 1 : closed ? 0 : n - 1; };
  const auto hope = [&](std::size_t i) {
    const double rise = std::max(samples[i] - samples[before(i)], samples[i] - samples[after(i)]);
    return std::isfinite(rise) ? samples[i] + rise : samples[i];
  };
  std::vector<std::size_t> peaks;
  Extreme best{-HUGE_VAL, 0};
  for (std::size_t i = 0; i < n; ++i) {
    if (samples[i] > best.value) best = {samples[i], static_cast<double>(i)};
    if (samples[i] >= samples[before(i)] && samples[i] >= samples[after(i)]) peaks.push_back(i);
  }
  std::sort(peaks.begin(), peaks.end(),
            [&](std::size_t a, std::size_t b) { return hope(a) > hope(b); });
  std::size_t refined = 0;
  for (const std::size_t i : peaks) {
    if (!(hope(i) > best.value + worth) || ++refined > most_peaks) break;
    const double middle = static_cast<double>(i);
    const double low = i > 0 || closed ? middle - 1 : middle;
    const double high = i + 1 < n || closed ? middle + 1 : middle;
    const Extreme peak = golden_maximum(f, low, high, settled);
    if (peak.value > best.value) best = peak;
  }
  return best;
}

}  // namespace ridgeline::verify
