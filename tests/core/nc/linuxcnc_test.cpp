// LinuxCNC's own interpreter reads what write() prints. It is required: scripts/test installs it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/nc/rs274.hpp"
#include "tests/core/nc/samples.hpp"

namespace ridgeline::nc {
namespace {

/// The canonical calls print 4 decimals; more are rounded there.
double print_error(const Program& program) {
  return program.decimals <= 4 ? 1e-9 : 0.5e-4 + 1e-9;
}

void expect_same(const CanonMove& canon, const path::Move& move, const Program& program) {
  const double error = print_error(program);
  EXPECT_LE((canon.to - move.to).cwiseAbs().maxCoeff(), error)
      << canon.call << ' ' << canon.to.transpose() << " for " << move.to.transpose();
  EXPECT_NEAR(canon.feed, move.feed * 60, 0.51e-4);
  if (!move.arc) {
    EXPECT_EQ(canon.call, move.feed == 0 ? "STRAIGHT_TRAVERSE" : "STRAIGHT_FEED");
    return;
  }
  ASSERT_EQ(canon.call, "ARC_FEED");
  const auto [i, j, k] = path::axes_of(move.arc->plane);
  EXPECT_EQ(canon.plane, "XYZ"[k]);
  EXPECT_EQ(canon.turns, move.arc->sense == path::ArcSense::CounterClockwise ? 1 : -1);
  EXPECT_NEAR(canon.centre[i], move.arc->centre[i], error);
  EXPECT_NEAR(canon.centre[j], move.arc->centre[j], error);
}

/// The interpreter's moves are the two of the approach and then ours.
void expect_runs_as_rounded(const Program& program) {
  const std::string text = write(program);
  const CanonRun run = run_rs274(text);
  ASSERT_EQ(run.exit_code, 0) << run.output << text;
  const path::Motion motion = rounded(program);
  ASSERT_EQ(run.moves.size(), motion.moves.size() + 2) << run.output << text;
  EXPECT_LE((run.moves[1].to - motion.start).cwiseAbs().maxCoeff(), print_error(program));
  for (std::size_t n = 0; n < motion.moves.size(); ++n) {
    SCOPED_TRACE("move " + std::to_string(n));
    expect_same(run.moves[n + 2], motion.moves[n], program);
  }
}

TEST(LinuxCnc, RunsTheHandMadeProgramAsRounded) {
  Program program = hand_made_program(Dialect::LinuxCnc);
  expect_runs_as_rounded(program);
  program.positioning = Positioning::Incremental;
  expect_runs_as_rounded(program);
}

TEST(LinuxCnc, RunsRandomProgramsAsRounded) {
  RandomPrograms random(274);
  std::size_t moves = 0, arcs = 0;
  for (int n = 0; n < 20; ++n) {
    SCOPED_TRACE("program " + std::to_string(n));
    const Program program = random.program(Dialect::LinuxCnc, 400);  // a start takes long
    expect_runs_as_rounded(program);
    if (testing::Test::HasFailure()) break;
    for (const path::Move& move : rounded(program).moves) {
      ++moves;
      if (move.arc) ++arcs;
    }
  }
  EXPECT_GT(moves, 1500U);
  EXPECT_GT(arcs, 500U);
}

TEST(LinuxCnc, TakesTheLengthOfTheTool) {
  const CanonRun run = run_rs274(write(hand_made_program(Dialect::LinuxCnc)));
  ASSERT_EQ(run.length_offsets.size(), 2U) << run.output;  // G49, then G43
  EXPECT_EQ(run.length_offsets[0], Eigen::Vector3d(0, 0, 0));
  EXPECT_NEAR(run.length_offsets[1].z(), 100, 1e-9);
}

TEST(LinuxCnc, CallsASubprogramByItsNumber) {
  Program program = hand_made_program(Dialect::LinuxCnc);
  program.kind = ProgramKind::Subprogram;
  std::string text = write(program);
  // The file has the subprogram alone; here the call stands before its M2.
  const std::size_t end = text.rfind("M2");
  ASSERT_NE(end, std::string::npos);
  EXPECT_TRUE(run_rs274(text).moves.empty());
  text.insert(end, "o<9101> call\n");
  EXPECT_EQ(run_rs274(text).moves.size(), rounded(program).moves.size() + 2);
}

// The harness itself: what the interpreter refuses is seen.
TEST(LinuxCnc, ABrokenProgramFails) {
  EXPECT_NE(run_rs274("%\nG21 G1 X1 F100\nG2 X2 Y2 I9 J9\nM2\n%\n").exit_code, 0);
}

}  // namespace
}  // namespace ridgeline::nc
