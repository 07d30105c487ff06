#include "core/units/region.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>

#include "core/units/contour.hpp"
#include "core/units/overlay.hpp"
#include "core/units/tolerance.hpp"
#include "tests/core/units/shapes.hpp"

namespace ridgeline::units {
namespace {

constexpr double pi = std::numbers::pi;

/// Random cases per test: a small share by default, as many as RIDGELINE_UNITS_CASES says.
int cases(int usual) {
  const char* wanted = std::getenv("RIDGELINE_UNITS_CASES");
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

Contour polygon(const std::vector<Point>& points) {
  Contour contour;
  for (std::size_t i = 0; i < points.size(); ++i)
    contour.push_back({points[i], points[(i + 1) % points.size()], {}});
  return contour;
}

/// Winding number by the angle that the loop turns about the point, arcs as chords of 1 degree: the
/// oracle, which knows nothing of slabs.
double winding(const Contour& contour, const Point& p) {
  double sum = 0;
  for (const Segment& segment : contour) {
    const int n = segment.arc ? 360 : 1;
    Point last = segment.start;
    for (int i = 1; i <= n; ++i) {
      const Point next = point_at(segment, static_cast<double>(i) / n);
      const double ar = last.r - p.r, az = last.z - p.z, br = next.r - p.r, bz = next.z - p.z;
      sum += std::atan2(az * br - ar * bz, az * bz + ar * br);
      last = next;
    }
  }
  return sum / (2 * pi);
}

double distance_to(const Contour& contour, const Point& p) {
  double least = HUGE_VAL;
  for (const Segment& segment : contour) {
    for (int i = 0; i <= 400; ++i) {
      const Point q = point_at(segment, i / 400.0);
      least = std::min(least, std::hypot(p.r - q.r, p.z - q.z));
    }
  }
  return least;
}

TEST(Region, ConeFrustumSphereAndTorusHaveTheirVolumes) {
  // pi h (r0^2 + r0 r1 + r1^2)/3
  const Region frustum = region_of(polygon({{0, 0}, {3, 0}, {5, 4}, {0, 4}}));
  EXPECT_NEAR(volume(frustum), pi * 4 * (9 + 15 + 25) / 3, 1e-10);
  const Region ball = region_of(Contour{
      {{0, -7}, {0, 7}, Segment::Round{{0, 0}, 7, Sense::Clockwise}}, {{0, 7}, {0, -7}, {}}});
  EXPECT_NEAR(volume(ball), 4 * pi * 343 / 3, 1e-9);
  const Region torus =
      region_of(Contour{{{10, -2}, {10, 2}, Segment::Round{{10, 0}, 2, Sense::Clockwise}},
                        {{10, 2}, {10, -2}, Segment::Round{{10, 0}, 2, Sense::Clockwise}}});
  EXPECT_NEAR(volume(torus), 2 * pi * pi * 10 * 4, 1e-9);  // 2 pi^2 R r^2
}

TEST(Region, CutsAtTheAxis) {
  const Region half = region_of(polygon({{-3, 0}, {3, 0}, {3, 2}, {-3, 2}}));
  EXPECT_NEAR(volume(half), pi * 9 * 2, 1e-12);
}

TEST(Region, WindingDecidesNestedLoops) {
  const Contour outer = polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  const Contour hole = polygon({{2, 2}, {2, 4}, {4, 4}, {4, 2}});
  const std::vector<Contour> loops{outer, hole};
  EXPECT_NEAR(area(region_of(loops)), 100 - 4, 1e-12);
}

TEST(Region, PiecesThatMeetInAPointAreApart) {
  const std::vector<Region> two{rectangle(0, 5, 0, 5), rectangle(5, 9, 5, 9)};
  EXPECT_EQ(pieces(union_of(two)).size(), 2u);
  const std::vector<Region> one{rectangle(0, 5, 0, 5), rectangle(4.9, 9, 5, 9)};
  EXPECT_EQ(pieces(union_of(one)).size(), 1u);
}

TEST(Region, LimitsWithinTheToleranceLeaveNoSliver) {
  const Region a = rectangle(0, 10, 0, 20);
  const Region b = rectangle(0, 10 + 4e-7, 20 - 4e-7, 30);
  EXPECT_TRUE(is_empty(intersection_of(a, b)));
  const Region c = rectangle(10 - 4e-7, 15, 3, 5);
  EXPECT_TRUE(is_empty(intersection_of(a, c)));
  EXPECT_EQ(contours(union_of(std::vector<Region>{a, b})).size(), 1u);
}

TEST(Region, OverlayAgreesWithWindingNumbersAtPoints) {
  shapes::Random random(20241);
  int checked = 0;
  const int n = cases(60);
  for (int k = 0; k < n; ++k) {
    SCOPED_TRACE(k);
    const double step = k % 2 == 0 ? 0.5 : 0;
    const Contour p = shapes::loop(random, step);
    const Contour q = shapes::profile(random, step);
    const Region a = region_of(p);
    const Region b = region_of(q);
    const Region both = intersection_of(a, b);
    const Region first = difference_of(a, b);
    const Region any = union_of(std::vector<Region>{a, b});
    for (int i = 0; i < 40; ++i) {
      const Point at{shapes::between(random, 0, 36), shapes::between(random, -6, 60)};
      if (distance_to(p, at) < 0.05 || distance_to(q, at) < 0.05) continue;
      const bool in_a = std::abs(winding(p, at)) > 0.5;
      const bool in_b = std::abs(winding(q, at)) > 0.5;
      EXPECT_EQ(covers(both, at), in_a && in_b);
      EXPECT_EQ(covers(first, at), in_a && !in_b);
      EXPECT_EQ(covers(any, at), in_a || in_b);
      ++checked;
    }
  }
  EXPECT_GT(checked, 30 * n);
}

/// Parts of any division add up: the closure that every volume of a program rests on.
TEST(Region, VolumesOfBooleansClose) {
  shapes::Random random(7);
  const int n = cases(20000);
  double worst = 0;
  for (int k = 0; k < n; ++k) {
    SCOPED_TRACE(k);
    const double step = k % 3 == 0 ? 0.5 : k % 3 == 1 ? 1e-4 : 0;
    const Region a = shapes::region(random, step);
    const Region b = shapes::region(random, step);
    const double va = volume(a);
    const double vb = volume(b);
    const double both = volume(intersection_of(a, b));
    const double any = volume(union_of(std::vector<Region>{a, b}));
    const double only_a = volume(difference_of(a, b));
    const double only_b = volume(difference_of(b, a));
    const double error = std::max({std::abs(both + any - va - vb), std::abs(only_a + both - va),
                                   std::abs(only_b + both - vb),
                                   std::abs(symmetric_difference(a, b) - only_a - only_b)});
    worst = std::max(worst, error / (va + vb));
    ASSERT_LT(error, 1e-7 * (va + vb));
  }
  RecordProperty("worst_relative_x1e15", static_cast<int>(worst * 1e15));
}

TEST(Region, NWayDivisionLosesNothing) {
  shapes::Random random(99);
  const int n = cases(1500);
  for (int k = 0; k < n; ++k) {
    SCOPED_TRACE(k);
    const double step = k % 2 == 0 ? 0.25 : 0;
    std::vector<Region> regions;
    for (int i = 0; i < 6; ++i) regions.push_back(shapes::region(random, step));
    std::vector<const Region*> operands;
    double sum = 0;
    for (const Region& region : regions) {
      operands.push_back(&region);
      sum += volume(region);
    }
    const Overlay cut = overlay(operands);
    double parts = 0;
    double weighted = 0;
    for (std::uint64_t mask = 1; mask < 64; ++mask) {
      const double v = volume(select(cut, [&](std::uint64_t c) { return c == mask; }));
      ASSERT_GE(v, -1e-6);
      parts += v;
      weighted += v * std::popcount(mask);
    }
    ASSERT_NEAR(weighted, sum, 1e-7 * sum);
    ASSERT_NEAR(parts, volume(union_of(regions)), 1e-7 * sum);
  }
}

TEST(Region, ContoursAndPiecesGiveTheRegionBack) {
  shapes::Random random(4);
  const int n = cases(3000);
  int loops = 0;
  for (int k = 0; k < n; ++k) {
    SCOPED_TRACE(k);
    const double step = k % 2 == 0 ? 0.5 : 0;
    const Region whole = shapes::region(random, step);
    const Region a = difference_of(whole, shapes::region(random, step));
    const std::vector<Contour> outline = contours(a);
    loops += static_cast<int>(outline.size());
    for (const Contour& loop : outline) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Point& end = loop[i].end;
        const Point& start = loop[(i + 1) % loop.size()].start;
        ASSERT_LT(std::hypot(end.r - start.r, end.z - start.z), 1e-12);
      }
    }
    ASSERT_LT(symmetric_difference(a, region_of(outline)), 1e-3 + 1e-9 * volume(a));
    double sum = 0;
    for (const Region& piece : pieces(a)) sum += volume(piece);
    ASSERT_NEAR(sum, volume(a), 1e-9 * volume(a) + 1e-9);
  }
  EXPECT_GT(loops, n);
}

}  // namespace
}  // namespace ridgeline::units
