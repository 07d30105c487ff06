#include "tests/core/macro/snippet.hpp"

#include <cmath>

#include "core/macro/text.hpp"

namespace ridgeline::macro {

void expect_as_said(const Snippet& snippet) {
  Options options;
  options.profile = profile(snippet.control).value();
  options.profile.offset_memory = snippet.offset_memory;
  const Result result = run(snippet.text, options);
  ASSERT_EQ(result.alarm ? result.alarm->number : 0, snippet.alarm)
      << (result.alarm ? result.alarm->message : "");
  if (result.alarm) {
    EXPECT_EQ(result.alarm->line, snippet.line) << result.alarm->message;
  }
  for (const auto& [number, value] : snippet.variables) {
    SCOPED_TRACE(number);
    ASSERT_TRUE(result.variables.contains(number));
    EXPECT_FALSE(result.variables.at(number).vacant);
    EXPECT_NEAR(result.variables.at(number).number, value, 1e-12);
  }
}

std::vector<std::string> moves_text(const Result& result) {
  const auto written = [](const Eigen::Vector3d& p) {
    std::string text;
    for (const double coordinate : p) {
      text += " " + number_text(std::round(coordinate * 1e6) / 1e6);
    }
    return text;
  };
  std::vector<std::string> texts;
  for (const Move& move : result.motion) {
    std::string& text = texts.emplace_back();
    switch (move.kind) {
      case MoveKind::Rapid: text = "G0"; break;
      case MoveKind::Line: text = "G1"; break;
      case MoveKind::Dwell: text = "G4 " + number_text(result.dwells[move.detail]); continue;
      case MoveKind::Arc: {
        const bool is_left = arc_of(result, move).sense == path::ArcSense::CounterClockwise;
        text = is_left ? "G3" : "G2";
        break;
      }
    }
    text += written(machine_of(result, move));
    if (move.kind == MoveKind::Arc) {
      const Eigen::Vector3d shift = result.shifts[move.shift].shift;
      text += " centre" + written(arc_of(result, move).centre + shift);
    }
  }
  return texts;
}

}  // namespace ridgeline::macro
