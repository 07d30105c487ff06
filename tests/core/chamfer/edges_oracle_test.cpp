// Oracle: tests/oracle/chamfer/edges.py solves both methods with mpmath at 30 digits, sharing no
// code and no formula with the solver (four unknowns, general root finding, borders differentiated
// numerically). Held to 1e-8 and 2e-7 mm.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/base/angle.hpp"
#include "core/chamfer/section.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

Vector3d vector(const json& digits) {
  const auto number = [&](std::size_t i) { return std::stod(digits.at(i).get<std::string>()); };
  return {number(0), number(1), number(2)};
}

geometry::Edge edge_of(const json& entry) {
  const double beta = radians(entry.at("penetration_angle").get<double>());
  const double R1 = entry.at("R1");
  geometry::Edge edge;
  edge.profile = {.R2 = entry.at("R2"),
                  .straight_along = entry.at("straight_along"),
                  .straight_across = entry.at("straight_across")};
  if (entry.at("body") == "plane") {
    const Vector3d normal(0, -std::sin(beta), std::cos(beta));
    edge.body = geometry::Plane{.point = R1 * normal, .normal = normal};
  } else {
    edge.body = geometry::Cylinder{.point = {-entry.at("f").get<double>(), 0, 0},
                                   .axis = {0, std::cos(beta), std::sin(beta)},
                                   .radius = R1};
  }
  edge.m = entry.at("m");
  edge.side = entry.at("side") == "entry" ? geometry::Side::Entry : geometry::Side::Exit;
  return edge;
}

Chamfer chamfer_of(const json& entry) {
  Chamfer chamfer{.W = entry.at("W"), .D = entry.at("D")};
  if (!entry.at("delta").is_null())
    chamfer.section_angle = ConstantAngle{.delta = radians(entry.at("delta").get<double>())};
  return chamfer;
}

TEST(EdgesOracle, BothMethodsMatchIndependentSolutions) {
  std::ifstream file(RIDGELINE_TESTS "/oracle/chamfer/edges.json");
  const json edges = json::parse(file);
  int checked = 0;
  for (const json& entry : edges) {
    const geometry::Edge edge = edge_of(entry);
    const Chamfer chamfer = chamfer_of(entry);
    for (const json& point : entry.at("points")) {
      const double u = point.at("u");
      SCOPED_TRACE(testing::Message() << entry.at("name") << " u=" << u);
      const SectionPoint section = section_at(edge, chamfer, u);
      EXPECT_NEAR((section.ridge.P - vector(point.at("P"))).norm(), 0, 1e-10);
      EXPECT_NEAR((section.G1 - vector(point.at("G1"))).norm(), 0, 1e-8);
      EXPECT_NEAR((section.G2 - vector(point.at("G2"))).norm(), 0, 1e-8);
      EXPECT_NEAR((section.C - vector(point.at("section"))).norm(), 0, 1e-8);
      EXPECT_NEAR((swept_at(edge, chamfer, u).C - vector(point.at("swept"))).norm(), 0, 2e-7);
      ++checked;
    }
  }
  EXPECT_EQ(checked, 96);
}

}  // namespace
}  // namespace ridgeline::chamfer
