#include "core/chamfer/border.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector3d;

// Oracle: central difference of section_at, step chosen for 1e-7 relative.
TEST(BorderRates, MatchCentralDifferencesOfTheSectionPoint) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr double h = 1e-5;
  int checked = 0;
  for (int i = 0; i < 400; ++i) {
    const double R1 = 8 + 30 * unit(random);
    const double half = R1 * (0.2 + 0.4 * unit(random));
    const double across = i % 3 == 2 ? half * unit(random) : 0;
    const double beta = radians(100 * unit(random) - 50);
    geometry::Edge edge;
    edge.profile = {.R2 = half - across / 2,
                    .straight_along = i % 3 == 0 ? 0 : 8 * unit(random),
                    .straight_across = across};
    edge.body = geometry::Cylinder{.point = {(1.6 * unit(random) - 0.8) * (R1 - half), 0, 0},
                                   .axis = {0, std::cos(beta), std::sin(beta)},
                                   .radius = R1};
    edge.m = i % 2 == 0 ? 1 : -1;
    Chamfer chamfer{.W = 0.4, .D = 1.5};
    if (i % 4 == 1) chamfer.section_angle = ConstantAngle{.delta = radians(40)};
    if (i % 4 == 2) {
      chamfer.section_angle =
          AngleTable{.entries = {{.phi = 0.3, .delta = 0.7}, {.phi = 3.0, .delta = 0.9}}};
    }
    const double u = unit(random);
    bool near_joint = std::abs(u * 2 * 3.141592653589793 - 0.3) < 1e-3;
    for (const double joint : geometry::joints(edge.profile))
      near_joint |= std::abs(u - joint) < 1e-3;
    if (near_joint) continue;
    SCOPED_TRACE(testing::Message() << "edge " << i << " u=" << u);
    const Section ready = section(edge, chamfer);
    try {
      section_at(ready, u);
    } catch (const Error&) {
      continue;  // this section angle leaves a surface there
    }
    const BorderRates rates = border_rates(ready, section_at(ready, u), u);
    const SectionPoint after = section_at(ready, u + h);
    const SectionPoint before = section_at(ready, u - h);
    const auto near = [&](const Vector3d& rate, const Vector3d& difference) {
      EXPECT_NEAR((rate - difference / (2 * h)).norm(), 0, 2e-6 * (1 + rate.norm()));
    };
    near(rates.G1, after.G1 - before.G1);
    near(rates.G2, after.G2 - before.G2);
    near(rates.P, after.ridge.P - before.ridge.P);
    const SectionPoint here = section_at(ready, u);
    EXPECT_NEAR((rates.P2 - (after.ridge.P - 2 * here.ridge.P + before.ridge.P) / (h * h)).norm(),
                0, 2e-3 * (1 + rates.P2.norm()));
    ++checked;
  }
  EXPECT_GT(checked, 340);
}

}  // namespace
}  // namespace ridgeline::chamfer
