// Corners with ,C and ,R, corners of compensated arcs, lines of DPRNT, and what alarms say.
#include <gtest/gtest.h>

#include <cmath>

#include "core/macro/text.hpp"
#include "tests/core/macro/snippet.hpp"

namespace ridgeline::macro {
namespace {

std::vector<std::string> moves_of_program(const std::string& blocks) {
  const Result result = run("O1\nF100.\n" + blocks + "\nM30");
  EXPECT_FALSE(result.alarm) << result.alarm->message;
  return moves_text(result);
}

int alarm_of(const std::string& blocks) {
  const Result result = run("O1\nF100.\n" + blocks + "\nM30");
  return result.alarm ? result.alarm->number : 0;
}

using Moves = std::vector<std::string>;

// Chamfer 2 off the corner (10, 0); fillet 3 about (7, 3).
TEST(CornerBreak, ChamferAndFilletStandBetweenTheirMoves) {
  EXPECT_EQ(moves_of_program("G1X10.,C2.\nY10."), (Moves{"G1 8 0 0", "G1 10 2 0", "G1 10 10 0"}));
  EXPECT_EQ(moves_of_program("G1X10.,R3.\nY10."),
            (Moves{"G1 7 0 0", "G3 10 3 0 centre 7 3 0", "G1 10 10 0"}));
  EXPECT_EQ(moves_of_program("G1X10.,R3.\nY-10."),
            (Moves{"G1 7 0 0", "G2 10 -3 0 centre 7 -3 0", "G1 10 -10 0"}));
}

TEST(CornerBreak, TwoInARowShortenTheMoveAtBothEnds) {
  EXPECT_EQ(moves_of_program("G1X10.,C2.\nY10.,C1.\nX0"),
            (Moves{"G1 8 0 0", "G1 10 2 0", "G1 10 9 0", "G1 9 10 0", "G1 0 10 0"}));
}

TEST(CornerBreak, StraightOnThereIsNoCorner) {
  EXPECT_EQ(moves_of_program("G1X10.,R3.\nX20."), (Moves{"G1 10 0 0", "G1 20 0 0"}));
}

// A function between the two blocks waits until the corner is done.
TEST(CornerBreak, FunctionsComeAfterTheCorner) {
  const Result result = run("O1\nG1X10.,C2.F100.\nM8\nY10.\nM30");
  ASSERT_FALSE(result.alarm) << result.alarm->message;
  ASSERT_FALSE(result.events.empty());
  EXPECT_EQ(result.events[0].word, "M8");
  EXPECT_EQ(result.events[0].before, 2U);
}

TEST(CornerBreak, WhatHasNoCornerAlarms) {
  EXPECT_EQ(alarm_of("G1X10.,C11.\nY20."), 55);           // longer than the first move
  EXPECT_EQ(alarm_of("G1X10.,R6.\nY5."), 55);             // and than the second
  EXPECT_EQ(alarm_of("G1X10.,C2.\nZ5."), 55);             // no move in the plane
  EXPECT_EQ(alarm_of("G1X10.,C2.\nG3X20.Y10.R10."), 55);  // an arc after it
  EXPECT_EQ(alarm_of("G1X10.,Q2.\nY5."), 4);
}

// Two bumps of radius 10 about (0, 0) and (16, 0) meet in a valley at (8, 6). Half a millimetre
// above them the circles of radius 10.5 cross at y^2 = 10.5^2 - 8^2.
TEST(CompensatedArcs, MeetWhereTheirOffsetCirclesCross) {
  const Result result =
      run("O1\n#13001=.5\nG0X-10.Y-20.\nG1G41D1Y0F100.\nG2X8.Y6.R10.\nX26.Y0R10.\nG1G40Y-20.\nM30");
  ASSERT_FALSE(result.alarm) << result.alarm->message;
  ASSERT_GE(result.motion.size(), 4U);
  EXPECT_NEAR(result.motion[2].to.x(), 8, 1e-9);
  EXPECT_NEAR(result.motion[2].to.y(), std::sqrt(10.5 * 10.5 - 64), 1e-9);
}

TEST(Dprnt, WritesSignsBlanksAndDigits) {
  const Result result =
      run("O1\n#2=128.47398\n#5=-91.2\n#30=123.456\nPOPEN\nDPRNT[X#2[53]*Y#5[53]*T#30[30]]\n"
          "DPRNT[*DONE*]\n#1=3\nDPRNT[#[#1-1][31]]\nPCLOS\nM30");
  ASSERT_FALSE(result.alarm) << result.alarm->message;
  // A sign or a blank, the digits before the point filled with blanks, rounded after it.
  EXPECT_EQ(result.prints, (Moves{"X   128.474 Y-   91.200 T 123", " DONE ", " 128.5"}));
}

TEST(Dprnt, RefusesWhatItCannotRead) {
  EXPECT_EQ(alarm_of("DPRNT X"), 125);
  EXPECT_EQ(alarm_of("DPRNT[X#1]"), 125);
  EXPECT_EQ(alarm_of("DPRNT[X#1[53]"), 125);
  EXPECT_EQ(alarm_of("DPRNT[X#1[53"), 125);
  EXPECT_EQ(alarm_of("DPRNT[X#9999[53]]"), 115);
}

// 2^32 + 100 is no variable, though its last 32 bits are 100.
TEST(Dprnt, HasNoVariableBeyondTheNumbers) {
  EXPECT_EQ(alarm_of("#100=1\n#1=4294967396\nDPRNT[#[#1][31]]"), 115);
}

TEST(AlarmText, SaysWhatIsWrong) {
  EXPECT_EQ(run("O1\nG1X10.\nM30").alarm->message, "feed zero");
  EXPECT_EQ(run("O1\nG2X10.Y1.I3.F9.\nM30").alarm->message.substr(0, 28),
            "arc radius out of tolerance:");
  EXPECT_EQ(run("O1\nG2X10.R3.F9.\nM30").alarm->message,
            "arc radius out of tolerance: R 3 mm, the ends are 10 mm apart");
  EXPECT_EQ(run("O1\nG1X9999999.F9.\nM30").alarm->message, "too many digits: X");
  EXPECT_EQ(run("O1\n#1=1E\nM30").alarm->number, 127);
  for (const AlarmNumber number :
       {AlarmNumber::IllegalAddress, AlarmNumber::ArcAxisNotInPlane, AlarmNumber::IntegerOverflow,
        AlarmNumber::PlaneMismatch, AlarmNumber::TimeLimit, AlarmNumber::MemoryLimit,
        AlarmNumber::NotAtReference, AlarmNumber::NoSolutionAtCorner}) {
    EXPECT_NE(text(number), "alarm");
  }
}

}  // namespace
}  // namespace ridgeline::macro
