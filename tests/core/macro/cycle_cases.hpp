#pragma once

#include <string>
#include <vector>

#include "core/macro/cycle.hpp"

namespace ridgeline::macro {

struct CycleCase {
  std::string name;
  Cycle cycle;
};
inline void PrintTo(const CycleCase& test, std::ostream* out) {
  *out << test.name;
}

/// Every family, edge, method and kind of tool of design section 1.3, with steps that divide the
/// range and steps that do not.
inline std::vector<CycleCase> cycle_cases() {
  struct ToolKind {
    const char* name;
    double D, r;
  };
  const ToolKind tools[] = {{"ball", 6, 3}, {"bull", 8, 2}, {"flat", 8, 0}};
  std::vector<CycleCase> cases;
  for (const ToolKind& tool : tools) {
    Cycle base;
    base.D = tool.D;
    base.r = tool.r;
    base.z_clear = 1.5;
    base.feed = 700;
    base.approach_feed = 2500;
    base.x_start = 10;
    base.x_end = -4.5;
    base.y_pos = 2;
    base.centre = {3, -2};
    base.R0 = 25;
    base.pitch = 1;
    base.angle_step = 7;
    base.slope_step = 0.8;
    base.section_step = 13;
    const auto add = [&](const std::string& name, Cycle cycle) {
      cases.push_back({name + "_" + tool.name, cycle});
    };
    const auto edges = [&](const std::string& name, Cycle cycle, bool round) {
      cycle.edge = EdgeShape::Straight;
      cycle.overrun = 5;
      add(name + "_straight", cycle);
      cycle.zigzag = false;
      cycle.y_clear = 0.5;
      add(name + "_straight_one_way", cycle);
      if (!round) return;
      for (const WallSide side : {WallSide::Outside, WallSide::Inside}) {
        Cycle circle = cycle;
        circle.side = side;
        const std::string where = side == WallSide::Outside ? "_outside" : "_inside";
        circle.edge = EdgeShape::Circle;
        circle.counter_clockwise = side == WallSide::Inside;
        add(name + "_circle" + where, circle);
        circle.edge = EdgeShape::Arc;
        circle.angle_start = 20;
        circle.angle_end = 135;
        circle.zigzag = true;
        add(name + "_arc" + where, circle);
        circle.zigzag = false;
        circle.angle_end = -70;
        add(name + "_arc_one_way" + where, circle);
      }
    };
    Cycle taper = base;
    taper.family = Family::Taper;
    taper.width = 4;
    taper.angle = 60;
    edges("taper_2", taper, true);
    taper.method = 1;
    edges("taper_1", taper, true);

    Cycle corner = base;
    corner.family = Family::CornerR;
    corner.R = 4;
    edges("corner_2", corner, true);
    corner.method = 1;
    edges("corner_1", corner, false);

    Cycle bottom = base;
    bottom.family = Family::BottomR;
    bottom.R = 5;
    bottom.depth = 12;
    edges("bottom_2", bottom, true);
    bottom.method = 1;
    edges("bottom_1", bottom, false);
    bottom.R = 3;
    if (tool.r == 3) edges("bottom_1_point", bottom, false);  // r = R: the arc is a point

    for (const Family family : {Family::HalfConvex, Family::HalfConcave}) {
      Cycle half = base;
      half.family = family;
      half.R = 9;
      const std::string name = family == Family::HalfConvex ? "convex" : "concave";
      for (const int method : {1, 2}) {
        half.method = method;
        edges(name + "_" + std::to_string(method), half, false);
      }
      if (family == Family::HalfConvex) {
        half.z_floor = -5;
        edges("convex_floor_2", half, false);
      }
    }
    Cycle both = base;
    both.family = Family::RTaperR;
    both.R = 3;
    both.R2 = 4;
    both.width = 6;
    both.angle = 40;
    edges("r_taper_r_concave", both, true);
    both.lower = LowerRound::Convex;
    edges("r_taper_r_convex", both, true);

    for (const WallSide side : {WallSide::Outside, WallSide::Inside}) {
      Cycle helix = base;
      helix.edge = EdgeShape::Circle;
      helix.side = side;
      helix.counter_clockwise = side == WallSide::Inside;
      helix.angle_start = 30;
      helix.depth = 7;
      helix.turn_pitch = 2;
      helix.family = Family::HelicalSide;
      const std::string where = side == WallSide::Outside ? "_outside" : "_inside";
      add("helical_side" + where, helix);
      helix.turn_pitch = 3.5;  // divides the depth
      add("helical_side_whole" + where, helix);
      helix.family = Family::HelicalCornerR;
      helix.R = 4;
      helix.turn_step = 25;  // does not divide 90
      helix.segments = 40;
      add("helical_corner" + where, helix);
    }
    // A pocket-like outline with a concave arc, and an open one; straight moves and arcs.
    Outline outline;
    outline.start = {0, 0};
    outline.moves = {{{40, 0}, {}, true},
                     {{40, 30}, {}, true},
                     {{20, 50}, Eigen::Vector2d(20, 30), true},
                     {{0, 30}, Eigen::Vector2d(20, 30), true},
                     {{0, 0}, {}, true}};
    outline.tool_left = false;
    for (const Family family : {Family::ComplexSide, Family::ComplexCornerR}) {
      Cycle complex = base;
      complex.family = family;
      complex.width = 2;
      complex.angle = 50;
      complex.R = 2;
      complex.outline = outline;
      const std::string name = family == Family::ComplexSide ? "complex_side" : "complex_corner";
      add(name + "_closed", complex);
      complex.outline->is_top_edge = true;
      add(name + "_top_edge", complex);
      complex.outline = Outline{{0, 0}, {{{30, 0}, {}, true}, {{50, 20}, {}, true}}, true, false};
      add(name + "_open", complex);
    }
  }
  return cases;
}

}  // namespace ridgeline::macro
