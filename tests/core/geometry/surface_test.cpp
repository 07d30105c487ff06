#include "core/geometry/surface.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace ridgeline::geometry {
namespace {

Eigen::Vector3d random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random)};
}

Surface random_surface(std::mt19937& random, int i) {
  const Eigen::Vector3d point = 5 * random_vector(random);
  const Eigen::Vector3d direction = random_vector(random).normalized();
  if (i % 2 == 0) return Plane{point, direction};
  return Cylinder{point, direction, 0.5 + std::abs(random_vector(random).x())};
}

TEST(Surface, CylinderWorkedByHand) {
  const Cylinder cylinder{{1, 2, 3}, {0, 1, 0}, 5};
  const SurfaceDistance s = signed_distance(cylinder, {1 + 6, 100, 3 + 8});
  EXPECT_NEAR(s.value, 10 - 5, 1e-14);
  EXPECT_NEAR((s.gradient - Eigen::Vector3d(0.6, 0, 0.8)).norm(), 0, 1e-15);
}

TEST(Surface, GradientAndHessianMatchCentralDifferences) {
  std::mt19937 random(3);
  const double h = 1e-5;
  for (int i = 0; i < 500; ++i) {
    const Surface surface = random_surface(random, i);
    const Eigen::Vector3d p = 5 * random_vector(random);
    const SurfaceDistance s = signed_distance(surface, p);
    SCOPED_TRACE(i);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
      const SurfaceDistance low = signed_distance(surface, p - step);
      const SurfaceDistance high = signed_distance(surface, p + step);
      EXPECT_NEAR((high.value - low.value) / (2 * h), s.gradient[k], 1e-7);
      EXPECT_NEAR(((high.gradient - low.gradient) / (2 * h) - s.hessian.col(k)).norm(), 0, 1e-4);
    }
  }
}

// F = (r^2 - R^2) / 2R has the zero and, there, the unit gradient of the distance.
TEST(Surface, QuadricHasTheSameZeroAndNormal) {
  std::mt19937 random(4);
  for (int i = 0; i < 500; ++i) {
    const Surface surface = random_surface(random, i);
    const Quadric F = quadric(surface);
    const Eigen::Vector3d p = 5 * random_vector(random);
    const SurfaceDistance s = signed_distance(surface, p);
    const Eigen::Vector3d foot = p - s.value * s.gradient;
    SCOPED_TRACE(i);
    EXPECT_NEAR(value(F, foot), 0, 1e-12);
    EXPECT_NEAR((gradient(F, foot) - s.gradient).norm(), 0, 1e-12);
    EXPECT_GE(value(F, p) * s.value, -1e-12);  // same sign
  }
}

}  // namespace
}  // namespace ridgeline::geometry
