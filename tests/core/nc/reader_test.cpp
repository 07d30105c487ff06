#include "core/nc/reader.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "tests/core/nc/samples.hpp"

namespace ridgeline::nc {
namespace {

void expect_same_arc(const path::Arc& read, const path::Arc& written) {
  EXPECT_EQ(read.plane, written.plane);
  EXPECT_EQ(read.sense, written.sense);
  EXPECT_EQ(read.axes, written.axes);
  const auto [i, j, k] = path::axes_of(written.plane);
  EXPECT_EQ(read.centre.dot(read.axes.col(i)), written.centre.dot(written.axes.col(i)));
  EXPECT_EQ(read.centre.dot(read.axes.col(j)), written.centre.dot(written.axes.col(j)));
}

/// Exact, but for the kinds: a program does not say which feed moves are lead-ins.
void expect_same(const path::Motion& read, const path::Motion& written) {
  EXPECT_EQ(read.start, written.start);
  ASSERT_EQ(read.moves.size(), written.moves.size());
  for (std::size_t n = 0; n < read.moves.size(); ++n) {
    SCOPED_TRACE("move " + std::to_string(n));
    const path::Move& a = read.moves[n];
    const path::Move& b = written.moves[n];
    EXPECT_EQ(a.kind, b.feed == 0 ? MoveKind::Rapid : MoveKind::Cut);
    EXPECT_EQ(a.to, b.to) << (a.to - b.to).transpose();
    EXPECT_EQ(a.feed, b.feed);
    ASSERT_EQ(a.arc.has_value(), b.arc.has_value());
    if (a.arc) expect_same_arc(*a.arc, *b.arc);
  }
}

class RoundTrip : public testing::TestWithParam<Dialect> {};

TEST_P(RoundTrip, WhatIsWrittenIsReadExactly) {
  RandomPrograms random(7 + static_cast<unsigned>(GetParam()));
  std::size_t moves = 0, tilted = 0;
  for (int n = 0; n < 300; ++n) {
    SCOPED_TRACE("program " + std::to_string(n));
    Program program = random.program(GetParam());
    if (n % 3 == 0) program.kind = ProgramKind::Subprogram;
    const std::string text = write(program);
    const Reading reading = read(text);
    EXPECT_EQ(reading.dialect, GetParam());
    expect_same(reading.motion, rounded(program));
    ASSERT_FALSE(testing::Test::HasFailure()) << text;
    ASSERT_EQ(reading.lines.size(), reading.motion.moves.size());
    EXPECT_EQ(reading.work_offset, GetParam() == Dialect::Heidenhain ? "1" : "G54");
    if (program.tool_number != 0) {
      EXPECT_EQ(reading.tool_number, program.tool_number);
    }
    if (program.spindle_speed > 0) {
      EXPECT_EQ(reading.spindle_speed, program.spindle_speed);
      EXPECT_EQ(reading.spindle_clockwise, true);
    }
    const Eigen::Matrix3d axes = plane_axes(program);
    if (axes != Eigen::Matrix3d::Identity()) {
      ASSERT_TRUE(reading.tool_axis);
      EXPECT_LT((*reading.tool_axis - program.tool_axis).norm(), 2e-5);
      ++tilted;
    }
    moves += reading.motion.moves.size();
  }
  EXPECT_GT(moves, 4000U);
  if (GetParam() != Dialect::LinuxCnc) {
    EXPECT_GT(tilted, 30U);
  }
}
INSTANTIATE_TEST_SUITE_P(Reader, RoundTrip,
                         testing::Values(Dialect::Fanuc, Dialect::Siemens, Dialect::Heidenhain,
                                         Dialect::LinuxCnc),
                         [](const auto& sample) { return dialect_name(sample.param); });

// A program in other habits: no spaces, leading zeros, modal words, R arcs, lower case, G28.
TEST(Reader, ReadsTheHabitsOfOthers) {
  const Reading reading = read(
      "%\n"
      "O0042 (PART 7)\n"
      "N1G90G80G40G21G17(SAFE)\n"
      "N2 T03 M06\n"
      "G91 G28 Z0\n"
      "G90 G0 G55 X-.5 Y+0.25 S3000 M03\n"
      "G43 Z25. H3 M8\n"
      "G01Z.5F120\n"
      "x1y2\n"
      "G02 X3. Y0. R2. (A QUARTER)\n"
      "G3 X3 Y0 I-1 Z0.75\n"
      "G18 G2 X4 Z.75 I.5 K0\n"
      "G91 G1 Z-.25 ; down\n"
      "G4 P500\n"
      "G90 G00 Z25.\n"
      "M9 M5\n"
      "G28 G91 Z0.\n"
      "M30\n"
      "garbage that no control reads\n");
  const path::Motion& motion = reading.motion;
  EXPECT_EQ(reading.work_offset, "G55");
  EXPECT_EQ(reading.tool_number, 3);
  EXPECT_EQ(reading.length_offset, 3);
  EXPECT_EQ(reading.spindle_speed, 3000);
  EXPECT_EQ(motion.start, Vector3d(-0.5, 0.25, 25));
  ASSERT_EQ(motion.moves.size(), 7U);
  EXPECT_EQ(motion.moves[0].to, Vector3d(-0.5, 0.25, 0.5));
  EXPECT_EQ(motion.moves[0].feed, 2);
  EXPECT_EQ(motion.moves[1].to, Vector3d(1, 2, 0.5));
  EXPECT_EQ(motion.moves[2].to, Vector3d(3, 0, 0.5));
  // Clockwise from (1, 2) to (3, 0), radius 2: about (1, 0).
  EXPECT_LT((motion.moves[2].arc->centre - Vector3d(1, 0, 0.5)).norm(), 1e-12);
  EXPECT_EQ(motion.moves[3].to, Vector3d(3, 0, 0.75));
  EXPECT_NEAR(path::arc_shape(motion.moves[2].to, motion.moves[3]).sweep, 2 * std::numbers::pi,
              1e-12);
  EXPECT_EQ(motion.moves[4].arc->plane, path::ArcPlane::ZX);
  EXPECT_EQ(motion.moves[4].arc->centre, Vector3d(3.5, 0, 0.75));
  EXPECT_EQ(motion.moves[5].to, Vector3d(4, 0, 0.5));
  EXPECT_EQ(motion.moves[6].kind, MoveKind::Rapid);
  EXPECT_EQ(reading.lines, (std::vector{8, 9, 10, 11, 12, 13, 15}));
}

TEST(Reader, ReadsInchesToTheNanometre) {
  const Reading reading = read("G20 G90 G0 X1 Y-.5 Z.1\nG1 X1.0001 F10\nG91 X.0001\nM30\n");
  EXPECT_EQ(reading.motion.start, Vector3d(25.4, -12.7, 2.54));
  EXPECT_EQ(reading.motion.moves[0].to, Vector3d(25.40254, -12.7, 2.54));
  EXPECT_EQ(reading.motion.moves[1].to, Vector3d(25.40508, -12.7, 2.54));
  EXPECT_EQ(reading.motion.moves[0].feed, 254 / 60.0);
}

TEST(Reader, AnIncrementalProgramNeedsAStart) {
  const char* text = "G91 G1 X1 F60\nY2\nM30\n";
  try {
    read(text);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    EXPECT_EQ(error.details().field, "line 1");
    EXPECT_EQ(error.details().value, "X1");
  }
  ReadOptions options;
  options.start = Vector3d(10, 0, 5);
  const Reading reading = read(text, options);
  EXPECT_EQ(reading.motion.start, Vector3d(10, 0, 5));
  ASSERT_EQ(reading.motion.moves.size(), 2U);
  EXPECT_EQ(reading.motion.moves[1].to, Vector3d(11, 2, 5));
}

TEST(Reader, LongArcsByRadiusTurnTheLongWay) {
  const Reading reading = read("G0 X1 Y0 Z0\nG3 X0 Y1 R-1 F60\nG2 X1 Y0 R-1\nG2 X-1 R1\n");
  ASSERT_EQ(reading.motion.moves.size(), 3U);
  EXPECT_LT((reading.motion.moves[0].arc->centre - Vector3d(1, 1, 0)).norm(), 1e-12);
  EXPECT_LT((reading.motion.moves[1].arc->centre - Vector3d(1, 1, 0)).norm(), 1e-12);
  EXPECT_LT((reading.motion.moves[2].arc->centre - Vector3d(0, 0, 0)).norm(), 1e-12);
}

TEST(Reader, ReadsForeignKlartext) {
  const Reading reading = read(
      "0  BEGIN PGM SAMPLE MM\n"
      "1  BLK FORM 0.1 Z X+0 Y+0 Z-20\n"
      "2  BLK FORM 0.2  X+100  Y+100  Z+0\n"
      "* - ROUGHING\n"
      "3  TOOL CALL 3 Z S2000 DL+0 DR+0\n"
      "4  L  X+10  Y+0  R0 FMAX M3\n"
      "5  L  Z+2 FMAX M8\n"
      "6  L  Z-5  F250\n"
      "7  CR X+0 Y+10 R+10 DR+\n"
      "8  CC X+0 Y+0\n"
      "9  C X-10 Y+0 DR+\n"
      "10 CC Y+0 Z+0\n"
      "11 C Y+5 Z+0 DR- F100 ; about X\n"
      "12 L  IX+1 IZ+50 R0 FMAX M30\n"
      "13 END PGM SAMPLE MM\n");
  const path::Motion& motion = reading.motion;
  EXPECT_EQ(reading.tool_number, 3);
  EXPECT_EQ(motion.start, Vector3d(10, 0, 2));
  ASSERT_EQ(motion.moves.size(), 5U);
  EXPECT_LT((motion.moves[1].arc->centre - Vector3d(0, 0, -5)).norm(), 1e-12);
  EXPECT_EQ(motion.moves[2].to, Vector3d(-10, 0, -5));
  EXPECT_EQ(motion.moves[3].arc->plane, path::ArcPlane::YZ);
  EXPECT_EQ(motion.moves[3].to, Vector3d(-10, 5, 0));
  EXPECT_EQ(motion.moves[4].to, Vector3d(-9, 5, 50));
  EXPECT_EQ(motion.moves[4].kind, MoveKind::Rapid);
}

struct BadCase {
  std::string name;
  std::string text;
  int line;
  std::string word;
  ErrorCode code = ErrorCode::BadFile;
};
void PrintTo(const BadCase& sample, std::ostream* out) {
  *out << sample.name;
}

const std::string start = "G90 G0 X0 Y0 Z10\n";  // line 1
const std::string klartext = "0 BEGIN PGM A MM\n1 L X+0 Y+0 Z+5 FMAX\n";
const std::string siemens = "%_N_A_MPF\nG90 G0 X0 Y0 Z10\n";

const std::vector<BadCase> bad_cases = {
    {"Letters", start + "G1 XX5 F100\n", 2, "XX"},
    {"NoNumber", start + "G1 X F100\n", 2, "X F"},
    {"TwoPoints", start + "G1 X1.2.3 F100\n", 2, "."},
    {"TwoSigns", start + "G1 X--1 F100\n", 2, "X-"},
    {"Exponent", start + "G1 X1E3 F100\n", 2, "E3"},
    {"NotANumber", start + "G1 XNAN F100\n", 2, "XN"},
    {"TooLong", start + "G1 X9999999999 F100\n", 2, "X9"},
    {"TooFar", start + "G1 X1000001 F100\n", 2, "X1000001"},
    {"StrayCharacter", start + "G1 X1 $ F100\n", 2, "$"},
    {"Utf8", start + "G1 X1 \xC3\xA4\n", 2, "\xC3"},
    {"OpenComment", start + "G1 X1 (no end\nF100\n", 2, "(no end"},
    {"TwoX", start + "G1 X1 X2 F100\n", 2, "X2"},
    {"UnknownG", start + "G77.7 X1\n", 2, "G77.7", ErrorCode::Unsupported},
    {"UnknownGCode", start + "G123\n", 2, "G123"},
    {"GOfHundredths", start + "G1.05 X1 F1\n", 2, "G1.05"},
    {"NegativeG", start + "G-1\n", 2, "G-1"},
    {"UnknownM", start + "M777\n", 2, "M777"},
    {"MWithPoint", start + "M3.5\n", 2, "M3.5"},
    {"RotaryAxis", start + "G1 X1 A90 F100\n", 2, "A90"},
    {"FeedMissing", start + "G1 X1\n", 2, "G1 X1"},
    {"FeedZero", start + "G1 X1 F0\n", 2, "G1 X1 F0"},
    {"NoMotionCode", "X1 Y1\n", 1, "X1 Y1"},
    {"ArcWithoutCentre", start + "G2 X1 Y1 F100\n", 2, "G2 X1 Y1 F100"},
    {"ArcCentreOfOtherPlane", start + "G17 G2 X1 I.5 K1 F100\n", 2, "K1"},
    {"ArcRadii", start + "G2 X1 Y1 I5 J0 F100\n", 2, "G2 X1 Y1 I5 J0 F100"},
    {"ArcRadiusAndCentre", start + "G2 X1 R1 I.5 F100\n", 2, "G2 X1 R1 I.5 F100"},
    {"ArcTooFar", start + "G2 X9 R1 F100\n", 2, "G2 X9 R1 F100"},
    {"ArcRadiusClosed", start + "G2 X0 Y0 R1 F100\n", 2, "G2 X0 Y0 R1 F100"},
    {"ArcTurns", start + "G2 X1 I.5 P3 F100\n", 2, "P3"},
    {"ArcOnCentre", start + "G2 X5 I0 F100\n", 2, "G2 X5 I0 F100"},
    {"ArcFromUnknown", "G90 G0 X0\nG2 X1 I.5 F100\n", 2, "G2 X1 I.5 F100"},
    {"RadiusCompensation", start + "G41 D1 X1\n", 2, "G41", ErrorCode::Unsupported},
    {"Cycle", start + "G81 X1 Z-5 R2 F100\n", 2, "G81", ErrorCode::Unsupported},
    {"MacroCall", start + "G65 P9100 A1\n", 2, "G65", ErrorCode::Unsupported},
    {"Subprogram", start + "M98 P100\n", 2, "M98", ErrorCode::Unsupported},
    {"Variable", start + "#1=5\n", 2, "#"},
    {"VariableInWord", start + "G1 X#1 F100\n", 2, "X#"},
    {"Expression", start + "G1 X[1+2] F100\n", 2, "X["},
    {"OptionalBlock", start + "/G1 X1 F100\n", 2, "/"},
    {"Rotation", start + "G68 X0 Y0 R30\n", 2, "G68", ErrorCode::Unsupported},
    {"OffsetSet", start + "G92 X0\n", 2, "G92", ErrorCode::Unsupported},
    {"FeedPerTurn", start + "G95\n", 2, "G95", ErrorCode::Unsupported},
    {"SecondOffset", start + "G54 G1 X1 F60\nG55\nG0 X1\nG1 X2\n", 5, "G1 X2",
     ErrorCode::Unsupported},
    {"SecondTool", start + "G1 X1 F60\nT2 M6\nG1 X2\n", 4, "G1 X2", ErrorCode::Unsupported},
    {"SecondPlane", start + "G1 X1 F60\nG68.2 X0 Y0 Z0 I9 J9 K9\nG0 X1 Y2 Z3\nG1 X2\n", 5, "G1 X2",
     ErrorCode::Unsupported},
    {"SecondProgram", start + "G1 X1 F60\nO0002\n", 3, "O0002", ErrorCode::Unsupported},
    {"FlowControl", start + "o100 while\n", 2, "o100 while", ErrorCode::Unsupported},
    {"CuttingAfterReference", start + "G1 X1 F60\nG91 G28 Z0\nG90 G1 X5\n", 4, "G90 G1 X5",
     ErrorCode::Unsupported},
    {"RotaryAxisOnTheWayIn", start + "G0 A90\n", 2, "A90"},
    {"ToolWithoutT", "M6\n", 1, "M6"},
    {"OffsetNumber", "G54.1 P0\n", 1, "P0"},
    {"OffsetWithoutNumber", "G54.1\n", 1, "G54.1"},
    {"TiltWithoutAngles", "G68.2 X0 Y0 Z0 I1 J2\n", 1, "G68.2"},
    {"StrayP", start + "P5\n", 2, "P5"},
    {"SplineOfLinuxCnc", start + "G5.1 X1 Y1 I1 J1\n", 2, "G5.1"},
    {"SiemensCall", siemens + "L100\n", 3, "L100"},
    {"SiemensName", siemens + "WHILE R1\n", 3, "WHILE"},
    {"SiemensSwivelMode", siemens + "CYCLE800(1,\"\",0,27,0,0,0,1,2,3)\n", 3,
     "CYCLE800(1,\"\",0,27,0,0,0,1,2,3)", ErrorCode::Unsupported},
    {"SiemensBracket", siemens + "CYCLE800(1\n", 3, "(1"},
    {"SiemensIncrement", siemens + "G1 X=IC(5) F100\n", 3, "X=I"},
    {"KlartextWord", klartext + "2 LX X+5\n", 3, "LX X+5"},
    {"KlartextNumber", klartext + "2 L X+ F100\n", 3, "X+"},
    {"KlartextFeed", klartext + "2 L X+5\n", 3, "L X+5"},
    {"KlartextNoCentre", klartext + "2 C X+5 Y+0 DR+ F100\n", 3, "C X+5 Y+0 DR+ F100"},
    {"KlartextNoSense", klartext + "2 CC X+1 Y+0\n3 C X+2 Y+0 F100\n", 4, "C X+2 Y+0 F100"},
    {"KlartextCompensation", klartext + "2 L X+5 RL F100\n", 3, "RL", ErrorCode::Unsupported},
    {"KlartextLabel", klartext + "2 LBL 1\n", 3, "LBL 1", ErrorCode::Unsupported},
    {"KlartextParameter", klartext + "2 Q1 = 5\n", 3, "Q1 = 5", ErrorCode::Unsupported},
    {"KlartextCycle", klartext + "2 CYCL DEF 7.0 DATUM SHIFT\n", 3, "CYCL DEF 7.0 DATUM SHIFT",
     ErrorCode::Unsupported},
    {"KlartextUnit", "0 BEGIN PGM A CM\n", 1, "BEGIN PGM A CM"},
    {"KlartextFlatPlane", klartext + "2 PLANE VECTOR BX+1 BY+0 BZ+0 NX+1 NY+0 NZ+0 STAY\n", 3,
     "PLANE VECTOR BX+1 BY+0 BZ+0 NX+1 NY+0 NZ+0 STAY"},
    {"KlartextTurns", klartext + "2 CC X+1 Y+0\n3 CP IPA+720 IZ-1 DR+ F100\n", 4,
     "CP IPA+720 IZ-1 DR+ F100", ErrorCode::Unsupported},
    {"KlartextSigns", klartext + "2 CC X+1 Y+0\n3 CP IPA+72 IZ-1 DR- F100\n", 4,
     "CP IPA+72 IZ-1 DR- F100"},
};

class ReaderRefuses : public testing::TestWithParam<BadCase> {};

TEST_P(ReaderRefuses, WithLineAndWord) {
  try {
    read(GetParam().text);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), GetParam().code) << error.what();
    EXPECT_EQ(error.details().field, "line " + std::to_string(GetParam().line)) << error.what();
    EXPECT_EQ(error.details().value, GetParam().word) << error.what();
  }
}
INSTANTIATE_TEST_SUITE_P(Reader, ReaderRefuses, testing::ValuesIn(bad_cases),
                         [](const auto& sample) { return sample.param.name; });

// Whatever the text: an answer or an Error, nothing else.
TEST(Reader, SurvivesMutilatedPrograms) {
  RandomPrograms random(8);
  int read_well = 0, refused = 0;
  for (int n = 0; n < 2000; ++n) {
    std::string text = write(random.program(static_cast<Dialect>(n % 4)));
    for (int m = random.pick(1, 3); m > 0; --m) {
      const auto at = static_cast<std::size_t>(random.pick(0, static_cast<int>(text.size()) - 1));
      const int choice = random.pick(0, 2);
      if (choice == 0) text[at] = static_cast<char>(random.pick(1, 255));
      if (choice == 1) text.erase(at, static_cast<std::size_t>(random.pick(1, 9)));
      if (choice == 2) text.insert(at, text.substr(0, at / 2));
    }
    try {
      read(text);
      ++read_well;
    } catch (const Error& error) {
      const bool expected =
          error.code() == ErrorCode::BadFile || error.code() == ErrorCode::Unsupported;
      EXPECT_TRUE(expected) << error.what();
      EXPECT_FALSE(error.details().field.empty()) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(read_well, 100);
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace ridgeline::nc
