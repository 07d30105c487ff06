#include "core/cutting/carve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ridgeline::cutting {
namespace {

// Brute force: the lowest of 20,000 balls along the way.
TEST(Carve, SweptHeightIsTheEnvelopeOfBalls) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-4, 4);
  constexpr double none = 1e9, r = 2;
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d from(place(random), place(random), place(random));
    const Eigen::Vector3d to(place(random), place(random), place(random));
    const Eigen::Vector2d at(place(random), place(random));
    double lowest = none;
    constexpr int balls = 20000;
    for (int k = 0; k <= balls; ++k) {
      const Eigen::Vector3d c = from + (to - from) * (static_cast<double>(k) / balls);
      const double room = r * r - (at - c.head<2>()).squaredNorm();
      if (room >= 0) lowest = std::min(lowest, c.z() - std::sqrt(room));
    }
    const double swept = swept_height(from, to, r, at, none);
    if (lowest == none) continue;
    ++met;
    EXPECT_NEAR(swept, lowest, 2e-2) << i;  // at the rim a ball's height is steep
    EXPECT_LE(swept, lowest + 1e-12);
  }
  EXPECT_GT(met, 80);
}

TEST(Carve, GrooveOfALevelPass) {
  HeightMap map = block_map({0, 0, -5}, {10, 10, 0}, 0.1);
  ASSERT_EQ(map.columns, 101);
  carve(map, {-5, 5, 1}, {15, 5, 1}, 2);
  EXPECT_NEAR(height_at(map, 5, 5), -1, 1e-12);
  EXPECT_NEAR(height_at(map, 5, 6), 1 - std::sqrt(3), 1e-12);
  EXPECT_NEAR(height_at(map, 5, 8), 0, 1e-12);
  carve(map, {-5, 5, 3}, {15, 5, 3}, 2);  // above what is gone: nothing grows back
  EXPECT_NEAR(height_at(map, 5, 5), -1, 1e-12);
}

}  // namespace
}  // namespace ridgeline::cutting
