#include "core/nc/cl.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/core/nc/golden.hpp"
#include "tests/core/nc/samples.hpp"

namespace ridgeline::nc {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') cells.emplace_back();
    if (c != ',') cells.back() += c;
  }
  return cells;
}

TEST(Cl, TextIsAsKept) {
  const std::string text = write_cl(hand_made_program(Dialect::Fanuc), 0.05);
  EXPECT_EQ(text, golden("cl_absolute.nc", text));
  Program program = hand_made_program(Dialect::Fanuc);
  program.tool_axis = Vector3d::UnitX();
  program.coolant = Coolant::Flood;
  const std::string multax = write_cl(program, 0.05);
  EXPECT_EQ(multax, golden("cl_tool_along_x.nc", multax));
}

// Every GOTO lies on the rounded path, none leaves out an end, rapids and feeds are told apart.
TEST(Cl, PointsAreTheRoundedPath) {
  RandomPrograms random(5);
  std::size_t points = 0;
  for (int n = 0; n < 30; ++n) {
    SCOPED_TRACE(n);
    const Program program = random.program(Dialect::Fanuc);
    Program chords = program;
    chords.motion = path::linearised(program.motion, 0.01);
    chords.tilted = TiltedOutput::WorkFrame;
    const path::Motion lines = rounded(chords);
    std::size_t at = 0;
    bool rapid = false;
    double feed = 0;
    for (const std::string& line : lines_of(write_cl(program, 0.01))) {
      if (line == "RAPID") rapid = true;
      if (line.starts_with("FEDRAT/")) feed = std::stod(line.substr(7));
      if (!line.starts_with("GOTO/")) continue;
      const std::vector<std::string> cells = cells_of(line.substr(5));
      ASSERT_EQ(cells.size(), program.tool_axis == Vector3d::UnitZ() ? 3U : 6U);
      const Vector3d to(std::stod(cells[0]), std::stod(cells[1]), std::stod(cells[2]));
      const bool is_start = at == 0;
      ASSERT_LE(at, lines.moves.size());
      const Vector3d expected = is_start ? lines.start : lines.moves[at - 1].to;
      EXPECT_LE((to - expected).cwiseAbs().maxCoeff(), 0.51e-6);
      const double expected_feed = is_start ? 0 : lines.moves[at - 1].feed * 60;
      EXPECT_NEAR(rapid ? 0 : feed, expected_feed, 1e-6);
      rapid = false;
      ++at;
      ++points;
    }
    EXPECT_EQ(at, lines.moves.size() + 1);
  }
  EXPECT_GT(points, 2000U);
}

TEST(Csv, ReadsBackAsTheSameMotion) {
  RandomPrograms random(6);
  int rows = 0;
  for (int n = 0; n < 50; ++n) {
    SCOPED_TRACE(n);
    Program program = random.program(Dialect::Fanuc);
    if (plane_axes(program) != Eigen::Matrix3d::Identity()) continue;
    const path::Motion motion = rounded(program);
    const std::vector<std::string> lines = lines_of(write_csv(motion));
    ASSERT_EQ(lines.size(), motion.moves.size() + 2);
    EXPECT_EQ(lines[0], "index,kind,x,y,z,feed,plane,sense,centre_x,centre_y,centre_z");
    for (std::size_t m = 0; m < motion.moves.size(); ++m, ++rows) {
      const path::Move& move = motion.moves[m];
      const std::vector<std::string> cells = cells_of(lines[m + 2]);
      ASSERT_EQ(cells.size(), 11U) << lines[m + 2];
      EXPECT_EQ(cells[0], std::to_string(m + 1));
      EXPECT_EQ(cells[1], name(move.kind));
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(std::stod(cells[2 + std::size_t(axis)]), move.to[axis]);
        if (!move.arc) continue;
        EXPECT_EQ(std::stod(cells[8 + std::size_t(axis)]), move.arc->centre[axis]);
      }
      EXPECT_EQ(std::stod(cells[5]) / 60, move.feed);
      EXPECT_EQ(cells[6].empty(), !move.arc);
      if (move.arc) {
        EXPECT_EQ(cells[7], move.arc->sense == path::ArcSense::Clockwise ? "cw" : "ccw");
      }
    }
  }
  EXPECT_GT(rows, 500);
}

}  // namespace
}  // namespace ridgeline::nc
