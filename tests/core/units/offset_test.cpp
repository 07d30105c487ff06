#include "core/units/offset.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/units/contour.hpp"
#include "core/units/overlay.hpp"
#include "tests/core/units/shapes.hpp"

namespace ridgeline::units {
namespace {

constexpr double pi = std::numbers::pi;

double distance_to(const std::vector<Contour>& outline, const Point& p) {
  double least = HUGE_VAL;
  for (const Contour& contour : outline) {
    for (const Segment& segment : contour) {
      if (segment.start.r < 1e-9 && segment.end.r < 1e-9) continue;
      for (int i = 0; i <= 300; ++i) {
        const Point q = point_at(segment, i / 300.0);
        least = std::min(least, std::hypot(p.r - q.r, p.z - q.z));
      }
    }
  }
  return least;
}

TEST(Offset, RectangleGrowsByBandsAndQuarterDiscs) {
  const Region a = grown(rectangle(10, 14, 0, 6), 1.5);
  EXPECT_NEAR(area(a), 4 * 6 + 2 * 1.5 * (4 + 6) + pi * 1.5 * 1.5, 1e-9);
}

// At the mouth of the removed neck the corners stay 1 mm away: between z 4 and 5 the inner part
// reaches to 20 - sqrt(1 - t^2), t the distance from the nearer corner; integral 2 (1/2 - (sin(2a)
// + 2a)/4), a = asin(1/2).
TEST(Offset, ShrinkingRemovesWhatIsThinnerThanTwice) {
  const std::vector<Region> parts{rectangle(10, 20, 0, 10), rectangle(20, 40, 4, 5)};
  const Region inner = shrunk(union_of(parts), 1);
  const double bump = 1 - (std::sqrt(3) / 4 + pi / 6);
  EXPECT_NEAR(area(inner), 8 * 8 + bump, 1e-9);
}

TEST(Offset, TheAxisIsNoBoundary) {
  EXPECT_NEAR(volume(shrunk(rectangle(0, 5, 0, 10), 1)), pi * 16 * 8, 1e-9);
  EXPECT_NEAR(volume(grown(rectangle(0, 5, 0, 10), 1)),
              pi * 25 * 12 + pi * 11 * 10 + 2 * (pi * 5 * 0.5 * pi + 2 * pi / 3), 1e-9);
}

TEST(Offset, DistanceDecidesAtPoints) {
  shapes::Random random(5);
  int checked = 0;
  for (int k = 0; k < 40; ++k) {
    SCOPED_TRACE(k);
    const Region a = shapes::region(random, k % 2 == 0 ? 0.5 : 0);
    const double d = shapes::between(random, 0.1, 3);
    const Region out = grown(a, d);
    const Region in = shrunk(a, d);
    const std::vector<Contour> outline = contours(a);
    for (int i = 0; i < 50; ++i) {
      const Point at{shapes::between(random, 0, 36), shapes::between(random, -6, 60)};
      const double away = distance_to(outline, at);
      if (std::abs(away - d) < 0.02 || away < 0.02) continue;
      const bool inside = covers(a, at);
      EXPECT_EQ(covers(out, at), inside || away < d);
      EXPECT_EQ(covers(in, at), inside && away > d);
      ++checked;
    }
  }
  EXPECT_GT(checked, 1500);
}

}  // namespace
}  // namespace ridgeline::units
