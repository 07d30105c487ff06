#include "core/path/arc.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"

namespace ridgeline::path {
namespace {

using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

Move arc_move(const Vector3d& to, const Vector3d& centre, ArcPlane plane, ArcSense sense) {
  return {MoveKind::Cut, to, 5, Arc{centre, plane, sense}};
}

// A quarter of G3 goes from the plane's first axis to its second, G2 the other three quarters.
TEST(Arc, CounterClockwiseGoesFromFirstAxisToSecondInEveryPlane) {
  for (const ArcPlane plane : {ArcPlane::XY, ArcPlane::ZX, ArcPlane::YZ}) {
    const auto [i, j, k] = axes_of(plane);
    const Vector3d first = Vector3d::Unit(i), second = Vector3d::Unit(j), third = Vector3d::Unit(k);
    EXPECT_EQ(first.cross(second), third);
    const Vector3d from = 2 * first;
    const Move ccw = arc_move(2 * second + third, {0, 0, 0}, plane, ArcSense::CounterClockwise);
    EXPECT_NEAR(arc_shape(from, ccw).sweep, pi / 2, 1e-15);
    EXPECT_LT(
        (point_at(arc_shape(from, ccw), 0.5) - (std::sqrt(2) * (first + second) + 0.5 * third))
            .norm(),
        1e-14);
    const Move cw = arc_move(2 * second, {0, 0, 0}, plane, ArcSense::Clockwise);
    EXPECT_NEAR(arc_shape(from, cw).sweep, -1.5 * pi, 1e-15);
    EXPECT_LT((point_at(arc_shape(from, cw), 1 / 3.0) + 2 * second).norm(), 1e-14);
  }
}

TEST(Arc, EndsThatCoincideInThePlaneAreAFullTurn) {
  const Vector3d from(3, 0, 1);
  const Move turn = arc_move({3, 0, 5}, {0, 0, 99}, ArcPlane::XY, ArcSense::Clockwise);
  EXPECT_NEAR(arc_shape(from, turn).sweep, -2 * pi, 1e-15);
  EXPECT_NEAR(length(from, turn), std::hypot(6 * pi, 4), 1e-13);
  EXPECT_LT((point_at(arc_shape(from, turn), 0.25) - Vector3d(0, -3, 2)).norm(), 1e-14);
}

// A tilted arc is the flat one, rotated.
TEST(Arc, AxesTiltThePlane) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).matrix();
  const Vector3d from(4, 1, 2);
  const Move flat = arc_move({1, 4, 3}, {1, 1, 0}, ArcPlane::XY, ArcSense::CounterClockwise);
  Move tilted = flat;
  tilted.to = R * flat.to;
  tilted.arc->centre = R * flat.arc->centre;
  tilted.arc->axes = R;
  for (double t = 0; t <= 1; t += 0.125) {
    const Vector3d expected = R * point_at(arc_shape(from, flat), t);
    EXPECT_LT((point_at(arc_shape(R * from, tilted), t) - expected).norm(), 1e-14) << t;
  }
}

TEST(Arc, SamplesKeepTheChordErrorAndAreNotWasted) {
  const Vector3d from(10, 0, 0);
  for (const double tolerance : {1.0, 0.1, 0.002, 1e-5}) {
    const Move move = arc_move({0, -10, 4}, {0, 0, 0}, ArcPlane::XY, ArcSense::CounterClockwise);
    const auto points = sampled(from, move, tolerance);
    EXPECT_EQ(points.back(), move.to);
    const double chord_error = 10 * (1 - std::cos(0.75 * pi / double(points.size())));
    EXPECT_LE(chord_error, tolerance);
    const double with_one_less = 10 * (1 - std::cos(0.75 * pi / double(points.size() - 1)));
    EXPECT_TRUE(with_one_less > tolerance || points.size() <= 3) << tolerance;
  }
}

TEST(Arc, LinearisedKeepsStraightMovesKindsAndFeeds) {
  Motion motion;
  motion.start = {10, 0, 0};
  motion.moves.push_back({MoveKind::Approach, {5, 0, 0}, 1, std::nullopt});
  motion.moves.push_back(arc_move({-5, 0, 0}, {0, 0, 0}, ArcPlane::XY, ArcSense::Clockwise));
  const Motion lines = linearised(motion, 0.01);
  ASSERT_GT(lines.moves.size(), 10U);
  EXPECT_EQ(lines.moves.front().kind, MoveKind::Approach);
  EXPECT_EQ(lines.moves.back().to, Vector3d(-5, 0, 0));
  for (std::size_t n = 1; n < lines.moves.size(); ++n) {
    EXPECT_EQ(lines.moves[n].feed, 5);
    EXPECT_FALSE(lines.moves[n].arc);
    EXPECT_NEAR(lines.moves[n].to.norm(), 5, 1e-14);
    EXPECT_LT(lines.moves[n].to.y(), 1e-14);  // clockwise from +X: through -Y
  }
}

TEST(Arc, RefusesWhatHasNoShape) {
  const auto code_of = [](const auto& action) {
    try {
      action();
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::Internal;
  };
  const Vector3d from(1, 0, 0);
  const Move on_centre = arc_move({0, 1, 0}, from, ArcPlane::XY, ArcSense::Clockwise);
  EXPECT_EQ(code_of([&] { arc_shape(from, on_centre); }), ErrorCode::BadInput);
  const Move straight{MoveKind::Cut, {0, 1, 0}, 5, std::nullopt};
  EXPECT_EQ(code_of([&] { arc_shape(from, straight); }), ErrorCode::BadInput);
  const Move quarter = arc_move({0, 1, 0}, {0, 0, 0}, ArcPlane::XY, ArcSense::CounterClockwise);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(code_of([&] { sampled(from, quarter, nan); }), ErrorCode::BadInput);
  EXPECT_EQ(code_of([&] { sampled(from, quarter, 0); }), ErrorCode::BadInput);
  EXPECT_EQ(code_of([&] { sampled(from, quarter, 1e-16); }), ErrorCode::ToleranceTooSmall);
}

}  // namespace
}  // namespace ridgeline::path
