// The program of a cycle, run by the interpreter, moves as the computed motion does.
#include <gtest/gtest.h>

#include <cmath>

#include "core/macro/cycle_program.hpp"
#include "core/macro/interpreter.hpp"
#include "cycle_cases.hpp"

namespace ridgeline::macro {
namespace {

using Eigen::Vector3d;

struct PlainMove {
  Move move;
  Vector3d centre;
  bool clockwise = false;
  int turns = 0;
};

/// Moves that go somewhere.
std::vector<PlainMove> real_moves(const Result& result, Vector3d at) {
  std::vector<PlainMove> moves;
  for (const Move& move : result.motion) {
    PlainMove plain{move, Vector3d::Zero()};
    if (move.kind == MoveKind::Arc) {
      plain.centre = arc_of(result, move).centre;
      plain.clockwise = arc_of(result, move).sense == path::ArcSense::Clockwise;
      plain.turns = arc_of(result, move).turns;
    }
    if (move.kind == MoveKind::Arc || (move.to - at).norm() > 1e-6) moves.push_back(plain);
    at = move.to;
  }
  return moves;
}

void expect_same(const Result& program, const Result& motion, double z_clear, double tolerance) {
  const Vector3d start(0, 0, z_clear);
  const auto a = real_moves(program, start), b = real_moves(motion, start);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "move " << i << " line " << a[i].move.line);
    ASSERT_EQ(a[i].move.kind, b[i].move.kind);
    ASSERT_NEAR((a[i].move.to - b[i].move.to).norm(), 0, tolerance);
    ASSERT_NEAR(a[i].move.feed, b[i].move.feed, 1e-9);
    if (a[i].move.kind != MoveKind::Arc) continue;
    ASSERT_EQ(a[i].clockwise, b[i].clockwise);
    ASSERT_EQ(a[i].turns, b[i].turns);
    ASSERT_NEAR((a[i].centre - b[i].centre).norm(), 0, 2 * tolerance);
  }
}

class CycleProgramTest : public testing::TestWithParam<CycleCase> {};

// Coordinates of a program are rounded to 0.001 mm in each axis.
constexpr double rounding = 0.0015;

TEST_P(CycleProgramTest, MainProgramMovesAsComputed) {
  const Cycle& cycle = GetParam().cycle;
  CycleProgram options;
  options.work_offset = "";
  Options run_options;
  run_options.set[5223] = -cycle.z_clear;  // the tool stands at the clearance height
  const std::string text = cycle_program(cycle, options);
  const Result result = run(text, run_options);
  ASSERT_FALSE(result.alarm) << result.alarm->number << " " << result.alarm->message << " line "
                             << result.alarm->line << "\n"
                             << text;
  expect_same(result, solve(cycle).motion, cycle.z_clear, rounding);
}

// The call in the head of the macro, run as it stands there.
TEST_P(CycleProgramTest, MacroWithItsOwnCallMovesAsComputed) {
  const Cycle& cycle = GetParam().cycle;
  CycleProgram options;
  options.kind = CycleProgram::Kind::Macro;
  options.number = 9801;
  const std::string text = cycle_program(cycle, options);
  const std::size_t call = text.find("(CALL: ");
  ASSERT_NE(call, std::string::npos);
  const std::string main =
      "O1\nG90 G17\n" + text.substr(call + 7, text.find(')', call) - call - 7) + "\nM30\n";
  Options run_options;
  run_options.set[5223] = -cycle.z_clear;
  run_options.library = [&](int number) -> std::optional<std::string> {
    return number == 9801 ? std::optional(text) : std::nullopt;
  };
  const Result result = run(main, run_options);
  ASSERT_FALSE(result.alarm) << result.alarm->number << " " << result.alarm->message << " line "
                             << result.alarm->line << "\n"
                             << main << text;
  expect_same(result, solve(cycle).motion, cycle.z_clear, rounding);
}

INSTANTIATE_TEST_SUITE_P(Cases, CycleProgramTest, testing::ValuesIn(cycle_cases()),
                         [](const auto& test) { return test.param.name; });

TEST(CycleProgram, RangeChecksAlarm) {
  Cycle cycle;
  cycle.family = Family::BottomR;
  cycle.D = 8;
  cycle.r = 2;
  cycle.R = 5;
  cycle.depth = 12;
  cycle.x_end = -10;
  CycleProgram options;
  options.kind = CycleProgram::Kind::Macro;
  options.number = 9801;
  const std::string text = cycle_program(cycle, options);
  const auto alarm = [&](const std::string& arguments) {
    Options run_options;
    run_options.library = [&](int) { return std::optional(text); };
    const Result result = run("G65 P9801 " + arguments + "\nM30\n", run_options);
    return result.alarm ? result.alarm->number : 0;
  };
  const std::string good = " B0. C-10. D8. I2. R5. U12. Q10. F500. ";
  EXPECT_EQ(alarm(good), 0);
  EXPECT_EQ(alarm(good + "D-1."), 3001);
  EXPECT_EQ(alarm(" B0. C-10. D8. I5. R5. U12. Q10. F500."), 3002);
  EXPECT_EQ(alarm(good + "R1."), 3006);
  EXPECT_EQ(alarm(good + "U3."), 3007);
  EXPECT_EQ(alarm(good + "Q0."), 3008);
  EXPECT_EQ(alarm(" B0. C-10. D8. I2. R5. U12. Q10."), 3011);  // no feed
  EXPECT_EQ(alarm(" B0. C-10."), 3001);                        // no tool
}

// Error <= next term: on +-180 degrees, reduced to +-90, 10 terms reach 1e-14.
TEST(CycleProgram, SeriesProgramComputesTheFunctions) {
  for (const double angle : {0.0, 30.0, 90.0, -135.0, 179.0, 400.0}) {
    SCOPED_TRACE(angle);
    Cycle cycle;
    cycle.family = Family::Series;
    cycle.angles = {angle};
    const Result result = run(cycle_program(cycle));
    ASSERT_FALSE(result.alarm) << result.alarm->message;
    const double x = angle * M_PI / 180;
    EXPECT_NEAR(result.variables.at(101).number, std::sin(x), 1e-11);
    EXPECT_NEAR(result.variables.at(102).number, std::cos(x), 1e-11);
    EXPECT_EQ(result.variables.at(103).vacant, angle == 90);
    const SeriesValue value = solve(cycle).series.front();
    EXPECT_NEAR(value.sine, std::sin(x), 1e-14);
    EXPECT_NEAR(value.cosine, std::cos(x), 1e-14);
  }
}

TEST(CycleProgram, RotationProgramMovesThroughTheTurnedPoints) {
  for (const int axis : {0, 1, 2}) {
    SCOPED_TRACE(axis);
    Cycle cycle;
    cycle.family = Family::Rotation;
    cycle.rotation = 25;
    cycle.rotation_axis = axis;
    cycle.points = {{10, -4, 1}, {13, -2, -1}, {16, 0, -2}};
    const Result result = run(cycle_program(cycle));
    ASSERT_FALSE(result.alarm) << result.alarm->message;
    const Result motion = solve(cycle).motion;
    ASSERT_EQ(result.motion.size(), motion.motion.size());
    for (std::size_t i = 0; i < motion.motion.size(); ++i) {
      EXPECT_NEAR((result.motion[i].to - motion.motion[i].to).norm(), 0, 0.0009);
    }
  }
}

}  // namespace
}  // namespace ridgeline::macro
