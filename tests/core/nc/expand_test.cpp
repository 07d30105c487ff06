#include "core/nc/expand.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/nc/reader.hpp"
#include "tests/core/nc/rs274.hpp"
#include "tests/core/nc/samples.hpp"

namespace ridgeline::nc {
namespace {

std::string marked(const Call& call) {
  return "(" + std::to_string(call.macro) + ")\n";
}

std::string expanded(const std::string& text) {
  return expand(text, default_binding(), marked);
}

TEST(Expand, ReplacesTheCallAndNoOtherByte) {
  struct Case {
    std::string text, expected;
  };
  const std::vector<Case> cases = {
      {"G65 P9100 W1 H1 T12 Q0.35 E1\n", "(9100)\n"},
      {"N120 G65 P9100 W1 (EDGE 1)\r\nM30\r\n%", "N120 (9100) (EDGE 1)\r\nM30\r\n%"},
      {"g065p9100w1.", "(9100)"},
      {"  G 65  P 9100\tW 1 ; later\n", "  (9100) ; later\n"},
      {"G65 (INNER) P9100 W1\n", "(INNER) (9100)\n"},
      {"G65 P9100 W1 L3\n", "(9100)\n(9100)\n(9100)\n"},
      {"G65 P9101 W1\n", "G65 P9101 W1\n"},
      {"(G65 P9100 W1)\n", "(G65 P9100 W1)\n"},
      {"X1 ; G65 P9100 W1\n", "X1 ; G65 P9100 W1\n"},
      {"G66 P9101 A1\nM98 P9100\nG65 P#1\n", "G66 P9101 A1\nM98 P9100\nG65 P#1\n"},
      {"#1=[2+SIN[30]]\r\nIF[#1EQ5]GOTO9100\r\n\xFF\x80\n",
       "#1=[2+SIN[30]]\r\nIF[#1EQ5]GOTO9100\r\n\xFF\x80\n"},
      {"G165 P9100\nG6.5 P9100\nG65.1 P9100\n", "G165 P9100\nG6.5 P9100\nG65.1 P9100\n"},
      {"", ""},
      {"\n\n", "\n\n"},
  };
  for (const Case& sample : cases) EXPECT_EQ(expanded(sample.text), sample.expected);
}

TEST(Expand, TellsWhatTheCallSays) {
  std::vector<Call> calls;
  expand("%\nG90 G21\nG65 P9100 W2. T-3 Q.35 (x) E1\n%\n", default_binding(),
         [&](const Call& call) {
           calls.push_back(call);
           return std::string();
         });
  ASSERT_EQ(calls.size(), 1U);
  const Call& call = calls[0];
  EXPECT_EQ(call.macro, 9100);
  EXPECT_EQ(call.line, 3);
  EXPECT_EQ(call.text, "G65 P9100 W2. T-3 Q.35 (x) E1");
  EXPECT_EQ(call.modes.positioning, "G90");
  EXPECT_EQ(call.modes.motion, "");
  ASSERT_EQ(call.arguments.size(), 4U);
  EXPECT_EQ(call.arguments[0].letter, 'W');
  EXPECT_EQ(call.arguments[0].meaning, "workpiece");
  EXPECT_EQ(call.arguments[0].value, 2);
  EXPECT_TRUE(call.arguments[0].has_point);
  EXPECT_EQ(call.arguments[1].value, -3);
  EXPECT_FALSE(call.arguments[1].has_point);
  EXPECT_EQ(call.arguments[2].value, 0.35);
  EXPECT_EQ(call.arguments[2].text, "Q.35");
}

TEST(Expand, SetsBackTheModesThatTheMotionChanged) {
  const auto motion = [](const Call&) {
    return std::string("G17 G21 G90\nG0 X0\nG1 X1 F60.\nG91\nG18 G2 X1 I1\nG90\nG1 Z1\n");
  };
  const auto run = [&](const std::string& text) { return expand(text, default_binding(), motion); };
  const std::string body = motion({});
  EXPECT_EQ(run("G91 G17 G0 F500.\nG65 P9100\nX1\n"),
            "G91 G17 G0 F500.\n" + body + "G91 G17 G0 F500.\nX1\n");
  EXPECT_EQ(run("G20 G90 G1 G18\nG65 P9100\n"), "G20 G90 G1 G18\n" + body + "G20\n");
  EXPECT_EQ(run("G65 P9100\n"), body);
  // The second call stands in the modes that the first one left.
  EXPECT_EQ(run("G91\nG65 P9100\nG65 P9100\n"), "G91\n" + body + "G91\n" + body + "G91\n");
}

// The whole chain: what is expanded moves as the path does, then goes on in the old modes.
TEST(Expand, ExpandedProgramsMoveAsAsked) {
  RandomPrograms random(9);
  std::size_t moves = 0;
  for (int n = 0; n < 50; ++n) {
    SCOPED_TRACE(n);
    Program program = random.program(Dialect::Fanuc);
    program.kind = ProgramKind::Inline;
    program.tool_axis = Vector3d::UnitZ();
    program.tilted = TiltedOutput::WorkFrame;
    const bool flat = plane_axes(program) == Eigen::Matrix3d::Identity();
    for (path::Move& move : program.motion.moves) {
      if (!flat || (move.arc && move.arc->axes != Eigen::Matrix3d::Identity())) move.arc.reset();
      if (move.feed == 0 && move.kind != MoveKind::Rapid && move.kind != MoveKind::Retract) {
        move.feed = 5;
      }
    }
    const std::string text = expand(
        "%\nO1\nG21 G90 G17 G54\nT12 M6\nS900 M3\nG0 X0. Y0.\nG43 Z80. H12\nG91 G1 F77.\n"
        "N5 G65 P9100 W1\nX1.\nM30\n%\n",
        default_binding(), [&](const Call&) { return write(program); });
    const path::Motion expected = rounded(program);
    const Reading reading = read(text);
    const std::vector<path::Move>& read_moves = reading.motion.moves;
    ASSERT_GE(read_moves.size(), expected.moves.size() + 1);
    // From the end: the main program's step in its own modes, before it the path.
    const path::Move& last = read_moves.back();
    EXPECT_EQ(last.feed, 77 / 60.0);
    EXPECT_NEAR(last.to.x(), expected.moves.back().to.x() + 1, 1e-9);
    for (std::size_t m = 0; m < expected.moves.size(); ++m, ++moves) {
      const path::Move& move = read_moves[read_moves.size() - 1 - expected.moves.size() + m];
      EXPECT_EQ(move.to, expected.moves[m].to);
      EXPECT_EQ(move.feed, expected.moves[m].feed);
    }
  }
  EXPECT_GT(moves, 500U);
}

TEST(Expand, LinuxCncRunsAnExpandedProgram) {
  Program program = hand_made_program(Dialect::LinuxCnc);
  program.kind = ProgramKind::Inline;
  const std::string text = expand("%\nG21 G90 G17 G54\nG91 G0 X1\nG65 P9100 W1\nX1\nM2\n%\n",
                                  default_binding(), [&](const Call&) { return write(program); });
  const CanonRun run = run_rs274(text);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  ASSERT_EQ(run.moves.size(), rounded(program).moves.size() + 4);
  EXPECT_EQ(run.moves.back().to, Eigen::Vector3d(1, 0, 60));
}

struct ExpandBadCase {
  std::string name, text;
  int line;
  std::string word;
  ErrorCode code = ErrorCode::BadFile;
};
void PrintTo(const ExpandBadCase& sample, std::ostream* out) {
  *out << sample.name;
}

const std::vector<ExpandBadCase> expand_bad_cases = {
    {"UnknownLetter", "M3\nG65 P9100 W1 Q1\nG65 P9100 $ \nG65 P9100 X1 Y1 Z1 N5\n", 4, "N5"},
    {"Variable", "G65 P9100 W#1\n", 1, "W#1"},
    {"Expression", "G65 P9100 Q[1+2]\n", 1, "Q[1+2]"},
    {"Twice", "G65 P9100 I1 I2\n", 1, "I2"},
    {"WordBefore", "X5 G65 P9100\n", 1, "X5"},
    {"Condition", "IF[#1EQ1]THEN G65 P9100\n", 1, "I"},
    {"OtherG", "G65 P9100 W1 G90\n", 1, "G90"},
    {"Optional", "/G65 P9100\n", 1, "G65", ErrorCode::Unsupported},
    {"Modal", "G66 P9100 W1\n", 1, "G66", ErrorCode::Unsupported},
    {"Repeats", "G65 P9100 L101\n", 1, "L101", ErrorCode::Unsupported},
    {"NoRepeat", "G65 P9100 L0\n", 1, "L0"},
    {"HalfRepeat", "G65 P9100 L1.5\n", 1, "L1.5"},
};

class ExpandRefuses : public testing::TestWithParam<ExpandBadCase> {};

TEST_P(ExpandRefuses, WithLineAndWord) {
  try {
    expanded(GetParam().text);
    FAIL() << "was expanded";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), GetParam().code) << error.what();
    EXPECT_EQ(error.details().field, "line " + std::to_string(GetParam().line)) << error.what();
    EXPECT_EQ(error.details().value.substr(0, GetParam().word.size()), GetParam().word);
  }
}
INSTANTIATE_TEST_SUITE_P(Expand, ExpandRefuses, testing::ValuesIn(expand_bad_cases),
                         [](const auto& sample) { return sample.param.name; });

TEST(Expand, ErrorsOfTheMotionPassThrough) {
  const auto refuse = [](const Call&) -> std::string {
    throw Error(ErrorCode::UnknownTool, "no tool 99");
  };
  EXPECT_THROW(expand("G65 P9100\n", default_binding(), refuse), Error);
}

TEST(Expand, RefusesABadBinding) {
  EXPECT_THROW(expand("", {{9100, {{'G', "x"}}}}, marked), Error);
  EXPECT_THROW(expand("", {{9100, {{'A', "x"}, {'A', "y"}}}}, marked), Error);
  EXPECT_THROW(expand("", {{0, {}}}, marked), Error);
}

}  // namespace
}  // namespace ridgeline::nc
