// The surface that the motion of a cycle leaves, by brute force: distances of points of the ideal
// surface to the tool in all its positions. Knows the tool and the profiles, nothing of the solver.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <vector>

#include "tests/core/macro/cycle_section.hpp"
#include "tests/core/macro/swept_space.hpp"

namespace ridgeline::macro {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double pi = 3.14159265358979323846;
constexpr double touch = 1.1e-4;  // [mm] nearer than this is cut

struct Case {
  std::string name;
  Cycle cycle;
  double gouge = 1.3e-4;   ///< the most that may be cut too deep [mm]
  double relative = 0.02;  ///< of the cusp's formula
  double extra = 1.3e-4;   ///< [mm]
};
void PrintTo(const Case& test, std::ostream* out) {
  *out << test.name;
}

std::vector<Case> cases() {
  std::vector<Case> all;
  struct ToolKind {
    const char* name;
    double D, r;
  };
  for (const ToolKind& tool :
       {ToolKind{"ball", 6, 3}, ToolKind{"bull", 8, 2}, ToolKind{"flat", 8, 0}}) {
    Cycle base;
    base.D = tool.D;
    base.r = tool.r;
    base.x_start = 6;
    base.x_end = -6;
    base.overrun = 5;
    base.y_pos = 2;
    base.centre = {3, -2};
    base.R0 = 25;
    base.pitch = 0.7;
    base.angle_step = 2;
    base.slope_step = 0.4;
    base.section_step = 6;
    const auto add = [&](const std::string& name, const Cycle& cycle, double relative = 0.02) {
      Case test{name + "_" + tool.name, cycle};
      test.relative = relative;
      all.push_back(test);
    };
    const auto edges = [&](const std::string& name, Cycle cycle) {
      add(name + "_straight", cycle);
      if (tool.r != 2) return;  // the edge changes nothing that the kind of tool does
      for (const WallSide side : {WallSide::Outside, WallSide::Inside}) {
        cycle.edge = EdgeShape::Circle;
        cycle.side = side;
        cycle.counter_clockwise = side == WallSide::Inside;
        add(name + (side == WallSide::Outside ? "_outside" : "_inside"), cycle,
            cycle.method == 1 ? 0.12 : 0.02);
      }
    };
    Cycle taper = base;
    taper.width = 4;
    taper.angle = 55;
    edges("taper_2", taper);
    taper.method = 1;
    edges("taper_1", taper);
    Cycle corner = base;
    corner.family = Family::CornerR;
    corner.R = 4;
    edges("corner_2", corner);
    corner.method = 1;
    add("corner_1", corner);
    Cycle bottom = base;
    bottom.family = Family::BottomR;
    bottom.R = 5;
    bottom.depth = 9;
    edges("bottom_2", bottom);
    bottom.method = 1;
    add("bottom_1", bottom);
    for (const Family family : {Family::HalfConvex, Family::HalfConcave}) {
      Cycle half = base;
      half.family = family;
      half.R = 9;
      const std::string name = family == Family::HalfConvex ? "convex" : "concave";
      half.method = 2;
      add(name + "_2", half);
      half.method = 1;
      add(name + "_1", half);
    }
    Cycle both = base;
    both.family = Family::RTaperR;
    both.R = 3;
    both.R2 = 4;
    both.width = 6;
    both.angle = 40;
    edges("r_taper_r_concave", both);
    both.lower = LowerRound::Convex;
    edges("r_taper_r_convex", both);
    Cycle complex = base;
    complex.family = Family::ComplexCornerR;
    complex.R = 2;
    complex.width = 2;
    complex.angle = 50;
    complex.y_pos = 0;
    complex.outline = Outline{{-30, 0}, {{{30, 0}, {}, true}, {{50, 20}, {}, true}}, false, false};
    add("complex_corner", complex);
    complex.family = Family::ComplexSide;
    add("complex_side", complex);
    for (const WallSide side : {WallSide::Outside, WallSide::Inside}) {
      Cycle helix = base;
      helix.edge = EdgeShape::Circle;
      helix.side = side;
      helix.depth = 6;
      helix.turn_pitch = 2.3;
      helix.counter_clockwise = side == WallSide::Inside;
      helix.family = Family::HelicalSide;
      const std::string where = side == WallSide::Outside ? "_outside" : "_inside";
      add("helical_side" + where, helix);
      helix.family = Family::HelicalCornerR;
      helix.R = 4;
      helix.turn_step = 6;
      helix.chord_tolerance = 0.002;
      Case test{"helical_corner" + where + "_" + tool.name, helix};
      test.gouge = 0.0022;  // chords of the spiral
      test.extra = 0.0022;
      all.push_back(test);
    }
  }
  return all;
}

/// Where the section of the case is looked at: places along the edge.
std::vector<double> places_of(const Cycle& cycle) {
  const bool is_round = cycle.edge != EdgeShape::Straight;
  if (cycle.method == 2) return {is_round ? 137.0 : 0.37};
  const double step = is_round ? *cycle.angle_step : *cycle.pitch;
  const double start = is_round ? 120 : cycle.x_start;
  std::vector<double> places;
  const double sign = is_round ? 1 : -1;
  for (const double part : {0.0, 0.25, 0.5}) places.push_back(start + sign * step * (6 + part));
  return places;
}

struct Placed {
  Vector3d point, normal;
};
Placed placed(const Cycle& cycle, double along, const Surface& s) {
  const bool is_complex =
      cycle.family == Family::ComplexSide || cycle.family == Family::ComplexCornerR;
  if (cycle.edge == EdgeShape::Straight) {
    const double y = is_complex ? 0 : cycle.y_pos;
    return {{along, y + s.point.x(), s.point.y()}, {0, s.normal.x(), s.normal.y()}};
  }
  const double inward = cycle.side == WallSide::Outside ? -1 : 1;  // y grows with the radius inside
  const double rho = cycle.R0 + inward * s.point.x(), f = along * pi / 180;
  const Vector3d e(std::cos(f), std::sin(f), 0), centre(cycle.centre.x(), cycle.centre.y(), 0);
  return {centre + rho * e + Vector3d(0, 0, s.point.y()),
          inward * s.normal.x() * e + Vector3d(0, 0, s.normal.y())};
}

bool is_in_reach(const Cycle& cycle, const Surface& s) {
  const double a = cycle.D / 2 - cycle.r;
  if (cycle.family == Family::HalfConcave && a > 0) {
    return std::abs(s.point.x()) >= cycle.R * a / (cycle.R - cycle.r) + 1e-6;
  }
  return true;
}

class Sweep : public testing::TestWithParam<Case> {};

TEST_P(Sweep, TouchesTheSurfaceCutsNothingBelowAndLeavesTheCusp) {
  const Cycle& cycle = GetParam().cycle;
  const CycleResult solved = solve(cycle);
  const std::vector<Segment> segments = segments_of(solved.motion);
  const double limit = solved.cusp * (1 + GetParam().relative) + GetParam().extra;
  double deepest = 1e9, highest = 0;
  int worked = 0;
  for (const double along : places_of(cycle)) {
    // What is far from the section cannot matter.
    std::vector<Segment> near;
    const Vector3d middle = placed(cycle, along, {{0, 0}, {0, 1}}).point;
    for (const Segment& segment : segments) {
      const Vector3d way = segment.to - segment.from;
      const double length2 = way.head<2>().squaredNorm();
      const double part =
          length2 > 0
              ? std::clamp((middle - segment.from).head<2>().dot(way.head<2>()) / length2, 0.0, 1.0)
              : 0;
      const double distance = (middle - segment.from - part * way).head<2>().norm();
      if (distance < cycle.D + 14) near.push_back(segment);
    }
    ASSERT_FALSE(near.empty());
    const std::vector<Surface> surface = ideal(cycle);
    const std::size_t stride = cycle.method == 1 ? 6 : 1;  // method 1 is the same all along
    for (std::size_t k = 0; k < surface.size(); k += stride) {
      const Surface& s = surface[k];
      const Placed p = placed(cycle, along, s);
      const double high_limit = 2 * limit + 1e-4;
      const std::vector<Segment> last = within(cycle, near, p.point, high_limit + 1e-6);
      const double distance = last.empty() ? high_limit : swept_distance(cycle, last, p.point);
      deepest = std::min(deepest, distance);
      if (!s.is_worked || !is_in_reach(cycle, s)) continue;
      ++worked;
      // Height of what is left above the point, along its normal.
      double low = 0, high = high_limit;
      if (distance <= touch) continue;
      ASSERT_LE(swept_distance(cycle, last, p.point + high * p.normal), touch)
          << "not cut at " << s.point.transpose() << " along " << along << ", cusp " << solved.cusp;
      for (int i = 0; i < 14; ++i) {
        const double half = (low + high) / 2;
        (swept_distance(cycle, last, p.point + half * p.normal) > touch ? low : high) = half;
      }
      highest = std::max(highest, high);
    }
  }
  EXPECT_GT(worked, 30);
  EXPECT_GE(deepest, -GetParam().gouge);
  EXPECT_LE(highest, limit);
  // The formula is of the worst step of a whole round; a flat tool's is at 45 degrees.
  const bool is_bound = cycle.r == 0 && cycle.family == Family::RTaperR;
  if (!is_bound) {
    EXPECT_GE(highest, solved.cusp * (1 - 2 * GetParam().relative) - GetParam().extra);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, Sweep, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace ridgeline::macro
