#include "core/verify/clearance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "core/path/pieces.hpp"
#include "tests/core/verify/countersink.hpp"

namespace ridgeline::verify {
namespace {

using Eigen::Vector3d;
using geometry::Solid;
using geometry::Trace;

tool::Tool lollipop() {
  tool::Tool tool;
  tool.radius = 3;
  tool.neck_radius = 1.5;
  tool.neck_length = 20;
  tool.shank_radius = 4;
  tool.stickout = 40;
  tool.holder_radius = 12;
  return tool;
}

Trace trace_of(const path::Motion& motion) {
  return Trace(path::pieces_of(motion, Vector3d::Zero()));
}

// The neck leaves the ball of 3 at sqrt(9 - 2.25) above its centre; ends count from the tip.
TEST(Clearance, ToolSurfacesAreTheDescribedParts) {
  const std::vector<tool::Surface> neck = tool::neck_of(lollipop(), 500);
  ASSERT_EQ(neck.size(), 3U);
  EXPECT_DOUBLE_EQ(neck[0].low, std::sqrt(9 - 2.25));
  EXPECT_DOUBLE_EQ(neck[0].high, 17);
  EXPECT_DOUBLE_EQ(neck[1].low, 17);
  EXPECT_DOUBLE_EQ(neck[1].high, 37);
  EXPECT_DOUBLE_EQ(neck[1].outer, 4);
  EXPECT_DOUBLE_EQ(neck[2].low, 17);  // the ring between
  EXPECT_DOUBLE_EQ(neck[2].inner, 1.5);
  EXPECT_DOUBLE_EQ(neck[2].outer, 4);
  const std::vector<tool::Surface> holder = tool::holder_of(lollipop(), 500);
  ASSERT_EQ(holder.size(), 2U);
  EXPECT_DOUBLE_EQ(holder[0].low, 37);
  EXPECT_DOUBLE_EQ(holder[0].high, 500);
  tool::Tool bare;
  bare.radius = 3;
  EXPECT_TRUE(tool::neck_of(bare, 500).empty());
  EXPECT_TRUE(tool::holder_of(bare, 500).empty());
}

// Hole of 5 with its loop on r = 3, 4 below the top: the neck of 1.5 comes to 5 - 3 - 1.5. The
// shank of 4 is 17 above the centre: 23 - 10 - 0 over the top. The holder 37: 33 over it.
TEST(Clearance, InAStraightHoleItIsWhatIsLeft) {
  const Countersink c{.R2 = 5, .D = 3, .r = 3, .z = 6};
  const Subject subject = subject_of({});
  const Solid solid(subject.workpiece);
  for (const path::Motion& motion : {polygon(c, 400), circle(c)}) {
    const Trace trace = trace_of(motion);
    EXPECT_NEAR(clearance(solid, trace, Vector3d::UnitZ(), tool::neck_of(lollipop(), 200)).value,
                0.5, 1e-7);
    EXPECT_NEAR(clearance(solid, trace, Vector3d::UnitZ(), tool::holder_of(lollipop(), 200)).value,
                33, 1e-7);
  }
}

// The holder of 12, its face 2 over the top of the block, never meets it; turned over to point
// down, tip up, everything goes through the block.
TEST(Clearance, AFlatHolderFaceIsFlat) {
  tool::Tool tool = lollipop();
  tool.stickout = 9;
  tool.shank_radius.reset();
  tool.neck_length.reset();
  const Countersink c{.R2 = 5, .D = 3, .r = 1, .z = 6};
  const Solid solid(subject_of({}).workpiece);
  const Trace trace = trace_of(circle(c));
  EXPECT_NEAR(clearance(solid, trace, Vector3d::UnitZ(), tool::holder_of(tool, 200)).value, 2,
              1e-7);
  EXPECT_LT(clearance(solid, trace, -Vector3d::UnitZ(), tool::holder_of(tool, 200)).value, 0);
}

// The holder passes a corner of the block: rim 12 round, 1 beyond the corner in X and 2 above.
TEST(Clearance, ARimPassingAnEdgeIsMeasuredAcross) {
  tool::Tool tool;
  tool.radius = 3;
  tool.stickout = 10;
  tool.holder_radius = 12;
  const Solid solid(subject_of({}).workpiece);
  path::Motion motion;
  motion.start = {30 + 12 + 1, -10, 10 - 7 + 2};
  add_line(motion, path::MoveKind::Retract, motion.start + Vector3d(0, 20, 0));
  EXPECT_NEAR(
      clearance(solid, trace_of(motion), Vector3d::UnitZ(), tool::holder_of(tool, 200)).value,
      std::sqrt(5), 1e-6);
}

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution(low, high)(random);
}

Vector3d any_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3d(normal(random), normal(random), normal(random)).normalized();
}

/// A point of a surface at random: height and radius uniform, any turn.
Vector3d any_point(std::mt19937& random, const tool::Surface& s, const Vector3d& axis) {
  const Vector3d x = axis.unitOrthogonal();
  const double turn = uniform(random, 0, 2 * std::numbers::pi);
  return uniform(random, s.low, s.high) * axis +
         uniform(random, s.inner, s.outer) * (std::cos(turn) * x + std::sin(turn) * axis.cross(x));
}

// Random tools, axes and short paths about the mouth of a hole, against sampled points of the tool:
// no sampled point is nearer than the clearance, and one comes within the sampling of it.
TEST(Clearance, NoSampledPointOfTheToolIsNearer) {
  std::mt19937 random(20240301);
  int clear = 0, meeting = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    geometry::Workpiece part;
    part.inner_radius = uniform(random, 8, 12);
    part.outer_radius = part.inner_radius + uniform(random, 3, 8);
    part.length = 60;
    geometry::Hole hole;
    hole.profile.R2 = uniform(random, 3, 6);
    if (i % 3 == 0) hole.profile.straight_along = 5;
    hole.position = {uniform(random, -2, 2), 0, 0};
    hole.axis = {0, std::sin(uniform(random, -0.7, 0.7)), 1};
    hole.walls = 1 + i % 2;
    part.holes = {hole};
    const Solid solid(part);
    const Vector3d axis = (hole.axis.normalized() + 0.3 * any_direction(random)).normalized();
    path::Motion motion;
    motion.start = {uniform(random, -2, 2), uniform(random, -2, 2),
                    uniform(random, 5, 1.3 * part.outer_radius)};
    for (int k = 0; k < 4; ++k) {
      add_line(motion, path::MoveKind::Cut, motion.start + any_direction(random));
    }
    tool::Tool tool;
    tool.radius = 1.5;
    tool.neck_radius = uniform(random, 0.5, 1.2);
    tool.neck_length = uniform(random, 4, 20);
    tool.shank_radius = uniform(random, 0.5, 3);
    tool.stickout = *tool.neck_length + uniform(random, 2, 10);
    tool.holder_radius = 6;
    std::vector<tool::Surface> surfaces = tool::neck_of(tool, 100);
    for (const tool::Surface& s : tool::holder_of(tool, 100)) surfaces.push_back(s);

    const Trace trace = trace_of(motion);
    const Clearance found = clearance(solid, trace, axis, surfaces);
    double sampled = 1e9;
    for (int k = 0; k < 4000; ++k) {
      const geometry::Piece& piece = trace.pieces()[random() % trace.pieces().size()];
      const Vector3d c = geometry::at(piece, uniform(random, 0, 1));
      const tool::Surface& surface = surfaces[random() % surfaces.size()];
      sampled = std::min(sampled, solid.distance(c + any_point(random, surface, axis)));
    }
    if (found.value > 0) {
      EXPECT_GE(sampled, found.value - 1e-4) << "clearance " << found.value;
      EXPECT_LE(sampled, found.value + 1.5);
      EXPECT_NEAR(solid.distance(found.point), found.value, 1e-9);
      ++clear;
    } else {
      EXPECT_LT(geometry::distance(solid.material(), found.point), 0);
      ++meeting;
    }
    EXPECT_TRUE(sampled >= 0 || found.value < 0);
  }
  EXPECT_GT(clear, 10);
  EXPECT_GT(meeting, 20);
}

}  // namespace
}  // namespace ridgeline::verify
