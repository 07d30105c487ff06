#include "core/geometry/ridge.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/geometry/workpiece.hpp"
#include "tests/support/random_edges.hpp"

namespace ridgeline::geometry {
namespace {

using std::numbers::pi;

struct Source {
  double R1, R2, f, phi;
};

// The source's case: A1 along Y, hole along Z.
Edge source_edge(const Source& s, EdgeKind kind = EdgeKind::Inner) {
  Workpiece workpiece;
  workpiece.inner_radius = kind == EdgeKind::Inner ? s.R1 : s.R1 / 2;
  workpiece.outer_radius = kind == EdgeKind::Inner ? 2 * s.R1 : s.R1;
  workpiece.length = 10 * s.R1;
  Hole hole;
  hole.profile.R2 = s.R2;
  hole.position = {s.f, 0, 0};
  hole.eccentric_distance = s.f;
  return edge_of(workpiece, hole, kind, Side::Entry);
}

std::vector<Source> source_cases() {
  std::vector<Source> cases;
  for (const double f : {0., 3., -5., 10.}) {
    for (int i = 0; i < 24; ++i) cases.push_back({20, 8, f, 2 * pi * i / 24});
  }
  return cases;
}

TEST(Ridge, Eq2To7PointOfTheSource) {
  for (const Source& s : source_cases()) {
    const Eigen::Vector3d P = ridge_at(source_edge(s), s.phi / (2 * pi)).P;
    const double Xp = s.R2 * std::cos(s.phi);           // (5)
    const double Yp = s.R2 * std::sin(s.phi);           // (7)
    const double gamma = std::acos((Xp + s.f) / s.R1);  // (6)
    SCOPED_TRACE(testing::Message() << "f " << s.f << " phi " << s.phi);
    EXPECT_NEAR(P.x(), s.R1 * std::cos(gamma) - s.f, 1e-12);  // (2)
    EXPECT_NEAR(P.y(), Yp, 1e-12);
    EXPECT_NEAR(P.z(), s.R1 * std::sin(gamma), 1e-12);                          // (3)
    EXPECT_NEAR(std::pow(P.x() + s.f, 2) + P.z() * P.z(), s.R1 * s.R1, 1e-11);  // (4)
  }
}

TEST(Ridge, Eq8To10BasisOfTheSource) {
  for (const Source& s : source_cases()) {
    const double c = std::cos(s.phi);
    const double sn = std::sin(s.phi);
    const double g = s.R2 * c + s.f;
    const double root = std::sqrt(s.R1 * s.R1 - g * g * c * c);
    const Eigen::Vector3d e1(c, sn, 0);                               // (8)
    const Eigen::Vector3d e2(g * sn * sn / root, -g * sn * c / root,  // (9)
                             std::sqrt(s.R1 * s.R1 - g * g) / root);
    SCOPED_TRACE(testing::Message() << "f " << s.f << " phi " << s.phi);
    const RidgePoint inner = ridge_at(source_edge(s), s.phi / (2 * pi));
    EXPECT_NEAR((inner.e1 - e1).norm(), 0, 1e-12);
    EXPECT_NEAR((inner.e2 - e2).norm(), 0, 1e-12);
    EXPECT_NEAR(inner.t.z() * inner.t.z(), 1 - e2.z() * e2.z(), 1e-12);  // sin(epsilon)^2, (10)
    // Outer edge: into the material is the other way (design: section 3).
    const RidgePoint outer = ridge_at(source_edge(s, EdgeKind::Outer), s.phi / (2 * pi));
    EXPECT_NEAR((outer.e2 + e2).norm(), 0, 1e-12);
    EXPECT_NEAR(inner.theta + outer.theta, pi, 1e-12);
  }
}

// Thousands of edges of every shape and place.
TEST(Ridge, PointsLieOnBothSurfacesWithAnOrthonormalFrame) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  int checked = 0;
  for (int i = 0; i < 3000; ++i) {
    const tests::RandomEdge e = tests::random_edge(random);
    SCOPED_TRACE(testing::PrintToString(e));
    const Edge edge = tests::edge_of(e);
    for (int k = 0; k < 5; ++k) {
      const RidgePoint p = ridge_at(edge, unit(random));
      const double scale = 1e-12 * (e.R1 + p.P.norm());
      EXPECT_NEAR(signed_distance(edge.body, p.P).value, 0, scale);
      EXPECT_NEAR(signed_distance(edge.profile, p.P.head<2>()).value, 0, scale);
      EXPECT_NEAR(p.n1.norm(), 1, 1e-12);
      EXPECT_NEAR(p.t.dot(p.e1), 0, 1e-13);
      EXPECT_NEAR(p.t.dot(p.e2), 0, 1e-13);
      EXPECT_NEAR(p.t.dot(p.n1), 0, 1e-13);
      EXPECT_NEAR(p.e1.dot(p.e2), 0, 1e-13);
      EXPECT_NEAR(p.e2.norm(), 1, 1e-13);
      EXPECT_GT(edge.m * p.n1.dot(p.e2), 0);  // into the material
      EXPECT_NEAR(std::cos(p.theta), -edge.m * p.n1.dot(p.e1), 1e-12);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 15000);
}

// Oracle: central difference of the points.
TEST(Ridge, TangentMatchesCentralDifference) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const tests::RandomEdge e = tests::random_edge(random);
    SCOPED_TRACE(testing::PrintToString(e));
    const Edge edge = tests::edge_of(e);
    const double u = unit(random);
    const Eigen::Vector3d d = ridge_at(edge, u + 1e-6).P - ridge_at(edge, u - 1e-6).P;
    EXPECT_NEAR(std::abs(d.normalized().dot(ridge_at(edge, u).t)), 1, 1e-8);
  }
}

// Entry is the meeting point of greater z'.
TEST(Ridge, EntryIsAboveExit) {
  std::mt19937 random(13);
  for (int i = 0; i < 500; ++i) {
    tests::RandomEdge e = tests::random_edge(random);
    e.side = Side::Entry;
    const Edge entry = tests::edge_of(e);
    e.side = Side::Exit;
    const Edge exit = tests::edge_of(e);
    for (int k = 0; k < 10; ++k) {
      EXPECT_GT(ridge_at(entry, k / 10.).P.z(), ridge_at(exit, k / 10.).P.z());
    }
  }
}

}  // namespace
}  // namespace ridgeline::geometry
