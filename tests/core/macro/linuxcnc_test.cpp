// LinuxCNC's interpreter, which nobody here wrote, on the programs that we make in its dialect.
#include <gtest/gtest.h>

#include "core/macro/cycle_program.hpp"
#include "core/macro/hole_edge.hpp"
#include "cycle_cases.hpp"
#include "tests/core/macro/plain_moves.hpp"

namespace ridgeline::macro {
namespace {

using Eigen::Vector3d;

/// Rapids before the first feed depend on where the tool stands.
void drop_entry(std::vector<Plain>& moves) {
  while (!moves.empty() && moves.front().is_rapid) moves.erase(moves.begin());
}

constexpr double printed = 1.5e-4;  // four decimals in three axes, rounded

// One tool of each case, passes one way only of the arcs: what changes the text of the program.
TEST(LinuxCnc, TwinsOfCyclesMoveAsComputed) {
  int compared = 0;
  for (const CycleCase& test : cycle_cases()) {
    if (!test.name.ends_with("_bull") || test.name.find("straight_one_way") != test.name.npos)
      continue;
    SCOPED_TRACE(test.name);
    CycleProgram options;
    options.dialect = ProgramDialect::LinuxCnc;
    const std::string text = cycle_program(test.cycle, options);
    const nc::CanonRun run = nc::run_rs274(text);
    ASSERT_EQ(run.exit_code, 0) << text << run.output;
    std::vector<Plain> ours = moves_of(solve(test.cycle).motion), theirs = moves_of(run);
    drop_entry(ours);
    drop_entry(theirs);
    ASSERT_GT(ours.size(), 3U);
    ASSERT_NO_FATAL_FAILURE(expect_same(ours, theirs, printed));
    ++compared;
  }
  EXPECT_GE(compared, 60);
}

TEST(LinuxCnc, TwinOfTheRotationMovesThroughTheTurnedPoints) {
  for (const int axis : {0, 1, 2}) {
    Cycle cycle;
    cycle.family = Family::Rotation;
    cycle.rotation = 25;
    cycle.rotation_axis = axis;
    cycle.points = {{10, -4, 1}, {13, -2, -1}, {16, 0, -2}, {-7, 8, 9}};
    CycleProgram options;
    options.dialect = ProgramDialect::LinuxCnc;
    const nc::CanonRun run = nc::run_rs274(cycle_program(cycle, options));
    ASSERT_EQ(run.exit_code, 0) << run.output;
    expect_same(moves_of(solve(cycle).motion), moves_of(run), printed);
  }
}

TEST(LinuxCnc, TwinOfTheHoleEdgeMovesThroughTheCentres) {
  int compared = 0;
  for (const bool is_outer : {false, true}) {
    for (const bool is_exit : {false, true}) {
      HoleEdge edge;
      edge.R1 = 20;
      edge.R2 = 8;
      edge.f = 3;
      edge.points = 40;
      edge.is_outer = is_outer;
      edge.is_exit = is_exit;
      HoleEdgeProgram options;
      options.kind = HoleEdgeProgram::Kind::Main;
      options.dialect = ProgramDialect::LinuxCnc;
      const std::string text = hole_edge_program(edge, options);
      const nc::CanonRun run = nc::run_rs274(text);
      ASSERT_EQ(run.exit_code, 0) << text << run.output;
      std::vector<Vector3d> centres;
      for (const nc::CanonMove& move : run.moves) {
        if (move.call != "STRAIGHT_FEED" || move.feed != edge.feed) continue;
        centres.push_back(move.to + Vector3d(0, 0, edge.ball_radius));
      }
      ASSERT_EQ(centres.size(), 41U);
      for (std::size_t i = 0; i < centres.size(); ++i, ++compared) {
        EXPECT_NEAR((centres[i] - hole_edge_centre(edge, 9.0 * static_cast<double>(i))).norm(), 0,
                    printed);
      }
    }
  }
  EXPECT_EQ(compared, 164);
}

}  // namespace
}  // namespace ridgeline::macro
