#include <algorithm>

#include "core/macro/cycle_motion.hpp"
#include "core/macro/cycle_section.hpp"
#include "core/macro/outline_motion.hpp"
#include "core/macro/program_body.hpp"

namespace ridgeline::macro {

namespace {

bool is_helix(const Cycle& cycle) {
  return cycle.family == Family::HelicalSide || cycle.family == Family::HelicalCornerR;
}
bool is_complex(const Cycle& cycle) {
  return cycle.family == Family::ComplexSide || cycle.family == Family::ComplexCornerR;
}
bool has_slope(const Cycle& cycle) {
  return cycle.family == Family::Taper || cycle.family == Family::ComplexSide ||
         cycle.family == Family::RTaperR;
}
bool has_round(const Cycle& cycle) {
  return cycle.family != Family::Taper && cycle.family != Family::ComplexSide &&
         cycle.family != Family::HelicalSide;
}

void add_edge(const Cycle& cycle, std::vector<Argument>& list) {
  if (is_complex(cycle)) return;
  if (cycle.edge == EdgeShape::Straight && !is_helix(cycle)) {
    list.push_back({'A', 1, cycle.y_pos, "Y POSITION OF THE WALL", false});
    list.push_back({'B', 2, cycle.x_start, "X START"});
    list.push_back({'C', 3, cycle.x_end, "X END"});
    return;
  }
  list.push_back({'X', 24, cycle.centre.x(), "CENTRE X", false});
  list.push_back({'Y', 25, cycle.centre.y(), "CENTRE Y", false});
  list.push_back({'S', 19, cycle.R0, "WALL RADIUS"});
  list.push_back(
      {'T', 20, cycle.side == WallSide::Outside ? 1.0 : -1.0, "SIDE: 1 OUTSIDE, -1 INSIDE"});
  list.push_back({'B', 2, cycle.angle_start, "START ANGLE"});
  if (!is_helix(cycle) && (cycle.edge == EdgeShape::Arc || cycle.method == 1)) {
    list.push_back({'C', 3, cycle.angle_end, "END ANGLE"});
  }
}

void add_section(const Cycle& cycle, std::vector<Argument>& list) {
  list.push_back({'D', 7, cycle.D, "TOOL DIAMETER"});
  list.push_back({'I', 4, cycle.r, "TOOL CORNER RADIUS", false});
  if (has_slope(cycle)) {
    list.push_back({'J', 5, cycle.width, "WIDTH OF THE SLOPE"});
    list.push_back({'K', 6, cycle.angle, "ANGLE OF THE SLOPE FROM HORIZONTAL"});
  }
  if (has_round(cycle)) list.push_back({'R', 18, cycle.R, "RADIUS OF THE ROUND"});
  if (cycle.family == Family::RTaperR) {
    list.push_back({'U', 21, cycle.R2, "RADIUS OF THE LOWER ROUND"});
  }
  if (cycle.family == Family::BottomR || cycle.family == Family::HelicalSide) {
    list.push_back({'U', 21, cycle.depth, "DEPTH"});
  }
  if (cycle.family == Family::HalfConvex) {
    list.push_back({'U', 21, -cycle.z_floor.value_or(-cycle.R), "DEPTH OF THE FLOOR"});
  }
}

void add_steps(const Cycle& cycle, std::vector<Argument>& list) {
  if (cycle.family == Family::HelicalSide) {
    list.push_back({'Q', 17, cycle.turn_pitch, "DEPTH OF A TURN"});
  } else if (cycle.family == Family::HelicalCornerR) {
    list.push_back({'Q', 17, cycle.turn_step, "ANGLE ON THE ROUND OF A TURN"});
    list.push_back({'W', 23, static_cast<double>(helix_segments(cycle)), "SEGMENTS OF A TURN"});
  } else if (cycle.method == 1) {
    const bool is_straight = cycle.edge == EdgeShape::Straight;
    list.push_back({'Q', 17, pass_step(cycle), is_straight ? "X PITCH" : "ANGLE PITCH"});
  } else if (cycle.family == Family::RTaperR) {
    list.push_back({'Q', 17, section_step(cycle), "ANGLE STEP ON THE ROUNDS"});
    list.push_back({'Z', 26, slope_step(cycle), "STEP ALONG THE SLOPE"});
  } else if (has_slope(cycle)) {
    list.push_back({'Q', 17, slope_step(cycle), "STEP ALONG THE SLOPE"});
  } else {
    list.push_back({'Q', 17, section_step(cycle), "ANGLE STEP ON THE ROUND"});
  }
}

void add_motion(const Cycle& cycle, std::vector<Argument>& list) {
  list.push_back({'F', 9, cycle.feed, "FEED"});
  list.push_back({'E', 8, cycle.approach_feed, "APPROACH FEED", false});
  list.push_back({'H', 11, cycle.z_clear, "CLEARANCE ABOVE Z0", false});
  if (is_complex(cycle)) return;
  if (cycle.family != Family::HalfConcave) {
    list.push_back({'V', 22, cycle.y_clear, "WAY FROM THE WALL BEFORE GOING UP", false});
  }
  if (is_helix(cycle) || cycle.method == 1) return;
  if (cycle.edge == EdgeShape::Straight) {
    list.push_back({'W', 23, cycle.overrun, "OVERRUN AT BOTH ENDS", false});
  }
  if (cycle.edge != EdgeShape::Circle) {
    list.push_back({'M', 13, cycle.zigzag ? 1.0 : 0.0, "1 ZIGZAG, 0 ONE WAY", false});
  }
}

}  // namespace

std::vector<Argument> arguments_of(const Cycle& cycle) {
  if (cycle.family == Family::Rotation) {
    return {{'A', 1, cycle.rotation, "ANGLE"}, {'F', 9, cycle.feed, "FEED"}};
  }
  if (cycle.family == Family::Series) {
    return {{'A', 1, cycle.angles.empty() ? 30 : cycle.angles.front(), "ANGLE"},
            {'T', 20, static_cast<double>(cycle.terms), "TERMS", false}};
  }
  std::vector<Argument> list;
  add_edge(cycle, list);
  add_section(cycle, list);
  add_steps(cycle, list);
  add_motion(cycle, list);
  return list;
}

void write_checks(const Cycle& cycle, MacroText& text) {
  if (cycle.family == Family::Rotation) return;
  if (cycle.family == Family::Series) {
    text.alarm_if("#20 LT 1", 1, "AT LEAST ONE TERM");
    return;
  }
  text.alarm_if("#7 LE 0", 1, "TOOL DIAMETER");
  text.alarm_if("[#4 LT 0] OR [#4 GT [#7/2+0.0005]]", 2, "TOOL CORNER RADIUS 0 TO D/2");
  if (has_slope(cycle)) {
    text.alarm_if("#5 LT 0", 3, "WIDTH");
    text.alarm_if("[#6 LE 0] OR [#6 GE 90]", 4, "ANGLE BETWEEN 0 AND 90");
  }
  if (has_round(cycle)) text.alarm_if("#18 LE 0", 5, "RADIUS");
  if (cycle.family == Family::BottomR || cycle.family == Family::HalfConcave) {
    text.alarm_if("#4 GT [#18+0.0005]", 6, "TOOL CORNER RADIUS BEYOND THE ROUND");
  }
  if (cycle.family == Family::HalfConcave) {
    text.alarm_if("#7 GT [2*#18+0.0005]", 6, "TOOL WIDER THAN THE GROOVE");
  }
  if (cycle.family == Family::BottomR) text.alarm_if("#21 LT #18", 7, "DEPTH BELOW THE RADIUS");
  if (cycle.family == Family::RTaperR) text.alarm_if("#21 LE 0", 7, "LOWER RADIUS");
  if (cycle.family == Family::HelicalSide) text.alarm_if("#21 LE 0", 7, "DEPTH");
  text.alarm_if("#17 LE 0", 8, "STEP");
  if (cycle.edge != EdgeShape::Straight || is_helix(cycle)) {
    text.alarm_if("#19 LE 0", 9, "WALL RADIUS");
    text.alarm_if("ABS[#20] NE 1", 10, "SIDE 1 OR -1");
    if (is_helix(cycle)) {
      text.alarm_if("[#20 LT 0] AND [#19 LE #7/2]", 9, "HOLE SMALLER THAN THE TOOL");
    }
  }
  text.alarm_if("#9 LE 0", 11, "FEED");
}

}  // namespace ridgeline::macro
