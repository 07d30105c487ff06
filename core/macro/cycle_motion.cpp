#include "core/macro/cycle_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/angle.hpp"
#include "core/macro/cycle_section.hpp"
#include "core/macro/motion_builder.hpp"
#include "core/macro/outline_motion.hpp"

namespace ridgeline::macro {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double no_move = 1e-9;  // [mm]
constexpr double smallest_circle =
    0.0005;  // [mm] half an increment: below, there is none to program

/// Moves in section coordinates at a place along the edge.
class SectionMover {
public:
  SectionMover(const Cycle& cycle, Result& result) : cycle_(cycle), builder_(result) {}

  void rapid(double along, const Vector2d& section) {
    const Vector3d to = placed(cycle_, along, section);
    if ((to - builder_.at()).norm() > no_move) builder_.rapid(to);
    along_ = along;
    at_ = section;
  }
  void line(double along, const Vector2d& section, double feed) {
    const Vector3d to = placed(cycle_, along, section);
    if ((to - builder_.at()).norm() > no_move) builder_.line(to, feed);
    along_ = along;
    at_ = section;
  }
  void line(const Vector2d& section, double feed) { line(along_, section, feed); }
  /// Arc of the section, in G19; straight edges only.
  void section_arc(const Vector2d& to, const Vector2d& centre, bool counter_clockwise) {
    builder_.arc(placed(cycle_, along_, to), placed(cycle_, along_, centre), path::ArcPlane::YZ,
                 counter_clockwise, cycle_.feed);
    at_ = to;
  }
  /// Circle or arc about the centre of the edge to another place along it.
  void circle(double along, double z, bool counter_clockwise) {
    const Vector2d to(at_.x(), z);
    const Vector3d centre(cycle_.centre.x(), cycle_.centre.y(), 0);
    builder_.arc(placed(cycle_, along, to), centre, path::ArcPlane::XY, counter_clockwise,
                 cycle_.feed);
    along_ = along;
    at_ = to;
  }
  double along() const { return along_; }
  const Vector2d& at() const { return at_; }

private:
  const Cycle& cycle_;
  MotionBuilder builder_;
  double along_ = 0;
  Vector2d at_ = Vector2d::Zero();
};

double lowest_y(const std::vector<Station>& stations, double start) {
  double y = start;
  for (const Station& station : stations) y = std::min(y, station.tip.x());
  return y;
}

// Where the tool goes down and up: clear of the wall, not past the axis of a hole.
double approach_y(const Cycle& cycle, const std::vector<Station>& stations) {
  if (cycle.family == Family::HalfConcave) return stations.front().tip.x();
  if (cycle.family == Family::HalfConvex) return stations.front().tip.x() - cycle.y_clear;
  const double y = lowest_y(stations, -cycle.D / 2) - cycle.y_clear;
  const bool is_hole = cycle.side == WallSide::Inside && cycle.edge != EdgeShape::Straight;
  return is_hole ? std::max(y, -cycle.R0) : y;
}

// Method 1: the section from A at the clearance height, back to A.
void trace_section(const Cycle& cycle, SectionMover& mover, double yA) {
  const double a = core_radius(cycle), r = cycle.r, R = cycle.R, h = cycle.z_clear;
  const double F = cycle.feed, fast = cycle.approach_feed;
  switch (cycle.family) {
    case Family::Taper: {
      const TaperTriangle triangle = taper_triangle(cycle);
      mover.line({triangle.b, h}, fast);
      mover.line({-cycle.D / 2, -triangle.c}, F);
      break;
    }
    case Family::CornerR:
      mover.line({R - a, h}, fast);
      mover.line({R - a, 0}, F);
      mover.section_arc({-cycle.D / 2, -R - r}, {R - a, -R - r}, true);
      break;
    case Family::BottomR:
      mover.line({yA, -cycle.depth + R - r}, F);
      mover.line({-cycle.D / 2, -cycle.depth + R - r}, F);
      mover.section_arc({-R - a, -cycle.depth}, {-R - a, -cycle.depth + R - r}, false);
      mover.line({mover.at().x(), h}, fast);
      break;
    case Family::HalfConvex: {
      const double q0 = half_round_limit(cycle);
      const Vector2d foot((R + r) * std::sin(q0) + a, (R + r) * (std::cos(q0) - 1));
      mover.line({yA, foot.y()}, fast);
      mover.line({-foot.x(), foot.y()}, F);
      mover.section_arc({-a, 0}, {-a, -R - r}, false);
      mover.line({a, 0}, F);
      mover.section_arc(foot, {a, -R - r}, false);
      mover.line({-yA, foot.y()}, fast);
      mover.line({-yA, h}, fast);
      break;
    }
    default: {  // HalfConcave
      const double bottom = -r - std::sqrt(std::max(0.0, (R - r) * (R - r) - a * a));
      mover.line({yA, -r}, F);
      mover.section_arc({0, bottom}, {a, -r}, true);
      mover.section_arc({-yA, -r}, {-a, -r}, true);
      mover.line({-yA, h}, fast);
      break;
    }
  }
  if (mover.at().y() < h) {
    mover.line({yA, mover.at().y()}, fast);
    mover.line({yA, h}, fast);
  } else {
    mover.line({yA, h}, fast);
  }
}

void across_edge(const Cycle& cycle, const CycleResult& solved, SectionMover& mover,
                 const Progress& progress) {
  const double yA = approach_y(cycle, solved.stations);
  mover.rapid(solved.passes.front(), {yA, cycle.z_clear});
  for (std::size_t i = 0; i < solved.passes.size(); ++i) {
    progress.at(static_cast<double>(i) / static_cast<double>(solved.passes.size()), "cycle");
    mover.line(solved.passes[i], {yA, cycle.z_clear}, cycle.approach_feed);
    trace_section(cycle, mover, yA);
  }
}

// Where the tool goes: in a groove down to the angle that it reaches, where both sides meet, and up
// from there.
std::vector<Vector2d> cut_tips(const Cycle& cycle, const std::vector<Station>& stations) {
  std::vector<Vector2d> tips;
  if (cycle.family != Family::HalfConcave) {
    for (const Station& station : stations) tips.push_back(station.tip);
    return tips;
  }
  const double reach = degrees(groove_reach(cycle)), length = cycle.R - cycle.r;
  const auto add = [&](double degree) {
    const double q = radians(degree);
    const double a = degree > 0 ? core_radius(cycle) : -core_radius(cycle);
    tips.push_back({length * std::sin(q) - a, -length * std::cos(q) - cycle.r});
  };
  for (const double degree : places(-90, -reach, section_step(cycle))) add(degree);
  tips.back().x() = 0;
  const std::vector<double> up = places(reach, 90, section_step(cycle));
  for (std::size_t i = 1; i < up.size(); ++i) add(up[i]);
  return tips;
}

// From a station to the next without cutting the profile: down, y first; up, z first.
void step_to(const Cycle& cycle, SectionMover& mover, const Vector2d& tip) {
  const Vector2d at = mover.at();
  const bool is_up = tip.y() > at.y();
  mover.line(is_up ? Vector2d(at.x(), tip.y()) : Vector2d(tip.x(), at.y()), cycle.feed);
  mover.line(tip, cycle.feed);
}

void pass_along(const Cycle& cycle, SectionMover& mover, double to) {
  const Vector2d tip = mover.at();
  if (cycle.edge == EdgeShape::Straight) {
    mover.line(to, tip, cycle.feed);
  } else if (cycle.edge == EdgeShape::Circle) {
    mover.circle(mover.along(), tip.y(), cycle.counter_clockwise);
  } else {
    mover.circle(to, tip.y(), to > mover.along());
  }
}

void along_edge(const Cycle& cycle, const CycleResult& solved, SectionMover& mover,
                const Progress& progress) {
  const std::vector<Vector2d> tips = cut_tips(cycle, solved.stations);
  const double yA = approach_y(cycle, solved.stations);
  const double h = cycle.z_clear, fast = cycle.approach_feed;
  const bool is_half_round =
      cycle.family == Family::HalfConvex || cycle.family == Family::HalfConcave;
  const double yE = is_half_round ? -yA : yA;
  double begin = cycle.x_start, end = cycle.x_end;
  if (cycle.edge == EdgeShape::Straight) {
    const double direction = end < begin ? -1 : 1;
    begin -= direction * cycle.overrun;
    end += direction * cycle.overrun;
  } else {
    begin = cycle.angle_start;
    end = cycle.edge == EdgeShape::Circle ? begin : cycle.angle_end;
  }
  mover.rapid(begin, {yA, h});
  mover.line({yA, tips.front().y()}, fast);
  for (std::size_t i = 0; i < tips.size(); ++i) {
    progress.at(static_cast<double>(i) / static_cast<double>(tips.size()), "cycle");
    step_to(cycle, mover, tips[i]);
    pass_along(cycle, mover, mover.along() == begin ? end : begin);
    if (!cycle.zigzag && i + 1 < tips.size() && begin != end) {
      const double y = is_half_round && tips[i].x() > 0 ? yE : yA;
      mover.line({y, tips[i].y()}, fast);
      mover.line({y, h}, fast);
      mover.rapid(begin, {y, h});
      mover.line({y, tips[i + 1].y()}, fast);
    }
  }
  mover.line({yE, mover.at().y()}, fast);
  mover.line({yE, h}, fast);
}

void helical_side(const Cycle& cycle, SectionMover& mover) {
  const double sense = cycle.counter_clockwise ? 1 : -1;
  const double y = -cycle.D / 2, h = cycle.z_clear, f0 = cycle.angle_start;
  const bool is_hole = cycle.side == WallSide::Inside;
  const double yA = is_hole ? std::max(y - cycle.y_clear, -cycle.R0) : y - cycle.y_clear;
  mover.rapid(f0, {yA, h});
  mover.line({yA, 0}, cycle.feed);
  mover.line({y, 0}, cycle.feed);
  const auto turns = static_cast<int>(std::floor(cycle.depth / cycle.turn_pitch + 1e-6));
  for (int i = 1; i <= turns; ++i) {
    mover.circle(f0, -i * cycle.turn_pitch, cycle.counter_clockwise);
  }
  const double rest = cycle.depth - turns * cycle.turn_pitch;
  if (rest > 1e-6 * cycle.turn_pitch) {
    mover.circle(f0 + sense * 360 * rest / cycle.turn_pitch, -cycle.depth, cycle.counter_clockwise);
  }
  mover.circle(mover.along(), -cycle.depth, cycle.counter_clockwise);
  mover.line({yA, -cycle.depth}, cycle.approach_feed);
  mover.line({yA, h}, cycle.approach_feed);
}

void helical_corner(const Cycle& cycle, SectionMover& mover) {
  const double sense = cycle.counter_clockwise ? 1 : -1;
  const double a = core_radius(cycle), h = cycle.z_clear;
  const bool is_hole = cycle.side == WallSide::Inside;
  const double yA =
      is_hole ? std::max(-cycle.D / 2 - cycle.y_clear, -cycle.R0) : -cycle.D / 2 - cycle.y_clear;
  mover.rapid(cycle.angle_start, {cycle.R - a, h});
  mover.line({cycle.R - a, 0}, cycle.feed);
  // The first turn leaves q = 0: a circle there makes the top land tangent all round.
  if (radius_at(cycle, cycle.R - a) > smallest_circle) {
    mover.circle(mover.along(), 0, cycle.counter_clockwise);
  }
  for (const HelixPoint& point : helix_path(cycle)) {
    const double q = radians(point.q);
    const double R = cycle.R, r = cycle.r;
    mover.line(cycle.angle_start + sense * point.angle,
               {R - a - (R + r) * std::sin(q), (R + r) * (std::cos(q) - 1)}, cycle.feed);
  }
  mover.circle(mover.along(), mover.at().y(), cycle.counter_clockwise);
  mover.line({yA, mover.at().y()}, cycle.approach_feed);
  mover.line({yA, h}, cycle.approach_feed);
}

void rotated(const Cycle& cycle, const CycleResult& solved, Result& result) {
  MotionBuilder builder(result);
  bool is_first = true;
  for (const RotatedPoint& point : solved.rotated) {
    const Vector3d& to = cycle.rotation_axis == 0   ? point.about_x
                         : cycle.rotation_axis == 1 ? point.about_y
                                                    : point.about_z;
    if (is_first) {
      builder.rapid(to);
    } else {
      builder.line(to, cycle.feed);
    }
    is_first = false;
  }
}

}  // namespace

// So that a chord leaves at most the tolerance: step = 2 acos(1 - e/rho), rho the largest radius.
int helix_segments(const Cycle& cycle) {
  if (cycle.segments) return *cycle.segments;
  const double rho = std::max(radius_at(cycle, -cycle.D / 2), radius_at(cycle, cycle.R));
  const double ratio = std::clamp(1 - cycle.chord_tolerance / rho, -1.0, 1.0);
  return std::max(8, static_cast<int>(std::ceil(std::numbers::pi / std::acos(ratio))));
}

std::vector<HelixPoint> helix_path(const Cycle& cycle) {
  const bool is_round = cycle.family == Family::HelicalCornerR;
  const int segments = is_round ? helix_segments(cycle) : cycle.segments.value_or(72);
  const double total =
      (is_round ? 90 / cycle.turn_step : cycle.depth / cycle.turn_pitch) * segments;
  const auto count = static_cast<int>(std::ceil(total - 1e-6));
  const double sense = cycle.counter_clockwise ? 1 : -1;
  std::vector<HelixPoint> path;
  for (int j = 0; j <= count; ++j) {
    HelixPoint point;
    const double travelled = std::min(static_cast<double>(j), total);
    point.index = j;
    point.angle = 360 * travelled / segments;
    Vector2d tip(-cycle.D / 2, -cycle.turn_pitch * travelled / segments);
    if (is_round) {
      point.q = std::min(90.0, cycle.turn_step * travelled / segments);
      const double q = radians(point.q);
      tip = {cycle.R - core_radius(cycle) - (cycle.R + cycle.r) * std::sin(q),
             (cycle.R + cycle.r) * (std::cos(q) - 1)};
    }
    Cycle circle = cycle;
    circle.edge = EdgeShape::Circle;
    point.tip = placed(circle, cycle.angle_start + sense * point.angle, tip);
    point.tip_radius = radius_at(cycle, tip.x());
    path.push_back(point);
  }
  return path;
}

Result cycle_motion(const Cycle& cycle, const CycleResult& solved, const Progress& progress) {
  Result result;
  if (cycle.family == Family::Rotation) {
    rotated(cycle, solved, result);
  } else if (cycle.family == Family::ComplexSide || cycle.family == Family::ComplexCornerR) {
    if (cycle.outline) outline_motion(cycle, solved.offsets, result, progress);
  } else if (cycle.family != Family::Series) {
    Cycle placed_cycle = cycle;
    const bool is_helix =
        cycle.family == Family::HelicalSide || cycle.family == Family::HelicalCornerR;
    if (is_helix) placed_cycle.edge = EdgeShape::Circle;
    SectionMover mover(placed_cycle, result);
    if (cycle.family == Family::HelicalSide) {
      helical_side(placed_cycle, mover);
    } else if (cycle.family == Family::HelicalCornerR) {
      helical_corner(placed_cycle, mover);
    } else if (cycle.method == 1) {
      across_edge(cycle, solved, mover, progress);
    } else {
      along_edge(cycle, solved, mover, progress);
    }
  }
  if (!result.motion.empty()) {
    result.position = result.motion.back().to;
    result.machine = machine_of(result, result.motion.back());
  }
  return result;
}

}  // namespace ridgeline::macro
