#include "core/geometry/trace.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

namespace ridgeline::geometry {
namespace {

using Eigen::Vector3d;

Piece straight(const Vector3d& a, const Vector3d& b) {
  Piece piece;
  piece.a = a;
  piece.b = b;
  return piece;
}

TEST(Trace, NearestPointOfAStraightPieceIsItsFootOrItsEnd) {
  const Piece piece = straight({0, 0, 0}, {4, 0, 0});
  EXPECT_DOUBLE_EQ(nearest(piece, {1, 3, 4}).distance, 5);
  EXPECT_DOUBLE_EQ(nearest(piece, {1, 3, 4}).t, 0.25);
  EXPECT_DOUBLE_EQ(nearest(piece, {7, 4, 0}).distance, 5);
  EXPECT_DOUBLE_EQ(nearest(piece, {-3, 4, 0}).distance, 5);
}

// A full circle of radius 2 about (1, 1): the nearest point lies on the ray from the centre.
TEST(Trace, NearestPointOfACircleIsOnItsRay) {
  Spiral circle{.centre = {1, 1, 0},
                .x = Vector3d::UnitX(),
                .y = Vector3d::UnitY(),
                .z = Vector3d::UnitZ(),
                .r0 = 2,
                .r1 = 2,
                .w0 = 0.3,
                .w1 = 0.3 + 2 * std::numbers::pi,
                .h0 = 0,
                .h1 = 0};
  const Vector3d start = circle.centre + 2 * Vector3d(std::cos(0.3), std::sin(0.3), 0);
  std::vector<Piece> pieces;
  add_spiral(pieces, circle, straight(start, start));
  const Trace trace(pieces);
  for (int i = 0; i < 100; ++i) {
    const double w = i * 0.0628;
    const Vector3d ray(std::cos(w), std::sin(w), 0);
    EXPECT_NEAR(trace.nearest(circle.centre + 5 * ray).distance, 3, 1e-12);
    EXPECT_NEAR(trace.nearest(circle.centre + 0.5 * ray).distance, 1.5, 1e-12);
    const Foot up = trace.nearest(circle.centre + 5 * ray + Vector3d(0, 0, 4));
    EXPECT_NEAR(up.distance, 5, 1e-12);
    EXPECT_LT((up.point - circle.centre - 2 * ray).norm(), 1e-7);
  }
}

std::vector<Piece> any_path(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> any(-1, 1);
  const auto point = [&] { return Vector3d(any(random), any(random), any(random)); };
  std::vector<Piece> pieces;
  Vector3d from = point();
  for (int i = 0; i < count; ++i) {
    if (i % 3 == 0) {
      Spiral s;
      s.z = point().normalized();
      s.x = s.z.unitOrthogonal();
      s.y = s.z.cross(s.x);
      s.r0 = 0.5 + 0.4 * any(random);
      s.r1 = s.r0 + 0.05 * any(random);
      s.w0 = any(random);
      s.w1 = s.w0 + 6 * any(random);
      s.h0 = 0;
      s.h1 = any(random);
      s.centre = from - s.r0 * (std::cos(s.w0) * s.x + std::sin(s.w0) * s.y);
      const Vector3d to =
          s.centre + s.r1 * (std::cos(s.w1) * s.x + std::sin(s.w1) * s.y) + s.h1 * s.z;
      add_spiral(pieces, s, straight(from, to));
      from = to;
    } else {
      const Vector3d to = from + point();
      pieces.push_back(straight(from, to));
      from = to;
    }
  }
  return pieces;
}

TEST(Trace, NearestOfThePathIsTheBestOfDenseSamples) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-3, 3);
  int checked = 0;
  for (int path = 0; path < 20; ++path) {
    const Trace trace(any_path(random, 12));
    for (int k = 0; k < 20; ++k, ++checked) {
      const Vector3d p(any(random), any(random), any(random));
      double best = 1e9;
      for (const Piece& piece : trace.pieces()) {
        for (int i = 0; i <= 500; ++i) best = std::min(best, (at(piece, i / 500.0) - p).norm());
      }
      const Foot foot = trace.nearest(p, static_cast<std::size_t>(k));
      EXPECT_LE(foot.distance, best + 1e-12);
      EXPECT_GE(foot.distance, best - 1e-4);
      EXPECT_NEAR((at(trace.pieces()[foot.piece], foot.t) - p).norm(), foot.distance, 1e-12);
      EXPECT_EQ(trace.nearest(p, 0, best / 2).distance, best / 2);
    }
  }
  EXPECT_EQ(checked, 400);
}

TEST(Trace, EveryPointLiesWithinTheDeviationOfEachStretchOverIt) {
  std::mt19937 random(6);
  const Trace trace(any_path(random, 30));
  int checked = 0;
  for (const Stretch& stretch : trace.nodes()) {
    const Piece chord = straight(stretch.a, stretch.b);
    for (std::size_t i = stretch.first; i < stretch.last; ++i) {
      for (double t = 0; t <= 1; t += 0.125, ++checked) {
        const Vector3d p = at(trace.pieces()[i], t);
        const double off = (stretch.b - stretch.a).norm() > 0 ? nearest(chord, p).distance
                                                              : (p - stretch.a).norm();
        ASSERT_LE(off, stretch.deviation + 1e-12);
        ASSERT_TRUE((p.array() >= stretch.low.array() - 1e-12).all());
        ASSERT_TRUE((p.array() <= stretch.high.array() + 1e-12).all());
      }
    }
  }
  EXPECT_GT(checked, 3000);
}

}  // namespace
}  // namespace ridgeline::geometry
