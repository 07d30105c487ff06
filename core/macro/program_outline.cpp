#include <algorithm>
#include <cmath>
#include <string>

#include "core/macro/cycle_section.hpp"
#include "core/macro/outline_motion.hpp"
#include "core/macro/program_body.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

namespace {

using Eigen::Vector2d;

double greatest_offset(const Cycle& cycle) {
  const CycleResult solved = solve(cycle);
  double most = 0;
  for (const OffsetPass& pass : solved.offsets) most = std::max(most, std::abs(pass.offset));
  return most;
}

std::string point_words(const Vector2d& p) {
  return "X" + macro_number(p.x()) + " Y" + macro_number(p.y());
}

}  // namespace

// Every pass writes its compensation value into the D register and calls the contour.
void write_complex(const Cycle& cycle, MacroText& text, int contour) {
  const OutlinePath path = outline_path(cycle, greatest_offset(cycle));
  const bool is_slope = cycle.family == Family::ComplexSide;
  const std::string offset_register = numbered("#", 13000 + cycle.offset_number);
  text.assign(27, "#7/2", "TOOL RADIUS");
  text.assign(28, "#27-#4", "CORE RADIUS");
  text.assign(10, is_slope ? "#5/COS[#6]" : "90", "LAST STATION");
  text.assign(31, "FUP[#10/#17-0.000001]");
  text.if_then("#31 LT 0", 31, "0");
  text.assign(30, "0");
  text.begin_while("#30 LE #31");
  text.assign(32, "#30*#17");
  text.if_then("#30 EQ #31", 32, "#10");
  text.assign(14, is_slope ? "#5-#32*COS[#6]-#4*SIN[#6]-#28" : "#18-#28-[#18+#4]*SIN[#32]");
  text.assign(15, is_slope ? "#4*[COS[#6]-1]-#32*SIN[#6]" : "[#18+#4]*[COS[#32]-1]");
  const bool is_top = cycle.outline->is_top_edge;
  text.line("G90 G00 " + point_words(path.lead_in));
  text.line("G00 Z#11");
  text.line("G53(STOPS THE LOOK-AHEAD)");
  text.line(offset_register + "=" + (is_top ? (is_slope ? "#5-#14" : "#18-#14") : "-#14"));
  text.line("G01 Z#15 F#8");
  text.line(numbered("M98 P", contour));
  text.line("G01 Z#11 F#8");
  text.assign(30, "#30+1");
  text.end_while();
}

void write_contour(const Cycle& cycle, MacroText& text) {
  const OutlinePath path = outline_path(cycle, greatest_offset(cycle));
  const std::string side = cycle.outline->tool_left ? "G41" : "G42";
  text.line("G01 " + side + numbered(" D", cycle.offset_number) + " " + point_words(path.start) +
            " F#9");
  Vector2d from = path.start;
  for (const OutlineMove& move : path.moves) {
    if (move.centre) {
      const Vector2d way = *move.centre - from;
      text.line(std::string(move.counter_clockwise ? "G03 " : "G02 ") + point_words(move.to) +
                " I" + macro_number(way.x()) + " J" + macro_number(way.y()));
    } else {
      text.line("G01 " + point_words(move.to));
    }
    from = move.to;
  }
  text.line("G01 G40 " + point_words(path.lead_out));
}

}  // namespace ridgeline::macro
