#include <gtest/gtest.h>

#include <optional>
#include <ostream>
#include <string>

#include "core/nc/reader.hpp"

namespace ridgeline::nc {
namespace {

/// How programs of shops end after the cut; `line` is the first rapid of the way out that stands in
/// another frame than the cut, counted from 1 in `end`.
struct WayOut {
  const char* name;
  Dialect dialect;
  std::string end;
  std::optional<int> line = std::nullopt;
};
void PrintTo(const WayOut& way, std::ostream* out) {
  *out << way.name;
}

struct Cut {
  std::string text;
  int lines;
};

Cut cut(Dialect dialect) {
  switch (dialect) {
    case Dialect::Siemens:
      return {
          "%_N_RL1_MPF\nG17 G40 G90 G94 G710\nG54\nT1\nM6\nD1\n"
          "CYCLE800(1,\"\",0,57,0,0,0,20,10,0,0,0,0,-1,0,1)\nG0 X0 Y0\nZ10\nG1 Z-1 F100\nX5\n",
          11};
    case Dialect::Heidenhain:
      return {
          "0 BEGIN PGM 1 MM\n1 TOOL CALL 1 Z S5000\n"
          "2 PLANE VECTOR BX+1 BY+0 BZ+0 NX+0 NY+0.6 NZ+0.8 TURN FMAX\n3 L X+0 Y+0 R0 FMAX\n"
          "4 L Z+10 FMAX\n5 L Z-1 F100\n6 L X+5\n",
          7};
    default:
      return {
          "%\nO0001\nG17 G21 G90 G94\nG54\nT1 M6\nG68.2 X0. Y0. Z0. I10. J20. K0.\nG53.1\n"
          "G0 X0. Y0.\nG43 Z10. H1\nG1 Z-1. F100.\nX5.\n",
          11};
  }
}

class WaysOut : public testing::TestWithParam<WayOut> {};

// What was cut is read as it stands; what is not in its frame is no part of the motion, and said.
TEST_P(WaysOut, LeaveTheCutAsItIs) {
  const auto& [name, dialect, end, line] = GetParam();
  const auto [text, lines] = cut(dialect);
  const Reading alone = read(text, {.dialect = dialect, .start = {}});
  const Reading whole = read(text + end, {.dialect = dialect, .start = {}});
  ASSERT_EQ(alone.motion.moves.size(), 2U);
  ASSERT_EQ(whole.motion.moves.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(whole.motion.moves[i].to, alone.motion.moves[i].to);
  }
  EXPECT_EQ(*whole.tool_axis, *alone.tool_axis);
  EXPECT_EQ(whole.work_offset, alone.work_offset);
  EXPECT_EQ(whole.tool_number, alone.tool_number);
  EXPECT_FALSE(alone.unmeasured_line);
  ASSERT_EQ(whole.unmeasured_line.has_value(), line.has_value());
  if (line) {
    EXPECT_EQ(*whole.unmeasured_line, lines + *line);
  }
}

using enum Dialect;
INSTANTIATE_TEST_SUITE_P(
    Reader, WaysOut,
    testing::Values(
        WayOut{"Home", Fanuc, "G69\nG91 G28 Z0.\nG28 X0. Y0.\nG90\nM30\n%\n"},
        WayOut{"SecondHome", Fanuc, "G69\nG91 G30 P2 Z0.\nM30\n"},
        WayOut{"MachinePosition", Fanuc, "G69\nG90 G53 G0 Z0.\nG53 X-400. Y0.\nM30\n"},
        WayOut{"LengthOffFirst", Fanuc, "G49\nG69\nG53 Z0. M5\nM30\n"},
        WayOut{"PlainHeight", Fanuc, "G69\nG0 Z300.\nM30\n", 2},
        WayOut{"PlainPoint", Fanuc, "G69\nG90 G0 X0. Y0. Z300.\nM30\n", 2},
        WayOut{"HeightWithoutLength", Fanuc, "G49\nG0 Z300.\nM30\n", 2},
        WayOut{"OtherOffset", Fanuc, "G69\nG55\nG0 X0. Y0.\nM30\n", 3},
        WayOut{"NextTool", Fanuc, "G69\nG91 G28 Z0.\nT2 M6\nM30\n"},
        WayOut{"RotaryAxes", Fanuc, "G69\nG91 G28 Z0.\nG90 G0 B0. C0.\nM30\n"},
        WayOut{"RotaryMachineAxes", Fanuc, "G69\nG90 G53 G0 Z0.\nG53 A0 C0\nM30\n"},
        WayOut{"Subprogram", Fanuc, "G69\nG91 G28 Z0.\nG90\nM99\n"},
        WayOut{"Supa", Siemens, "CYCLE800()\nSUPA G0 Z500 D0\nM30\n"},
        WayOut{"G153", Siemens, "TRAFOOF\nCYCLE800()\nG153 G0 Z500 D0\nM30\n"},
        WayOut{"ZeroPlane", Siemens,
               "CYCLE800(0,\"\",0,57,0,0,0,0,0,0,0,0,0,0,0,0)\nG0 Z400\nM30\n", 2},
        WayOut{"FixedPoint", Siemens, "CYCLE800()\nG75 Z1=0\nM30\n"},
        WayOut{"ReferencePoint", Siemens, "CYCLE800()\nG74 X1=0 Z1=0\nM30\n"},
        WayOut{"FramesOff", Siemens, "ROT\nTRANS\nG0 Z400\nM30\n", 3},
        WayOut{"M91", Heidenhain, "7 PLANE RESET STAY\n8 L Z-1 R0 FMAX M91\n9 M30\n"},
        WayOut{"M92", Heidenhain, "7 L Z-5 R0 FMAX M92\n8 PLANE RESET STAY\n9 M30\n"},
        WayOut{"PlainL", Heidenhain, "7 PLANE RESET TURN FMAX\n8 L Z+300 R0 FMAX\n9 M30\n", 2},
        WayOut{"M140", Heidenhain,
               "7 L M140 MB MAX\n8 PLANE RESET STAY\n9 L B+0 C+0 FMAX\n10 M30\n"},
        WayOut{"M140Height", Heidenhain, "7 L M140 MB50 FMAX\n8 M30\n"},
        WayOut{"OtherDatum", Heidenhain,
               "7 CYCL DEF 247 DATUM SETTING ~\n Q339=+2 ;DATUM\n8 L Z+300 FMAX\n9 M30\n", 3}),
    [](const auto& sample) { return sample.param.name; });

}  // namespace
}  // namespace ridgeline::nc
