#include "core/verify/overcut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

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

/// A row of round holes along Y through the top of the block, thin ribs between them.
struct Row {
  std::vector<geometry::Hole> holes;

  /// To the material from above its top, inside of which no point of the test is.
  double distance(const Eigen::Vector3d& c) const {
    for (const geometry::Hole& hole : holes) {
      const double inside = hole.profile.R2 - (c - hole.position).head<2>().norm();
      if (inside > 0) return std::hypot(inside, c.z() - 10);
    }
    return c.z() - 10;
  }
};

Row row(std::mt19937& random) {
  const auto any = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Row row;
  double y = -30;
  for (int i = 0; y < 25; ++i) {
    geometry::Hole hole;
    hole.name = "R" + std::to_string(i);
    hole.profile.R2 = any(1.5, 3);
    hole.position = {any(19, 21), y + hole.profile.R2, 0};
    if (i > 0) {  // the rib as thin as it is where the circles are nearest
      const double across = hole.position.x() - row.holes.back().position.x();
      const double apart =
          row.holes.back().profile.R2 + hole.profile.R2 + std::pow(10, any(-3, -0.7));
      hole.position.y() =
          row.holes.back().position.y() + std::sqrt(apart * apart - across * across);
    }
    y = hole.position.y() + hole.profile.R2;
    row.holes.push_back(hole);
  }
  return row;
}

// Straight ways across the row, at random heights and tilts: what is cut between two holes is a rib
// much thinner than any step along the way. Brute force on the closed form of the distance.
TEST(Overcut, ThinRibsAreNotMissed) {
  std::mt19937 random(20);
  const auto any = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const Countersink c;
  int cut = 0;
  for (int n = 0; n < 30; ++n) {
    SCOPED_TRACE(n);
    const Row ribs = row(random);
    Subject subject = subject_of(c);
    for (const geometry::Hole& hole : ribs.holes) subject.workpiece.holes.push_back(hole);
    path::Motion motion = polygon(c, 200);
    const double low = any(11.5, 13.1);
    const Eigen::Vector3d from(any(19, 21), -30, low), to(any(19, 21), 28, low + any(0, 0.2));
    for (const Eigen::Vector3d& above : {motion.start, from}) {
      add_line(motion, MoveKind::Retract, {above.x(), above.y(), 40});
    }
    add_line(motion, MoveKind::Retract, from);
    add_line(motion, MoveKind::Retract, to);
    add_line(motion, MoveKind::Retract, {to.x(), to.y(), 40});

    double least = 1e9;
    constexpr int samples = 100'000;
    for (int i = 0; i <= samples; ++i) {
      least = std::min(least, ribs.distance(from + (to - from) * i / samples));
    }
    const double expected = std::max(0.0, c.D - least);
    const double found = measure(subject, motion).overcut;
    EXPECT_NEAR(found, expected, 2.5e-5);  // of the proof and of the arcs for seams
    cut += expected > 0 ? 1 : 0;
  }
  EXPECT_GT(cut, 15);
  EXPECT_LT(cut, 30);
}

}  // namespace
}  // namespace ridgeline::verify
