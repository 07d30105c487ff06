#include "core/path/equal_error.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace ridgeline::path {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

Vector3d ellipse(double a, double b, double u) {
  return {a * std::cos(2 * pi * u), b * std::sin(2 * pi * u), 0.3 * std::cos(4 * pi * u)};
}

// Brute force: largest distance of 200 samples of every chord's curve to the chord.
template <class F>
double measured_error(const F& curve, const std::vector<double>& u) {
  double worst = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double b = i + 1 < u.size() ? u[i + 1] : u[0] + 1;
    const Vector3d A = curve(u[i]);
    const Vector3d d = curve(b) - A;
    for (int k = 1; k < 200; ++k) {
      const Vector3d p = curve(u[i] + (b - u[i]) * k / 200);
      const double s = std::clamp((p - A).dot(d) / d.squaredNorm(), 0.0, 1.0);
      worst = std::max(worst, (p - A - s * d).norm());
    }
  }
  return worst;
}

// Circle of radius 10 at tolerance 0.005: N_opt = pi sqrt(R / (2 TA)) = 99.3; the exact count for
// equal chords is pi / acos(1 - TA / R) = 99.33.
TEST(EqualError, CircleNeedsAsManyPointsAsItsClosedForm) {
  const auto flat = [](double u) {
    return Vector3d(10 * std::cos(2 * pi * u), 10 * std::sin(2 * pi * u), 0);
  };
  const ClosedCurve curve = model(flat, {0, 1}, 5e-6);
  const Chords chords = equal_error_chords(curve, {0, 1}, 0.005, 1000);
  EXPECT_EQ(chords.optimal, 100);
  EXPECT_LE(chords.u.size(), 101u);
  EXPECT_GE(chords.u.size(), 100u);
  EXPECT_LE(chords.chord_error, 0.005);
  EXPECT_LE(measured_error(flat, chords.u), chords.chord_error);
}

TEST(EqualError, RandomCurvesKeepTheToleranceWithFewPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const double a = 1 + 20 * unit(random);
    const double b = a * (0.15 + 0.85 * unit(random));
    const double tolerance = std::pow(10, -1 - 3 * unit(random)) * b;
    const double start = unit(random);
    SCOPED_TRACE(testing::Message() << "a=" << a << " b=" << b << " tolerance=" << tolerance);
    const auto f = [&](double u) { return ellipse(a, b, u); };
    const ClosedCurve curve = model(f, {start, start + 1}, 1e-3 * tolerance);
    const Chords chords = equal_error_chords(curve, {start, start + 1}, tolerance, 100000);
    EXPECT_LE(chords.chord_error, tolerance);
    EXPECT_LE(measured_error(f, chords.u), chords.chord_error);
    EXPECT_GE(measured_error(f, chords.u), 0.8 * tolerance) << "points wasted";
    EXPECT_LE(static_cast<double>(chords.u.size()), std::ceil(1.03 * chords.optimal) + 1);
    ++checked;
  }
  EXPECT_EQ(checked, 60);
}

// A square with rounded corners: straight sides need no points of their own.
TEST(EqualError, StraightPartsTakeOneChord) {
  constexpr double r = 1;
  constexpr double side = 8;
  constexpr double length = 4 * side + 2 * pi * r;
  const auto square = [&](double u) {
    double s = (u - std::floor(u)) * length;
    const int quarter = std::min(3, static_cast<int>(s / (length / 4)));
    s -= quarter * (length / 4);
    Vector3d p = s < side ? Vector3d(side / 2 + r, s - side / 2, 0)
                          : Vector3d(side / 2 + r * std::cos((s - side) / r),
                                     side / 2 + r * std::sin((s - side) / r), 0);
    for (int k = 0; k < quarter; ++k) p = Vector3d(-p.y(), p.x(), 0);
    return p;
  };
  std::vector<double> breaks;
  for (int k = 0; k < 4; ++k) {
    breaks.push_back(k / 4.0);
    breaks.push_back(k / 4.0 + side / length);
  }
  breaks.push_back(1);
  const ClosedCurve curve = model(square, breaks, 1e-6);
  const Chords chords = equal_error_chords(curve, breaks, 0.001, 1000);
  const int arc = static_cast<int>(std::ceil(pi / 4 / std::acos(1 - 0.001 / r)));  // of a quarter
  EXPECT_EQ(chords.u.size(), static_cast<std::size_t>(4 * arc + 4));
}

TEST(EqualError, RefusesMorePointsThanTheLimit) {
  const auto f = [](double u) { return ellipse(10, 5, u); };
  const ClosedCurve curve = model(f, {0, 1}, 1e-9);
  try {
    equal_error_chords(curve, {0, 1}, 1e-6, 1000);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::ToleranceTooSmall);
    EXPECT_EQ(error.details().field, "/tolerance");
  }
}

// A corner inside a chord is seen: the bound holds across a jump of the tangent.
TEST(ChordBound, HoldsAcrossACorner) {
  const auto diamond = [](double u) {
    const double s = 4 * (u - std::floor(u));
    if (s < 1) return Vector3d(1 - s, s, 0);
    if (s < 2) return Vector3d(1 - s, 2 - s, 0);
    if (s < 3) return Vector3d(s - 3, 2 - s, 0);
    return Vector3d(s - 3, s - 4, 0);
  };
  const ClosedCurve curve = model(diamond, {0, 0.25, 0.5, 0.75, 1}, 1e-9);
  // From (0.5, 0.5) to (-0.5, 0.5): the corner (0, 1) is 0.5 off.
  EXPECT_NEAR(chord_bound(curve, 0.125, 0.375, 0), 0.5, 1e-9);
}

TEST(Model, RefusesACurveThatJumps) {
  const auto jump = [](double u) { return Vector3d(u - std::floor(u) < 0.3 ? 0 : 1, 0, 0); };
  EXPECT_THROW(model(jump, {0, 1}, 1e-6), Error);
}

}  // namespace
}  // namespace ridgeline::path
