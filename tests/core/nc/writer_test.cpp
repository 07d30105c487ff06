#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/base/error.hpp"
#include "core/nc/program.hpp"
#include "tests/core/nc/golden.hpp"
#include "tests/core/nc/samples.hpp"

namespace ridgeline::nc {
namespace {

struct GoldenCase {
  std::string name;
  Program program;
};
void PrintTo(const GoldenCase& sample, std::ostream* out) {
  *out << sample.name;
}

std::vector<GoldenCase> golden_cases() {
  std::vector<GoldenCase> cases;
  for (const Dialect dialect :
       {Dialect::Fanuc, Dialect::LinuxCnc, Dialect::Siemens, Dialect::Heidenhain}) {
    Program program = hand_made_program(dialect);
    cases.push_back({dialect_name(dialect) + "_absolute", program});
    program.positioning = Positioning::Incremental;
    program.kind = ProgramKind::Subprogram;
    program.decimals = 3;
    program.block_number_step = 5;
    program.coolant = Coolant::Flood;
    cases.push_back({dialect_name(dialect) + "_incremental_subprogram", program});

    program = hand_made_program(dialect);
    program.tool_axis = Vector3d::UnitX();
    const auto turned = [](const Vector3d& p) { return Vector3d(p.z(), p.x(), p.y()); };
    program.motion.start = turned(program.motion.start);
    for (path::Move& move : program.motion.moves) {
      move.to = turned(move.to);
      if (move.arc) move.arc = path::Arc{turned(move.arc->centre), path::ArcPlane::YZ};
    }
    cases.push_back({dialect_name(dialect) + "_tool_along_x", program});

    program = hand_made_program(dialect);
    program.tool_axis = Vector3d(std::sqrt(0.5), 0, std::sqrt(0.5));
    if (dialect == Dialect::LinuxCnc) program.tilted = TiltedOutput::WorkFrame;
    const Eigen::Matrix3d axes = plane_axes(program);
    program.motion.start = axes * program.motion.start;
    for (path::Move& move : program.motion.moves) {
      move.to = axes * move.to;
      if (move.arc) move.arc->centre = axes * move.arc->centre;
      if (move.arc) move.arc->axes = axes;
    }
    cases.push_back({dialect_name(dialect) + "_tilted", program});
  }
  return cases;
}

class Golden : public testing::TestWithParam<GoldenCase> {};

TEST_P(Golden, TextIsAsKept) {
  const std::string text = write(GetParam().program);
  EXPECT_EQ(text, golden(GetParam().name + ".nc", text));
}
INSTANTIATE_TEST_SUITE_P(Writer, Golden, testing::ValuesIn(golden_cases()),
                         [](const auto& sample) { return sample.param.name; });

// Document 000 has no program; the words are the ones of the controls' manuals.
TEST(Writer, FanucNumbersHaveAPointAndNoMinusZero) {
  Program program = hand_made_program(Dialect::Fanuc);
  program.motion.start = {-1e-7, 100, -0.5};
  const std::string text = write(program);
  EXPECT_NE(text.find("G0 X0. Y100.\n"), std::string::npos) << text;
  EXPECT_NE(text.find("G43 Z-0.5 H12\n"), std::string::npos) << text;
}

TEST(Writer, IncrementsAddUpExactlyInDecimalArithmetic) {
  RandomPrograms random(1);
  int moved = 0;
  for (int n = 0; n < 200; ++n) {
    SCOPED_TRACE(n);
    Program program = random.program(Dialect::Fanuc);
    program.positioning = Positioning::Incremental;
    program.tool_axis = Vector3d::UnitZ();
    for (path::Move& move : program.motion.moves) move.arc.reset();
    for (path::Move& move : program.motion.moves) {
      if (move.kind != MoveKind::Rapid && move.kind != MoveKind::Retract) move.feed = 5;
    }
    const std::string text = write(program);
    // Sum of the digits after G91, as whole units, axis by axis.
    long long sum[3] = {0, 0, 0};
    std::istringstream lines(
        text.substr(text.find("G91\n"), text.find("G90\n") - text.find("G91\n")));
    for (std::string word; lines >> word; ++moved) {
      if (word[0] < 'X' || word[0] > 'Z') continue;
      std::string digits = word.substr(1);
      const std::size_t point = digits.find('.');
      ASSERT_NE(point, std::string::npos) << word;
      digits.erase(point, 1);
      const std::size_t fraction = digits.size() - point;
      ASSERT_LE(fraction, std::size_t(program.decimals)) << word;
      digits.append(std::size_t(program.decimals) - fraction, '0');
      sum[word[0] - 'X'] += std::stoll(digits);
    }
    // Closed motions: start and end are the same point.
    EXPECT_EQ(sum[0], 0);
    EXPECT_EQ(sum[1], 0);
    EXPECT_EQ(sum[2], 0);
  }
  EXPECT_GT(moved, 2000);
}

TEST(Writer, RoundedStaysWithinHalfAUnitAndAgreesForBothPositionings) {
  RandomPrograms random(2);
  std::size_t compared = 0;
  for (int n = 0; n < 300; ++n) {
    SCOPED_TRACE(n);
    Program program = random.program(n % 2 == 0 ? Dialect::Fanuc : Dialect::Siemens);
    program.positioning = Positioning::Absolute;
    const path::Motion absolute = rounded(program);
    program.positioning = Positioning::Incremental;
    const path::Motion incremental = rounded(program);
    ASSERT_EQ(absolute.moves.size(), incremental.moves.size());
    ASSERT_LE(absolute.moves.size(), program.motion.moves.size());
    EXPECT_EQ(absolute.start, incremental.start);
    for (std::size_t m = 0; m < absolute.moves.size(); ++m, ++compared) {
      EXPECT_EQ(absolute.moves[m].to, incremental.moves[m].to);
    }
    const double half = 0.5 * std::pow(10, -program.decimals) * std::sqrt(3) + 1e-12;
    EXPECT_LE((absolute.start - program.motion.start).norm(), half);
    EXPECT_LE((absolute.moves.back().to - program.motion.start).norm(), half);
    // Every rounded end is the rounding of one of the moves, in order.
    std::size_t m = 0;
    for (const path::Move& move : program.motion.moves) {
      if (m < absolute.moves.size() && (absolute.moves[m].to - move.to).norm() <= 2 * half) ++m;
    }
    EXPECT_EQ(m, absolute.moves.size());
  }
  EXPECT_GT(compared, 3000U);
}

// What a control checks: the radii at both ends of an arc.
TEST(Writer, RoundedArcsKeepTheirRadiiAndTheirTurn) {
  RandomPrograms random(3);
  int arcs = 0, loose = 0;
  for (int n = 0; n < 500; ++n) {
    SCOPED_TRACE(n);
    const Program program = random.program(n % 2 == 0 ? Dialect::Fanuc : Dialect::LinuxCnc);
    const path::Motion motion = rounded(program);
    Vector3d from = motion.start;
    for (const path::Move& move : motion.moves) {
      if (move.arc) {
        const path::ArcShape arc = path::arc_shape(from, move);
        const double difference = std::abs(arc.start_radius - arc.end_radius);
        EXPECT_LE(difference, 0.005);
        if (difference > 0.001) ++loose;
        ++arcs;
      }
      from = move.to;
    }
  }
  EXPECT_GT(arcs, 2000);
  EXPECT_LT(loose, arcs / 20);
}

double length_of(const path::Motion& motion) {
  double sum = 0;
  Vector3d from = motion.start;
  for (const path::Move& move : motion.moves) {
    sum += path::length(from, move);
    from = move.to;
  }
  return sum;
}

// A flipped or lost arc would be millimetres long.
TEST(Writer, RoundingDoesNotChangeTheWay) {
  RandomPrograms random(4);
  int programs = 0;
  for (int n = 0; n < 800; ++n) {
    SCOPED_TRACE(n);
    const Program program = random.program(static_cast<Dialect>(n % 4));
    if (program.decimals < 3) continue;
    ++programs;
    const double moves = static_cast<double>(program.motion.moves.size());
    EXPECT_NEAR(length_of(rounded(program)), length_of(program.motion), 0.01 * moves);
  }
  EXPECT_GT(programs, 400);
}

TEST(Writer, NearlyClosedArcsDoNotTurnIntoTheirOpposite) {
  for (const double gap : {1e-5, -1e-5, 4e-5, -4e-5, 2e-4, -2e-4}) {
    SCOPED_TRACE(gap);
    Program program = hand_made_program(Dialect::Fanuc);
    const double angle = gap / 5;
    const Vector3d almost(5 * std::cos(angle), 5 * std::sin(angle), 0);
    program.motion.start = {5, 0, 0};
    const path::Arc arc{{0, 0, 0}, path::ArcPlane::XY, path::ArcSense::CounterClockwise};
    program.motion.moves = {{MoveKind::Cut, almost, 5, arc}};
    const path::Motion motion = rounded(program);
    const double length = motion.moves.empty() ? 0 : path::length(motion.start, motion.moves[0]);
    EXPECT_NEAR(length, gap > 0 ? gap : 10 * std::numbers::pi + gap, 2e-4);
  }
}

struct RefusedCase {
  std::string name;
  void (*spoil)(Program&);
  ErrorCode code;
  std::string says;
};
void PrintTo(const RefusedCase& sample, std::ostream* out) {
  *out << sample.name;
}

const double nan_value = std::numeric_limits<double>::quiet_NaN();

const std::vector<RefusedCase> refused_cases = {
    {"DecimalsZero", [](Program& p) { p.decimals = 0; }, ErrorCode::BadInput, "decimals 0"},
    {"DecimalsSeven", [](Program& p) { p.decimals = 7; }, ErrorCode::BadInput, "1 to 6"},
    {"NumberZero", [](Program& p) { p.number = 0; }, ErrorCode::BadInput, "program 0"},
    {"NegativeTool", [](Program& p) { p.tool_number = -1; }, ErrorCode::BadInput, "tool/number -1"},
    {"BlockStepZero", [](Program& p) { p.block_number_step = 0; }, ErrorCode::BadInput, "step 0"},
    {"SpindleNotANumber", [](Program& p) { p.spindle_speed = nan_value; }, ErrorCode::BadInput,
     "spindle_speed nan"},
    {"UnknownOffset", [](Program& p) { p.work_offset = "G53"; }, ErrorCode::BadInput, "G53"},
    {"OffsetWithMoreBehind", [](Program& p) { p.work_offset = "G54 M30"; }, ErrorCode::BadInput,
     "G54 M30"},
    {"AxisNotUnit",
     [](Program& p) {
       p.tool_axis = {0, 0, 2};
     },
     ErrorCode::BadInput, "tool_axis"},
    {"AxisNotANumber", [](Program& p) { p.tool_axis.x() = nan_value; }, ErrorCode::BadInput,
     "tool_axis"},
    {"StartNotFinite", [](Program& p) { p.motion.start.y() = nan_value; }, ErrorCode::BadInput,
     "start"},
    {"TooFar", [](Program& p) { p.motion.moves[2].to.x() = 1e5; }, ErrorCode::BadInput, "move 2"},
    {"NoFeed", [](Program& p) { p.motion.moves[3].feed = 0; }, ErrorCode::BadInput, "move 3: feed"},
    {"NegativeFeed", [](Program& p) { p.motion.moves[1].feed = -1; }, ErrorCode::BadInput,
     "move 1: feed"},
    {"FeedNotANumber", [](Program& p) { p.motion.moves[3].feed = nan_value; }, ErrorCode::BadInput,
     "move 3: feed"},
    {"ArcOffItsCentre", [](Program& p) { p.motion.moves[2].arc->centre.x() += 0.1; },
     ErrorCode::BadInput, "move 2: the ends"},
    {"RapidArc", [](Program& p) { p.motion.moves[2].kind = MoveKind::Rapid; }, ErrorCode::BadInput,
     "cannot be a rapid"},
    {"TiltedLinuxCnc",
     [](Program& p) {
       p.dialect = Dialect::LinuxCnc;
       p.tool_axis = Vector3d(0, 0.6, 0.8);
     },
     ErrorCode::Unsupported, "no tilted work plane"},
    {"ArcAcrossTheTiltedPlane", [](Program& p) { p.tool_axis = Vector3d(0, 0.6, 0.8); },
     ErrorCode::BadInput, "plane of the arc"},
    {"KlartextHelixAcross",
     [](Program& p) {
       p.dialect = Dialect::Heidenhain;
       p.tool_axis = Vector3d::UnitX();
     },
     ErrorCode::Unsupported, "HEIDENHAIN"},
};

class WriterRefuses : public testing::TestWithParam<RefusedCase> {};

TEST_P(WriterRefuses, WithCodeAndReason) {
  Program program = hand_made_program(Dialect::Fanuc);
  GetParam().spoil(program);
  try {
    write(program);
    FAIL() << "was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), GetParam().code) << error.what();
    EXPECT_NE(std::string(error.what()).find(GetParam().says), std::string::npos) << error.what();
  }
}
INSTANTIATE_TEST_SUITE_P(Writer, WriterRefuses, testing::ValuesIn(refused_cases),
                         [](const auto& sample) { return sample.param.name; });

TEST(Writer, CommentsCannotBreakOutOfThemselves) {
  for (const Dialect dialect :
       {Dialect::Fanuc, Dialect::LinuxCnc, Dialect::Siemens, Dialect::Heidenhain}) {
    SCOPED_TRACE(dialect_name(dialect));
    Program program = hand_made_program(dialect);
    program.comments.clear();
    const std::size_t plain = static_cast<std::size_t>(std::ranges::count(write(program), '\n'));
    program.comments = {
        "a) G0 X99\nG0 X98 %\r~", "MSG, boo", "probeopen file", "\xFF\xC3", "", "   "};
    const std::string text = write(program);
    EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(text, '\n')), plain + 4) << text;
    const bool acts_on_comments = dialect == Dialect::LinuxCnc;
    if (acts_on_comments) {
      EXPECT_EQ(text.find("(MSG"), std::string::npos);
      EXPECT_EQ(text.find("(probeopen"), std::string::npos);
    }
    EXPECT_EQ(text.find('\r'), std::string::npos);
    for (const char c : text) EXPECT_TRUE(c == '\n' || (c >= 32 && c < 127));
  }
}

}  // namespace
}  // namespace ridgeline::nc
