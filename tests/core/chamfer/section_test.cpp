#include "core/chamfer/section.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"
#include "tests/support/random_edges.hpp"
#include "tests/support/source_edge.hpp"

namespace ridgeline::chamfer {
namespace {

using geometry::Edge;
using geometry::EdgeKind;
using geometry::Side;
using std::numbers::pi;
using tests::source_edge;

double number(const nlohmann::json& text) {
  return std::stod(text.get<std::string>());
}
Eigen::Vector3d vector(const nlohmann::json& text) {
  return {number(text[0]), number(text[1]), number(text[2])};
}

// Computed with 20 digits, independently of this program; see tests/oracle.
TEST(Section, MatchesTheHoleEdgeOfTheOracle) {
  std::ifstream file(RIDGELINE_TESTS "/oracle/31_hole_edge_inner.json");
  const nlohmann::json oracle = nlohmann::json::parse(file);
  const nlohmann::json& given = oracle["params"];
  const Edge edge =
      source_edge({.R1 = number(given["R1"]), .R2 = number(given["R2"]), .f = number(given["f"])});
  const Chamfer chamfer{.W = number(given["width"]), .D = number(given["ball_radius"])};
  int checked = 0;
  for (const nlohmann::json& expected : oracle["points"]) {
    const double phi = number(expected["phi_deg"]);
    SCOPED_TRACE(phi);
    const SectionPoint point = section_at(edge, chamfer, phi / 360);
    const geometry::RidgePoint& r = point.ridge;
    EXPECT_NEAR((r.P - vector(expected["P"])).norm(), 0, 1e-13);
    EXPECT_NEAR(degrees(point.delta), number(expected["delta_deg"]), 1e-12);
    const nlohmann::json& ST = expected["S1T1S2T2"];
    EXPECT_NEAR((point.G1 - r.P).dot(r.e1), number(ST[0]), 2e-14);
    EXPECT_NEAR((point.G1 - r.P).dot(r.e2), number(ST[1]), 2e-14);
    EXPECT_NEAR((point.G2 - r.P).dot(r.e1), number(ST[2]), 2e-14);
    EXPECT_NEAR((point.G2 - r.P).dot(r.e2), number(ST[3]), 2e-14);
    EXPECT_NEAR((point.C - vector(expected["centre"])).norm(), 0, 2e-14);
    ++checked;
  }
  EXPECT_EQ(checked, 25);
}

// Printed in the design, section 10.
TEST(Section, PrintedPointsOfTheCircularHole) {
  const Edge edge = source_edge({.R1 = 20, .R2 = 5, .f = 0});
  const Chamfer chamfer{.W = 0.5, .D = 3};
  const Eigen::Vector3d at_0(2.789634, 0, 17.650182);
  const Eigen::Vector3d at_90(0, 3.062835, 18.062835);
  EXPECT_NEAR((section_at(edge, chamfer, 0).C - at_0).norm(), 0, 1e-6);
  EXPECT_NEAR((section_at(edge, chamfer, 0.25).C - at_90).norm(), 0, 1e-6);
}

// [0160]: constant X and Z on the straight parts; the values are printed in the design, section 10.
TEST(Section, ElongatedHoleHasConstantXAndZOnItsStraights) {
  const geometry::Profile profile{.R2 = 3, .straight_along = 10};
  const Edge edge = source_edge({.R1 = 20, .R2 = 3, .f = 0, .along = 10});
  const Chamfer chamfer{.W = 0.5, .D = 2};
  const double L = perimeter(profile);
  int checked = 0;
  for (double y = -4.999; y < 5; y += 0.5) {
    for (const double side : {1., -1.}) {
      const double u = side > 0 ? y / L : 0.5 + y / L;
      const Eigen::Vector3d C = section_at(edge, chamfer, u).C;
      EXPECT_NEAR(C.x(), side * 1.6583, 5e-5);
      EXPECT_NEAR(C.z(), 18.617469, 1e-6);
      EXPECT_NEAR(C.y(), side * y, 1e-12);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 40);
}

// [0192], (23), (24): across A1 the centres lie on a circle of radius R3 about A1, at one Y, as
// long as G2 is on the straight wall too.
TEST(Section, Eq23And24CentresOfTheStraightsAcrossLieOnACircle) {
  for (const EdgeKind kind : {EdgeKind::Inner, EdgeKind::Outer}) {
    const double f = 2;
    const Edge edge =
        source_edge({.R1 = 20, .R2 = 1, .f = f, .along = 8, .across = 6, .kind = kind});
    const Chamfer chamfer{.W = 0.5, .D = 2};
    const std::vector<double> u = joints(edge.profile);
    const auto centre = [&](double part) {
      return section_at(edge, chamfer, u[1] + (u[2] - u[1]) * part).C;
    };
    const Eigen::Vector3d C = centre(0.5);
    const double R3 = std::hypot(C.x() + f, C.z());  // (24)
    for (int i = 3; i <= 47; ++i) {
      const Eigen::Vector3d on = centre(i / 50.);
      EXPECT_NEAR(std::pow(on.x() + f, 2) + on.z() * on.z(), R3 * R3, 1e-11);  // (23)
      EXPECT_NEAR(on.y(), C.y(), 1e-12);                                       // [0195]
    }
  }
}

// [0187..0195] start the circle at the centres of P20 and P30. On an inner edge VP leans there so
// that G2 lies round the corner: those two centres are 4 um off the circle of the straight.
TEST(Section, CentresAtTheEndsOfAStraightAcrossAreNotOnTheCircle) {
  const Edge edge = source_edge({.R1 = 20, .R2 = 1, .f = 2, .along = 8, .across = 6});
  const Chamfer chamfer{.W = 0.5, .D = 2};
  const std::vector<double> u = joints(edge.profile);
  const double Y20 = section_at(edge, chamfer, u[1]).C.y();
  const double Y = section_at(edge, chamfer, (u[1] + u[2]) / 2).C.y();
  EXPECT_NEAR(Y - Y20, 0.0039, 1e-4);
}

// Design section 4: what every solution must hold, over thousands of edges.
TEST(Section, ResidualsHoldOverRandomEdges) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> unit(0, 1);
  int checked = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    const tests::RandomEdge e = tests::random_edge(random);
    const Edge edge = tests::edge_of(e);
    const double size = e.hole.profile.R2;
    Chamfer chamfer{.W = size * (0.02 + 0.28 * unit(random))};
    chamfer.D = chamfer.W * (0.6 + 5 * unit(random));
    const double kind = unit(random);
    if (kind < 0.2) chamfer.section_angle = ConstantAngle{radians(20 + 50 * unit(random))};
    if (kind > 0.8) chamfer.section_angle = AngleTable{{{0.3, 0.7}, {2, 0.9}, {4, 0.5}}};
    for (int k = 0; k < 4; ++k) {
      const double u = unit(random);
      SCOPED_TRACE(testing::PrintToString(e) + " W " + std::to_string(chamfer.W) + " u " +
                   std::to_string(u));
      SectionPoint p;
      try {
        p = section_at(edge, chamfer, u);
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::WidthTooLarge);
        EXPECT_EQ(error.details().parameter, u);
        ++refused;
        continue;
      }
      const double scale = 1e-12 * (e.R1 + size);
      EXPECT_NEAR(signed_distance(edge.body, p.G1).value, 0, scale);
      EXPECT_NEAR(signed_distance(edge.profile, p.G2.head<2>()).value, 0, scale);
      EXPECT_NEAR((p.G1 - p.G2).norm(), chamfer.W, 1e-13);  // (15)
      EXPECT_NEAR((p.C - p.G1).norm(), chamfer.D, 1e-12);   // (16)
      EXPECT_NEAR((p.C - p.G2).norm(), chamfer.D, 1e-12);
      EXPECT_NEAR((p.C - p.ridge.P).dot(p.ridge.t), 0, 1e-12);   // in VP [0078]
      EXPECT_NEAR((p.G1 - p.ridge.P).dot(p.ridge.t), 0, 1e-12);  // (12)
      const Eigen::Vector3d d = p.G1 - p.G2;
      EXPECT_NEAR(std::atan2(d.dot(p.ridge.e1), -d.dot(p.ridge.e2)), p.delta, 1e-11);  // (17, 21)
      EXPECT_GE(edge.m * signed_distance(edge.body, p.G2).value, 0);
      EXPECT_GT(signed_distance(edge.profile, p.G1.head<2>()).value, 0);
      ++checked;
    }
  }
  EXPECT_GT(checked, 14000);
  RecordProperty("refused", refused);
  EXPECT_LT(refused, 1200);
}

}  // namespace
}  // namespace ridgeline::chamfer
