#include "core/verify/overcut.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/verify/countersink.hpp"

namespace ridgeline::verify {
namespace {

using path::MoveKind;

TEST(Overcut, ACleanLoopHasNone) {
  const Countersink c;
  EXPECT_EQ(measure(subject_of(c), polygon(c, 200)).overcut, 0);
  EXPECT_EQ(measure(subject_of(c), circle(c)).overcut, 0);
}

// The lead-out goes down into the hole, 2.5 off its axis: the ball of 3 cuts the wall, of 5, to
// 2.5 + 3 - 5 = 0.5, and that far below the chamfer.
TEST(Overcut, APlungeBesideTheWallIsAsDeepAsItReaches) {
  const Countersink c;
  path::Motion motion = polygon(c, 200);
  motion.moves.pop_back();
  add_line(motion, MoveKind::Retract, {0, 0, 12});
  add_line(motion, MoveKind::Retract, {2.5, 0, 5});
  add_line(motion, MoveKind::Retract, {2.5, 0, 4});
  const Report report = measure(subject_of(c), motion);
  EXPECT_NEAR(report.overcut, 0.5, 1e-9);
  ASSERT_TRUE(report.overcut_at);
  EXPECT_GE(report.overcut_at->move, 202U);
  EXPECT_NEAR(report.overcut_at->point.x(), 2.5, 1e-6);
}

// Away over the top, 2.9 above it: the ball of 3 scratches it by 0.1.
TEST(Overcut, AScratchOnTheFaceCounts) {
  const Countersink c;
  path::Motion motion = polygon(c, 200);
  add_line(motion, MoveKind::Retract, {25, 0, 32});
  add_line(motion, MoveKind::Retract, {25, 0, 12.9});
  EXPECT_NEAR(measure(subject_of(c), motion).overcut, 0.1, 1e-9);
}

// The edge of the block at x = 30, z = 10, passed by at (30 + 1.8, 10 + 2.4) + 0.1 along Y: 3 - 3.1
// clear with the ball of 3, 0.15 deep with the passage 0.25 nearer.
TEST(Overcut, AnEdgeOfTheBodyIsCutByWhatTheBallReachesOverIt) {
  const Countersink c;
  for (const double gap : {0.1, -0.15}) {
    SCOPED_TRACE(gap);
    const double far = 3 + gap;
    path::Motion motion = polygon(c, 200);
    const Eigen::Vector3d beside(30 + 0.6 * far, -20, 10 + 0.8 * far);
    add_line(motion, MoveKind::Retract, {beside.x(), -20, 40});
    add_line(motion, MoveKind::Retract, beside);
    add_line(motion, MoveKind::Retract, beside + Eigen::Vector3d(0, 40, 0));
    EXPECT_NEAR(measure(subject_of(c), motion).overcut, std::max(0.0, -gap), 1e-9);
  }
}

TEST(Overcut, ARapidThroughMaterialCounts) {
  const Countersink c;
  path::Motion motion = polygon(c, 200);
  add_line(motion, MoveKind::Rapid, {20, 0, 20});
  add_line(motion, MoveKind::Rapid, {20, 0, 12});
  EXPECT_NEAR(measure(subject_of(c), motion).overcut, 1, 1e-4);
  EXPECT_NEAR(measure(subject_of(c), motion).rapid_clearance, -1, 1e-4);
}

// Too large a ball for the far wall: the loop's own other side is not an overcut as long as it is
// chamfer, whatever its width; below it is. Ball of 4.5 on r = 2, at z = 11: reaches the wall of 5
// at 1.5 below the top and more, so that no border is within reach of the asked width.
TEST(Overcut, ABallTooWideForTheHoleCutsBelowTheBand) {
  const Countersink c{.R2 = 5, .D = 4.5, .r = 2, .z = 8};
  Subject subject = subject_of({.R2 = 5, .D = 3, .r = 3, .z = 12});
  subject.tool.radius = 4.5;
  const Report report = measure(subject, polygon(c, 300));
  EXPECT_GT(report.width_max, 1.5 * subject.width);
  EXPECT_NEAR(report.overcut, 4.5 + 2 - 5, 1e-3);  // at z = 8 the ball is widest
}

}  // namespace
}  // namespace ridgeline::verify
