#include "core/geometry/material.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <ostream>
#include <random>

#include "core/base/error.hpp"
#include "core/geometry/solid.hpp"
#include "tests/support/membership.hpp"

namespace ridgeline::geometry {
namespace {

using Eigen::Vector3d;

Workpiece tube() {
  Workpiece tube;
  tube.inner_radius = 20;
  tube.outer_radius = 30;
  tube.length = 100;
  Hole hole;
  hole.name = "H1";
  hole.profile.R2 = 5;
  tube.holes = {hole};
  return tube;
}

Workpiece block() {
  Workpiece block;
  block.shape = BodyShape::ManifoldBlock;
  block.inner_radius = 10;
  block.size = {60, 80, 50};
  Hole hole;
  hole.name = "H1";
  hole.profile.R2 = 4;
  block.holes = {hole};
  return block;
}

struct Point {
  const char* name;
  Workpiece workpiece;
  Vector3d p;
  double expected;
};
void PrintTo(const Point& point, std::ostream* out) {
  *out << point.name;
}

Workpiece with(Workpiece workpiece, int walls, std::optional<double> depth) {
  workpiece.holes[0].walls = walls;
  workpiece.holes[0].depth = depth;
  return workpiece;
}

class MaterialPoint : public testing::TestWithParam<Point> {};

TEST_P(MaterialPoint, HasTheDistanceWorkedByHand) {
  EXPECT_NEAR(material_distance(GetParam().workpiece, GetParam().p), GetParam().expected, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Worked, MaterialPoint,
    testing::Values(
        Point{"on the hole axis in the wall, 5 to it", tube(), {0, 0, 25}, 5},
        Point{"1 into the hole wall", tube(), {6, 0, 25}, -1},
        Point{"on the bore axis, 20 to the bore", tube(), {0, 0, 0}, 20},
        Point{"on the bore axis beyond the end, 20 to the bore", tube(), {0, 53, 0}, 20},
        Point{"beyond the end of the wall by 3", tube(), {25, 53, 0}, 3},
        Point{"above the outside by 7", tube(), {0, 20, 37}, 7},
        Point{"exit hole is there", tube(), {0, 0, -25}, 5},
        Point{"walls 1: no exit hole, middle of the wall", with(tube(), 1, {}), {0, 0, -25}, -5},
        Point{"walls 1: entry hole", with(tube(), 1, {}), {1, 0, 25}, 4},
        Point{"blind: 4 deep, floor at z 26", with(tube(), 2, 4), {0, 0, 27}, 1},
        Point{"blind: below the floor, 1 above mid wall", with(tube(), 2, 4), {0, 0, 25.5}, -0.5},
        Point{"block: 1 below the top", block(), {20, 0, 24}, -1},
        Point{"block: beside by 2", block(), {32, 0, 20}, 2},
        Point{"block: over the end by 5", block(), {0, 45, 15}, 5},
        Point{"block: in the bore", block(), {3, 20, 4}, 5},
        Point{"block: in the hole", block(), {1, 0, 20}, 3}));

TEST(Material, BlindHoleBesideTheWorkpieceHasNoFloor) {
  Workpiece off = with(tube(), 2, 4);
  off.holes[0].position = {40, 0, 0};
  EXPECT_THROW(material_distance(off, {0, 0, 0}), Error);
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution(low, high)(random);
}

Vector3d any_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

Vector3d any_point(std::mt19937& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach),
          uniform(random, -reach, reach)};
}

/// Tubes and blocks lying any way, with one to three holes of any shape, oblique to 60 degrees.
Workpiece any_workpiece(std::mt19937& random) {
  Workpiece part;
  part.shape = random() % 2 == 0 ? BodyShape::ThickWalledCylinder : BodyShape::ManifoldBlock;
  part.position = any_point(random, 5);
  part.axis = any_direction(random);
  part.inner_radius = uniform(random, 5, 15);
  part.outer_radius = part.inner_radius + uniform(random, 2, 8);
  part.length = uniform(random, 30, 60);
  part.size = {2 * part.outer_radius, part.length, 2 * part.outer_radius + 3};
  const int holes = 1 + static_cast<int>(random() % 3);
  for (int i = 0; i < holes; ++i) {
    Hole hole;
    const Vector3d across = part.axis.cross(any_direction(random)).normalized();
    const double beta = uniform(random, -1, 1);
    hole.axis = std::cos(beta) * across + std::sin(beta) * part.axis;
    hole.position = part.position + any_point(random, 4);
    hole.profile.R2 = uniform(random, 1, 3);
    if (random() % 2 == 0) hole.profile.straight_along = uniform(random, 0.5, 4);
    if (random() % 3 == 0) hole.profile.straight_across = uniform(random, 0.5, 2);
    hole.walls = 1 + static_cast<int>(random() % 2);
    if (random() % 4 == 0) hole.depth = uniform(random, 1, 15);
    part.holes.push_back(hole);
  }
  return part;
}

TEST(Material, SignIsMembershipAndAirNeverExceedsTheTrueDistance) {
  std::mt19937 random(20240207);
  int inside = 0, outside = 0, probes = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Workpiece part = any_workpiece(random);
    const Material material = material_of(part);
    for (int k = 0; k < 100; ++k) {
      const Vector3d p = part.position + any_point(random, 30);
      const double d = distance(material, p);
      ASSERT_EQ(d < 0, is_material(part, p)) << p.transpose();
      ++(d < 0 ? inside : outside);
      for (int n = 0; d > 0 && n < 20; ++n, ++probes) {
        const Vector3d q = p + d * (1 - 1e-9) * any_direction(random);
        ASSERT_FALSE(is_material(part, q)) << q.transpose();
      }
    }
  }
  EXPECT_GT(inside, 2000);
  EXPECT_GT(outside, 5000);
  EXPECT_GT(probes, 100000);
}

// The exact distance: a ball of it has no material in it, and where its gradient points there is
// material on its surface.
TEST(Solid, DistanceIsTrueInTheAir) {
  std::mt19937 random(20240208);
  int checked = 0, beyond_the_bound = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const Workpiece part = any_workpiece(random);
    const Solid solid(part);
    for (int k = 0; k < 50; ++k) {
      const Vector3d p = part.position + any_point(random, 25);
      const double d = solid.distance(p);
      const double bound = distance(solid.material(), p);
      if (!(bound > 0.05)) continue;
      ASSERT_GE(d, bound - 1e-12);
      beyond_the_bound += d > bound + 1e-6 ? 1 : 0;
      for (int n = 0; n < 50; ++n) {
        const Vector3d q = p + (d - 2 * seam_sag) * any_direction(random);
        ASSERT_FALSE(is_material(part, q)) << p.transpose() << " to " << q.transpose();
      }
      Vector3d gradient;
      const double step = 1e-4;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d e = step * Vector3d::Unit(axis);
        gradient[axis] = (solid.distance(p + e) - solid.distance(p - e)) / (2 * step);
      }
      if (std::abs(gradient.norm() - 1) > 0.02) continue;  // two places are equally near
      const Vector3d foot = p - d * gradient.normalized();
      EXPECT_LT(distance(solid.material(), foot), 0.03 * d + 1e-3) << p.transpose();
      ++checked;
    }
  }
  EXPECT_GT(checked, 600);
  EXPECT_GT(beyond_the_bound, 100);
}

}  // namespace
}  // namespace ridgeline::geometry
