#include "jobs/contour.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "jobs/svg.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector2d;

double area(const std::vector<Vector2d>& curve) {
  double twice = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vector2d& a = curve[i];
    const Vector2d& b = curve[(i + 1) % curve.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2;
}

// A ring of radii 1 and 2: the outer curve counter-clockwise with area 4 pi, the hole clockwise
// with -pi.
TEST(Contours, RingGivesTwoCurvesWithTheMaterialOnTheirLeft) {
  const auto ring = [](const Vector2d& p) { return std::abs(p.norm() - 1.5) - 0.5; };
  const auto curves = contours(ring, {-3, -3}, {3, 3}, 200);
  ASSERT_EQ(curves.size(), 2u);
  const double a = area(curves[0]);
  const double b = area(curves[1]);
  EXPECT_NEAR(std::max(a, b), 4 * std::numbers::pi, 0.01);
  EXPECT_NEAR(std::min(a, b), -std::numbers::pi, 0.01);
}

// A half plane x < 0 over [-1, 1]^2 is closed along the border: a rectangle of area 1 * 2.
TEST(Contours, RegionAtTheBorderIsClosedAlongIt) {
  const auto curves = contours([](const Vector2d& p) { return p.x(); }, {-1, -1}, {1, 1}, 10);
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_NEAR(area(curves[0]), 2, 1e-12);
}

TEST(Contours, FieldWithoutNegativeSideGivesNone) {
  EXPECT_TRUE(contours([](const Vector2d&) { return 1.0; }, {0, 0}, {1, 1}, 8).empty());
}

// Proportional: model 2 x 1 onto 100 x 100 px is limited by its width, 50 px a unit, y turned
// round.
TEST(View, KeepsProportionsAndTurnsY) {
  const View view{
      .model_min = {0, 0}, .model_max = {2, 1}, .sheet_min = {0, 0}, .sheet_max = {100, 100}};
  EXPECT_NEAR((on_sheet(view, {0, 0}) - Vector2d(0, 75)).norm(), 0, 1e-12);
  EXPECT_NEAR((on_sheet(view, {2, 1}) - Vector2d(100, 25)).norm(), 0, 1e-12);
}

TEST(Svg, EscapesTextThatItIsGiven) {
  Svg svg(10, 10, "a<b & \"c\"");
  svg.text({1, 1}, "</text><script>");
  const std::string text = std::move(svg).finish();
  EXPECT_NE(text.find("<title>a&lt;b &amp; &quot;c&quot;</title>"), std::string::npos);
  EXPECT_EQ(text.find("<script>"), std::string::npos);
}

}  // namespace
}  // namespace ridgeline::jobs
