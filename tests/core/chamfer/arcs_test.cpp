#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/chamfer/cross_hole.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector3d;
using path::MoveKind;

// The arcs end on the ideal path: where lines need 0.005, their blocks are fewer, and the width
// stays within what lines of the same tolerance cut.
TEST(Solve, ArcsNeedFewerBlocksThanLines) {
  Job job = cross_hole();
  job.workpiece.inner_radius = 40;
  job.workpiece.outer_radius = 50;
  job.workpiece.holes[0].position = {0, 0, 0};
  job.tolerance = 0.002;
  const Result lines = solve(job);
  job.arcs = true;
  const Result arcs = solve(job);
  EXPECT_LE(arcs.centres.size() * 3, lines.centres.size());
  EXPECT_LE(arcs.chord_error, job.tolerance);
  int round = 0;
  for (const path::Move& move : arcs.motion.moves) {
    round += move.kind == MoveKind::Cut && move.arc ? 1 : 0;
  }
  EXPECT_GT(round, 10);
  const verify::Report report = measured(job, arcs);
  EXPECT_NEAR(report.width_max, job.width, 0.006);
  EXPECT_NEAR(report.width_min, job.width, 0.006);
  EXPECT_EQ(report.overcut, 0);
}

// Of the fewest that can be: helices need integral sqrt(|z''| / (16 TA)) ds, lines integral
// sqrt(kappa / (8 TA)) ds (core/path/arc_fit.hpp), here 25 and 86.
TEST(Solve, ArcsAreHardlyMoreThanTheLeastCount) {
  Job job = cross_hole();
  job.workpiece.inner_radius = 20;
  job.workpiece.outer_radius = 30;
  job.workpiece.holes[0].position = {0, 0, 0};
  job.workpiece.holes[0].profile.R2 = 5;
  job.tool.radius = 3;
  job.width = 0.5;
  job.tolerance = 0.002;
  job.arcs = true;
  EXPECT_LE(solve(job).centres.size(), 27U);
}

int arc_count(const Result& result) {
  return static_cast<int>(std::ranges::count_if(
      result.motion.moves, [](const path::Move& move) { return move.arc.has_value(); }));
}

// A tilted tool: the arcs are those of its plane, where the edge of a hole along it is as round as
// that of a straight hole.
TEST(Solve, TiltedPlaneTakesAsFewArcs) {
  Job job = cross_hole();
  job.workpiece.holes[0].position = {0, 0, 0};
  job.arcs = true;
  const Eigen::Vector3d axis = Vector3d(0, std::sin(0.2), std::cos(0.2));
  job.workpiece.holes[0].axis = axis;
  job.tool_axis = Access::Hole;
  const Result tilted = solve(job);
  EXPECT_LT((tilted.tool_axis - axis).norm(), 1e-12);
  int round = 0;
  for (const path::Move& move : tilted.motion.moves) {
    if (!move.arc) continue;
    ++round;
    EXPECT_EQ(move.arc->plane, path::ArcPlane::XY);
    EXPECT_LT((move.arc->axes.col(2) - axis).norm(), 1e-12);
  }
  EXPECT_GT(round, 10);
  job.arc_frame = ArcFrame::WorkFrameXY;
  const Result flat = solve(job);
  for (const path::Move& move : flat.motion.moves) {
    if (!move.arc) continue;
    EXPECT_TRUE(move.arc->axes.isIdentity(0));
    EXPECT_EQ(move.arc->plane, path::ArcPlane::XY);
  }
  EXPECT_GT(arc_count(flat), 10);
}

// Chosen points: that many blocks, each an arc between two of them; what they miss is less
// than with chords, and is what is reported.
TEST(Solve, ChosenPointsAreJoinedByArcs) {
  Job job = cross_hole();
  job.points = 48;
  const Result lines = solve(job);
  job.arcs = true;
  const Result arcs = solve(job);
  ASSERT_EQ(arcs.centres.size(), 48U);
  for (std::size_t i = 0; i < 48; ++i) {
    EXPECT_NEAR(arcs.parameter[i], lines.parameter[i], 1e-12);
    EXPECT_LT((arcs.centres[i] - lines.centres[i]).norm(), 1e-9);
  }
  EXPECT_GE(arc_count(arcs), 48);
  EXPECT_LT(arcs.chord_error, 0.8 * lines.chord_error);
  const verify::Report by_arcs = measured(job, arcs), by_lines = measured(job, lines);
  EXPECT_LT(job.width - by_arcs.width_min, 0.8 * (job.width - by_lines.width_min));
  EXPECT_EQ(by_arcs.overcut, 0);
}

}  // namespace
}  // namespace ridgeline::chamfer
