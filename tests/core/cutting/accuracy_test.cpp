// The claim of document 001: the accuracy of a time domain at nearly the cost of the rigid method.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/cutting/predict.hpp"

namespace ridgeline::cutting {
namespace {

// Third pass of the base case: ball r = 6, plane of 45 degrees, two grooves beside.
Cut base_cut(double feed) {
  constexpr double r = 6, depth = 0.23, pick = 0.49;
  const double h = std::numbers::sqrt2 / 2;
  Cut cut;
  cut.cutter.r = r;
  cut.cutter.pitch = equal_pitch(2);
  cut.cutter.helix = std::numbers::pi / 6;
  cut.coefficients = {796.1, 27.7, 168.8, 30.8, 0, 0};
  cut.n = {-h, 0, h};
  cut.feed = feed;
  cut.samples = 1024;
  cut.stock.faces = {HalfSpace{cut.n, depth - r}};
  for (int i = 1; i <= 2; ++i)
    cut.stock.grooves.push_back({{-h * pick * i, 0, -h * pick * i}, feed_direction(cut), r});
  return cut;
}

struct Sum {
  double squares = 0;
  int count = 0;
  void add(double e, double reference) {
    squares += 1e6 * (e - reference) * (e - reference);
    ++count;
  }
  double rms() const { return std::sqrt(squares / count); }  // um
};

// Every 500 rev/min here; every 100 in the benchmark. Speeds that chatter are left out.
TEST(Accuracy, IterationFollowsTheTimeDomainOverTheSpeed) {
  const Modes mode{{1100, 0.03, 2000}};
  const Compliance compliance{mode, mode, Eigen::Matrix2d::Identity()};
  const Cut cut = base_cut(0.2);
  Cut real = cut;
  real.earlier_teeth = 3;
  IterateOptions tight;
  tight.alpha = 1e-4;
  Sum rigid_sum, loose_sum, tight_sum;
  int chatter = 0;
  for (int rpm = 1000; rpm <= 16000; rpm += 500) {
    const double S = rpm / 60.0;
    const TimeDomain run = time_domain(real, compliance, S, {.max_revolutions = 120});
    if (stability_of(run) != Stability::Stable) {
      ++chatter;
      continue;
    }
    rigid_sum.add(*rigid(cut, compliance, S, Span::Pitch).e, *run.e);
    loose_sum.add(*iterate(cut, compliance, S, {}).e, *run.e);
    tight_sum.add(*iterate(cut, compliance, S, tight).e, *run.e);
  }
  EXPECT_GE(loose_sum.count, 26);
  EXPECT_LE(chatter, 5);
  EXPECT_LE(loose_sum.rms(), 0.25);
  EXPECT_LE(tight_sum.rms(), 0.12);
  EXPECT_GT(rigid_sum.rms(), 2);  // what it is worth
}

}  // namespace
}  // namespace ridgeline::cutting
