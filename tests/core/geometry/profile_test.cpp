#include "core/geometry/profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace ridgeline::geometry {
namespace {

using std::numbers::pi;

struct Shape {
  std::string name;
  Profile profile;
  std::size_t joints;
};
void PrintTo(const Shape& shape, std::ostream* out) {
  *out << shape.name;
}

class ProfileOf : public testing::TestWithParam<Shape> {};

INSTANTIATE_TEST_SUITE_P(, ProfileOf,
                         testing::Values(Shape{"Circle", {5, 0, 0}, 0},
                                         Shape{"Elongated", {3, 10, 0}, 4},
                                         Shape{"ElongatedAcross", {3, 0, 4}, 4},
                                         Shape{"RoundedRectangle", {1, 6, 4}, 8}),
                         [](const auto& test) { return test.param.name; });

// [0147]..[0182]: u = 0 on the positive x' axis, counter-clockwise; quarter points by symmetry.
TEST_P(ProfileOf, StartsOnTheXAxisAndTurnsCounterClockwise) {
  const Profile& profile = GetParam().profile;
  const Eigen::Vector2d half = half_extents(profile);
  EXPECT_NEAR((profile_at(profile, 0).p - Eigen::Vector2d(half.x(), 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((profile_at(profile, 0.25).p - Eigen::Vector2d(0, half.y())).norm(), 0, 1e-12);
  EXPECT_NEAR((profile_at(profile, 0.5).p - Eigen::Vector2d(-half.x(), 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((profile_at(profile, 1.75).p - Eigen::Vector2d(0, -half.y())).norm(), 0, 1e-12);
}

// Oracle: central differences of the points, by arc length.
TEST_P(ProfileOf, DerivativesMatchCentralDifferences) {
  const Profile& profile = GetParam().profile;
  const double h = 1e-4;  // [mm]
  const double L = perimeter(profile);
  int checked = 0;
  for (int i = 0; i < 1000; ++i) {
    const double u = (i + 0.37) / 1000;
    const ProfilePoint low = profile_at(profile, u - h / L);
    const ProfilePoint here = profile_at(profile, u);
    const ProfilePoint high = profile_at(profile, u + h / L);
    if (low.curvature != high.curvature) continue;  // a joint is between
    SCOPED_TRACE(u);
    ++checked;
    const Eigen::Vector2d tangent = (high.p - low.p) / (2 * h);
    const Eigen::Vector2d second = (high.p - 2 * here.p + low.p) / (h * h);
    EXPECT_NEAR((tangent - here.tangent).norm(), 0, 1e-8);
    EXPECT_NEAR((second + here.curvature * here.normal).norm(), 0, 1e-5);
    EXPECT_NEAR(here.tangent.dot(here.normal), 0, 1e-15);
    EXPECT_NEAR(signed_distance(profile, here.p).value, 0, 1e-14 * L);
    EXPECT_NEAR((signed_distance(profile, here.p).gradient - here.normal).norm(), 0, 1e-12);
  }
  EXPECT_GT(checked, 980);
}

TEST_P(ProfileOf, CurvatureChangesAtTheJointsOnly) {
  const Profile& profile = GetParam().profile;
  const std::vector<double> us = joints(profile);
  ASSERT_EQ(us.size(), GetParam().joints);
  for (const double u : us) {
    const ProfilePoint low = profile_at(profile, u - 1e-9);
    const ProfilePoint high = profile_at(profile, u + 1e-9);
    EXPECT_NE(low.curvature, high.curvature);
    EXPECT_NEAR((low.p - high.p).norm(), 0, 1e-7);
  }
  int changes = 0;
  for (int i = 0; i < 10000; ++i) {
    const double low = profile_at(profile, i / 1e4 + 3e-5).curvature;
    const double high = profile_at(profile, (i + 1) / 1e4 + 3e-5).curvature;
    if (low != high) ++changes;
  }
  EXPECT_EQ(changes, static_cast<int>(us.size()));
}

// Brute force: the nearest of many points of the outline; the sign by being inside it.
TEST_P(ProfileOf, SignedDistanceMatchesBruteForce) {
  const Profile& profile = GetParam().profile;
  const Eigen::Vector2d half = half_extents(profile);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector2d p(1.5 * half.x() * unit(random), 1.5 * half.y() * unit(random));
    double nearest = 1e9;
    bool inside = true;
    for (int k = 0; k < 4000; ++k) {
      const ProfilePoint on = profile_at(profile, k / 4000.);
      nearest = std::min(nearest, (p - on.p).norm());
      inside = inside && (p - on.p).dot(on.normal) < 0;  // the profile is convex
    }
    SCOPED_TRACE(testing::Message() << p.transpose());
    const double step = perimeter(profile) / 4000;
    EXPECT_NEAR(signed_distance(profile, p).value, inside ? -nearest : nearest, step / 2);
  }
}

TEST_P(ProfileOf, GradientAndHessianMatchCentralDifferences) {
  const Profile& profile = GetParam().profile;
  const Eigen::Vector2d half = half_extents(profile);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  const double h = 1e-5;
  int checked = 0;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d p(1.5 * half.x() * unit(random), 1.5 * half.y() * unit(random));
    const PlaneDistance s = signed_distance(profile, p);
    if (std::abs(s.value) > 0.9 * profile.R2) continue;  // away from the medial axis
    const auto at = [&](double dx, double dy) {
      return signed_distance(profile, p + Eigen::Vector2d(dx, dy));
    };
    const Eigen::Vector2d gradient((at(h, 0).value - at(-h, 0).value) / (2 * h),
                                   (at(0, h).value - at(0, -h).value) / (2 * h));
    Eigen::Matrix2d hessian;
    hessian << (at(h, 0).gradient - at(-h, 0).gradient) / (2 * h),
        (at(0, h).gradient - at(0, -h).gradient) / (2 * h);
    SCOPED_TRACE(testing::Message() << p.transpose());
    EXPECT_NEAR((gradient - s.gradient).norm(), 0, 1e-7);
    EXPECT_NEAR((hessian - s.hessian).norm(), 0, 1e-5);
    ++checked;
  }
  EXPECT_GT(checked, 200);
}

TEST(Profile, PerimeterOfTheElongatedHole) {
  EXPECT_NEAR(perimeter({3, 10, 0}), 2 * pi * 3 + 20, 1e-12);
}

// Inside the core rectangle the nearest outline is beside the nearer side: worked by hand.
TEST(Profile, DistanceInTheCoreIsToTheNearerSide) {
  const PlaneDistance s = signed_distance({1, 6, 4}, {1.5, -0.2});
  EXPECT_NEAR(s.value, -(2 - 1.5) - 1, 1e-15);
  EXPECT_EQ(s.gradient, Eigen::Vector2d(1, 0));
}

}  // namespace
}  // namespace ridgeline::geometry
