#include "core/geometry/break_out.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/base/error.hpp"
#include "core/geometry/workpiece.hpp"

namespace ridgeline::geometry {
namespace {

using Eigen::Vector3d;

struct Broken {
  Workpiece tube;
  Hole hole;
  double R1, f;
};

/// A hole of random shape that breaks out of one side of the bore, or is wider than it.
Broken random_broken(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * unit(random); };
  Broken b;
  b.R1 = between(5, 20);
  const double shape = unit(random);
  const double half_width = b.R1 * between(0.3, 1.4);
  b.hole.profile.R2 = half_width;
  if (shape > 0.4) b.hole.profile.straight_along = between(0.1, 1) * b.R1;
  if (shape > 0.7) {
    b.hole.profile.R2 = 0.6 * half_width;
    b.hole.profile.straight_across = 0.8 * half_width;
  }
  const double least = std::max(0.0, b.R1 - half_width);  // |f| beyond which it breaks out
  b.f = between(1.05 * least + 0.1, 0.95 * (b.R1 + half_width)) * (unit(random) < 0.5 ? 1 : -1);
  const double beta = between(-0.9, 0.9);
  b.tube.inner_radius = b.R1;
  b.tube.outer_radius = 20 * b.R1;
  b.tube.length = 400 * b.R1;
  b.hole.name = "H";
  b.hole.axis = {0, std::sin(beta), std::cos(beta)};
  b.hole.position = position_of(b.tube, b.hole.axis, b.f);
  b.tube.holes = {b.hole};
  return b;
}

bool is_near_tangent(const Broken& b) {
  const double half = half_extents(b.hole.profile).x();
  return std::abs(half + std::abs(b.f) - b.R1) < 1e-3 * b.R1 ||
         std::abs(half - std::abs(b.f) - b.R1) < 1e-3 * b.R1;
}

// One closed curve on both surfaces, whose rate is its derivative, that meets each side once.
TEST(BreakOut, IsASmoothClosedRidgeOnBothSurfaces) {
  std::mt19937 random(7);
  int checked = 0;
  int wider = 0;
  while (checked < 300) {
    const Broken b = random_broken(random);
    if (is_near_tangent(b)) continue;
    SCOPED_TRACE(testing::Message()
                 << "R1 " << b.R1 << " R2 " << b.hole.profile.R2 << " f " << b.f);
    for (const Side side : {Side::Entry, Side::Exit}) {
      const Edge edge = edge_of(b.tube, b.hole, EdgeKind::Inner, side);
      ASSERT_TRUE(edge.merged);
      const RidgeLine line = ridge_line(edge);
      double way = 0;
      for (int i = 0; i < 200; ++i) {
        const double u = (i + 0.3) / 200;
        const ProfilePoint profile = profile_at(line, u);
        const RidgePoint point = ridge_at(line, profile, u);
        EXPECT_NEAR(signed_distance(edge.body, point.P).value, 0, 1e-12 * b.R1 * 20);
        EXPECT_NEAR(signed_distance(edge.profile, Eigen::Vector2d(point.P.head<2>())).value, 0,
                    1e-12 * b.R1);
        const double h = 1e-6;
        const Vector3d central = (ridge_at(line, u + h).P - ridge_at(line, u - h).P) / (2 * h);
        const Vector3d rate = ridge_rate(line, point, profile, u) * point.t;
        const bool at_joint = (central - rate).norm() > 1e-4 * rate.norm();
        if (at_joint) {  // a jump of the curvature within the difference
          bool joint_near = false;
          for (const double v : joints(edge.profile))
            for (const double w : passages(line, v))
              joint_near = joint_near || std::abs(std::remainder(w - u, 1)) < 2 * h;
          EXPECT_TRUE(joint_near) << "u " << u;
        }
        way += (ridge_at(line, u + 0.005).P - point.P).norm();
      }
      EXPECT_NEAR((ridge_at(line, 0).P - ridge_at(line, 1 - 1e-12).P).norm(), 0, 1e-8 * way);
    }
    const bool both = edge_of(b.tube, b.hole, EdgeKind::Inner, Side::Entry).merged->plus >= 0 &&
                      edge_of(b.tube, b.hole, EdgeKind::Inner, Side::Entry).merged->minus >= 0;
    wider += both;
    ++checked;
  }
  EXPECT_GT(wider, 5);
}

// Ends of the swing: the generators that touch the cylinder, worked by hand for a circle:
// cos(phi) = (R1 - f) / R2 = (10 - 6) / 6.
TEST(BreakOut, TurnsWhereTheGeneratorsTouchTheCylinder) {
  const BreakOut curve = break_out({.R2 = 6}, 6, 10, true);
  EXPECT_NEAR(profile_parameter(curve, 0.75), std::acos(4.0 / 6) / (2 * std::numbers::pi), 1e-15);
  EXPECT_NEAR(profile_parameter(curve, 0), 0.5, 1e-15);
  EXPECT_NEAR(height_across(curve, {.R2 = 6}, 0), 10, 1e-14);  // x' = -6 = -f: the cylinder's top
  EXPECT_NEAR(height_across(curve, {.R2 = 6}, 0.5), -10, 1e-14);
  EXPECT_NEAR(height_across(curve, {.R2 = 6}, 0.25), 0, 1e-15);
  EXPECT_GT(height_rate(curve, {.R2 = 6}, 0.25), 1);
}

// Two curves where the hole is wider than the cylinder: each goes round it on its side.
TEST(BreakOut, OfAWideHoleIsOneCurveOnEachSide) {
  const Profile profile{.R2 = 12};
  for (const bool upper : {true, false}) {
    const BreakOut curve = break_out(profile, 1, 10, upper);
    for (int i = 0; i < 50; ++i) {
      const double y = profile_at(profile, profile_parameter(curve, i / 50.)).p.y();
      EXPECT_GT(upper ? y : -y, 0);
    }
  }
}

TEST(BreakOut, IsRefusedWhereTheHoleEndsInTheBore) {
  Broken b;
  b.R1 = 10;
  b.tube.inner_radius = 10;
  b.tube.outer_radius = 60;
  b.tube.length = 200;
  b.hole.name = "H";
  b.hole.profile.R2 = 6;
  b.hole.position = {6, 0, 0};
  b.hole.walls = 1;
  b.tube.holes = {b.hole};
  try {
    edge_of(b.tube, b.hole, EdgeKind::Inner, Side::Entry);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::HoleMissesBody);
    EXPECT_NE(std::string(error.what()).find("both"), std::string::npos);
  }
}

}  // namespace
}  // namespace ridgeline::geometry
