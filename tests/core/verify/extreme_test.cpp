#include "core/verify/extreme.hpp"

#include <gtest/gtest.h>

namespace ridgeline::verify {
namespace {

// Highest at 33.3, between two samples, on a ripple whose samples are all lower.
TEST(Extreme, FindsAPeakBetweenSamples) {
  const auto f = [](double i) { return 5 - std::abs(i - 33.3) + 0.1 * std::cos(6 * i); };
  std::vector<double> samples;
  for (int i = 0; i < 100; ++i) samples.push_back(f(i));
  const Extreme peak = sampled_maximum(samples, f, Ends::Open, 1e-9);
  double best = 0;
  for (double i = 33; i < 34; i += 1e-5) best = std::max(best, f(i));
  EXPECT_NEAR(peak.value, best, 1e-4);
  EXPECT_NEAR(peak.at, 33.3, 0.2);
}

TEST(Extreme, ClosedSamplesHaveAPeakAcrossTheSeam) {
  const auto f = [](double i) { return std::cos((i + 0.4) * 0.0628318530717958647); };
  std::vector<double> samples;
  for (int i = 0; i < 100; ++i) samples.push_back(f(i));
  EXPECT_NEAR(sampled_maximum(samples, f, Ends::Closed, 1e-9).value, 1, 1e-9);
  EXPECT_NEAR(sampled_maximum(samples, f, Ends::Open, 1e-9).value, f(0), 1e-9);
}

}  // namespace
}  // namespace ridgeline::verify
