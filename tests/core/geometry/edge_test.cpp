#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"
#include "core/geometry/workpiece.hpp"
#include "tests/support/random_edges.hpp"

namespace ridgeline::geometry {
namespace {

// Tube: bore 20, outside 30, length 100, A1 along Y through (1, 2, 3).
Workpiece tube() {
  Workpiece w;
  w.position = {1, 2, 3};
  w.inner_radius = 20;
  w.outer_radius = 30;
  w.length = 100;
  return w;
}

Workpiece block() {
  Workpiece w;
  w.shape = BodyShape::ManifoldBlock;
  w.inner_radius = 10;
  w.size = {60, 100, 40};
  return w;
}

Hole round_hole(double R2, double f = 0) {
  Hole hole;
  hole.profile.R2 = R2;
  hole.position = {1 + f, 2, 3};
  return hole;
}

// Design section 1: alpha turns A1 about Z, beta tilts A2 from Z towards A1; worked by hand.
TEST(HoleFrame, OfTheAngles) {
  const double alpha = radians(30);
  const double beta = radians(20);
  Workpiece w = tube();
  w.axis = {-std::sin(alpha), std::cos(alpha), 0};
  Hole hole = round_hole(5);
  hole.axis = std::sin(beta) * w.axis + std::cos(beta) * Eigen::Vector3d::UnitZ();
  const Frame frame = hole_frame(w, hole);
  const Eigen::Vector3d x(std::cos(alpha), std::sin(alpha), 0);
  EXPECT_NEAR((frame.axes.col(0) - x).norm(), 0, 1e-15);
  EXPECT_NEAR((frame.axes.col(2) - hole.axis).norm(), 0, 1e-15);
  EXPECT_NEAR(frame.axes.determinant(), 1, 1e-14);
  EXPECT_NEAR(frame.axes.col(1).dot(w.axis), std::cos(beta), 1e-15);  // "along" points with A1
}

// [0064], (2): A1 passes at x = -f of the hole axis.
TEST(HoleFrame, EccentricDistanceIsTheOffsetOfTheHoleAlongX) {
  EXPECT_NEAR(eccentric_distance(tube(), round_hole(5, 3)), 3, 1e-15);
  const Edge edge = edge_of(tube(), round_hole(5, 3), EdgeKind::Inner, Side::Entry);
  const auto& bore = std::get<Cylinder>(edge.body);
  const Eigen::Vector3d off = bore.point - bore.point.dot(bore.axis) * bore.axis;
  EXPECT_NEAR((off - Eigen::Vector3d(-3, 0, 0)).norm(), 0, 1e-13);
}

TEST(HoleFrame, OriginIsTheFootOfTheCommonPerpendicular) {
  std::mt19937 random(21);
  for (int i = 0; i < 1000; ++i) {
    const tests::RandomEdge e = tests::random_edge(random, {.max_tilt = 1.3});
    SCOPED_TRACE(testing::PrintToString(e));
    const Frame frame = hole_frame(e.workpiece, e.hole);
    const Eigen::Vector3d foot = frame.origin - e.f * frame.axes.col(0);  // on A1
    EXPECT_NEAR((foot - e.workpiece.position).cross(e.workpiece.axis).norm(), 0, 1e-10);
    EXPECT_NEAR((frame.origin - e.hole.position).cross(e.hole.axis).norm(), 0, 1e-10);
    EXPECT_NEAR(frame.axes.col(0).dot(e.workpiece.axis), 0, 1e-13);
    EXPECT_NEAR(eccentric_distance(e.workpiece, e.hole), e.f, 1e-10);
  }
}

TEST(HoleFrame, PositionOfAnEccentricDistanceGivesItBack) {
  Workpiece w = tube();
  w.axis = Eigen::Vector3d(0.2, 1, -0.3).normalized();
  const Eigen::Vector3d A2 = Eigen::Vector3d(0.1, 0.3, 1).normalized();
  Hole hole = round_hole(5);
  hole.axis = A2;
  hole.position = position_of(w, A2, -4);
  EXPECT_NEAR(eccentric_distance(w, hole), -4, 1e-14);
}

TEST(BlockFrame, UprightBoreKeepsX) {
  Workpiece w = block();
  EXPECT_TRUE(block_frame(w).axes.isApprox(Eigen::Matrix3d::Identity(), 1e-15));
  w.axis = {0, 0, 1};
  EXPECT_TRUE(block_frame(w).axes.col(0).isApprox(Eigen::Vector3d(1, 0, 0)));
  EXPECT_NEAR(block_frame(w).axes.determinant(), 1, 1e-15);
}

// The face that A2 leaves through: top and bottom of an upright hole, worked by hand.
TEST(Edge, OuterEdgeOfABlockIsOnTheFaceThatTheHoleLeavesThrough) {
  Hole hole;
  hole.profile.R2 = 3;
  for (const Side side : {Side::Entry, Side::Exit}) {
    const Edge edge = edge_of(block(), hole, EdgeKind::Outer, side);
    const Eigen::Vector3d P = to_outer(edge.frame, ridge_at(edge, 0.1).P);
    EXPECT_NEAR(P.z(), side == Side::Entry ? 20 : -20, 1e-13);
    EXPECT_EQ(edge.m, -1);
  }
  hole.axis = {1, 0, 0};  // now through the sides
  const Edge edge = edge_of(block(), hole, EdgeKind::Outer, Side::Entry);
  EXPECT_NEAR(to_outer(edge.frame, ridge_at(edge, 0.1).P).x(), 30, 1e-13);
}

TEST(Edge, FloorOfABlindHoleIsMeasuredFromTheMouth) {
  Hole hole = round_hole(5);
  hole.depth = 12;
  EXPECT_NEAR(floor_height(tube(), hole).value(), 30 - 12, 1e-13);
  EXPECT_EQ(floor_height(tube(), round_hole(5)), std::nullopt);
  // The bore's edge is at z' 19.36 to 20: above the floor at 18, below one at 19.5.
  EXPECT_NO_THROW(edge_of(tube(), hole, EdgeKind::Inner, Side::Entry));
  hole.depth = 10.5;
  EXPECT_THROW(edge_of(tube(), hole, EdgeKind::Inner, Side::Entry), Error);
  EXPECT_NO_THROW(edge_of(tube(), hole, EdgeKind::Outer, Side::Entry));
}

TEST(Edge, EveryRandomEdgeIsAccepted) {
  std::mt19937 random(22);
  int checked = 0;
  for (int i = 0; i < 2000; ++i) {
    const tests::RandomEdge e = tests::random_edge(random);
    SCOPED_TRACE(testing::PrintToString(e));
    EXPECT_NO_THROW(tests::edge_of(e));
    ++checked;
  }
  EXPECT_EQ(checked, 2000);
}

struct Refused {
  std::string name;
  ErrorCode code;
  Workpiece workpiece;
  Hole hole;
  EdgeKind kind = EdgeKind::Inner;
  Side side = Side::Entry;
};
void PrintTo(const Refused& refused, std::ostream* out) {
  *out << refused.name;
}

template <class Change>
Workpiece tube_with(Change change) {
  Workpiece w = tube();
  change(w);
  return w;
}
template <class Change>
Hole hole_with(double R2, double f, Change change) {
  Hole hole = round_hole(R2, f);
  change(hole);
  return hole;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<Refused> refused_edges() {
  const auto given = [](double f) { return [f](Hole& hole) { hole.eccentric_distance = f; }; };
  using enum ErrorCode;
  return {
      {"GivenEccentricityDiffers", InconsistentEccentricity, tube(),
       hole_with(5, 3, given(3.000002))},
      {"GivenEccentricityOfTheOtherSign", InconsistentEccentricity, tube(),
       hole_with(5, 3, given(-3))},
      {"GivenEccentricityIsNan", InconsistentEccentricity, tube(), hole_with(5, 3, given(nan))},
      {"TouchesTheSideOfTheBore", TangentIntersection, tube(), round_hole(5, 15)},
      {"TouchesTheOtherSideOfTheBore", TangentIntersection, tube(), round_hole(5, -15)},
      {"SameRadii", TangentIntersection, tube(), round_hole(20)},
      {"BesideTheBore", HoleMissesBody, tube(), round_hole(2, 23)},
      {"BesideTheTube", HoleMissesBody, tube(), round_hole(2, 33), EdgeKind::Outer},
      {"OneWallHasNoExit", HoleMissesBody, tube(),
       hole_with(5, 0, [](Hole& hole) { hole.walls = 1; }), EdgeKind::Inner, Side::Exit},
      {"BeyondTheEndOfTheTube", HoleMissesBody, tube(),
       hole_with(5, 0, [](Hole& hole) { hole.position.y() += 45.5; })},
      {"OverTheCornerOfTheBlock", HoleMissesBody, block(),
       hole_with(3, 0,
                 [](Hole& hole) {
                   hole.position = {28, 0, 0};
                 }),
       EdgeKind::Outer},
      {"BlindHoleAboveTheBore", HoleMissesBody, tube(),
       hole_with(5, 0, [](Hole& hole) { hole.depth = 5; })},
      {"AxesNearlyParallel", BadInput, tube(),
       hole_with(5, 0,
                 [](Hole& hole) {
                   hole.axis = {0, 1, 0.1};
                 })},
      {"NoBore", BadInput, tube_with([](Workpiece& w) { w.inner_radius = 0; }), round_hole(5)},
      {"NoWall", BadInput, tube_with([](Workpiece& w) { w.outer_radius = 20; }), round_hole(5)},
      {"NanRadius", BadInput, tube(), round_hole(nan)},
      {"NanPosition", BadInput, tube(), round_hole(5, nan)},
      {"NegativeStraight", BadInput, tube(),
       hole_with(5, 0, [](Hole& hole) { hole.profile.straight_along = -1; })},
      {"ZeroAxis", BadInput, tube(), hole_with(5, 0, [](Hole& hole) { hole.axis.setZero(); })},
      {"InfiniteLength", BadInput, tube_with([](Workpiece& w) { w.length = infinity; }),
       round_hole(5)},
  };
}

class EdgeRefuses : public testing::TestWithParam<Refused> {};

TEST_P(EdgeRefuses, WithItsCode) {
  const Refused& r = GetParam();
  try {
    edge_of(r.workpiece, r.hole, r.kind, r.side);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), r.code) << error.what();
    EXPECT_FALSE(error.details().field.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(, EdgeRefuses, testing::ValuesIn(refused_edges()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace ridgeline::geometry
