#include "core/units/passes.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"
#include "core/units/figure.hpp"
#include "core/units/overlay.hpp"
#include "core/units/skin.hpp"
#include "core/units/tolerance.hpp"

namespace ridgeline::units {
namespace {

using Moves = std::vector<TurningMove>;
constexpr double lift = 0.5;          // [mm] that a tool leaves the wall before it goes back
constexpr double least_depth = 0.01;  // [mm]
constexpr std::size_t most_passes = 5000;
constexpr double no_volume = 1e-4;  // [mm^3] that is nothing but rounding

void require(bool holds, const Unit& unit, std::size_t row, const char* key, double value,
             const std::string& limit) {
  if (holds) return;
  const std::string field = "/program/units/" + std::to_string(unit.number - 1) + "/tools/" +
                            std::to_string(row) + "/" + key;
  throw Error(ErrorCode::BadInput, field + " must be " + limit + " mm, is " + std::to_string(value),
              {.field = field, .value = std::to_string(value), .limit = limit + " mm"});
}

void check_row(const Unit& unit, std::size_t i) {
  const ToolRow& row = unit.tools[i];
  const double R = row.nose_radius, depth = row.depth_of_cut, allowance = row.finish_allowance;
  require(R >= 0 && R <= 50, unit, i, "nose_radius", R, "0 to 50");
  require(depth >= least_depth, unit, i, "depth_of_cut", depth, "at least 0.01");
  require(allowance >= 0 && allowance <= 100, unit, i, "finish_allowance", allowance, "0 to 100");
}

void check_count(const Unit& unit, std::size_t i, std::size_t passes) {
  require(passes < most_passes, unit, i, "depth_of_cut", unit.tools[i].depth_of_cut,
          "large enough for 5000 passes, in");
}

/// The way of a tool, built move by move.
class Way {
public:
  explicit Way(const Point& start) : at_(start) {}
  void rapid(const Point& to) { add(TurningMove::Kind::Rapid, {at_, to, {}}); }
  void feed(const Point& to) { add(TurningMove::Kind::Feed, {at_, to, {}}); }
  void along(const Segment& path) {
    feed(path.start);
    add(TurningMove::Kind::Feed, path);
  }
  const Point& at() const { return at_; }
  Moves take() { return std::move(moves_); }

private:
  void add(TurningMove::Kind kind, const Segment& path) {
    if (!path.arc && std::hypot(path.end.r - at_.r, path.end.z - at_.z) < merge_tolerance) return;
    moves_.push_back({kind, path});
    at_ = path.end;
  }
  Moves moves_;
  Point at_;
};

std::vector<Segment> reversed(std::vector<Segment> rows) {
  std::reverse(rows.begin(), rows.end());
  for (Segment& row : rows) {
    std::swap(row.start, row.end);
    if (row.arc) {
      row.arc->sense =
          row.arc->sense == Sense::Clockwise ? Sense::CounterClockwise : Sense::Clockwise;
    }
  }
  return rows;
}

/// Radial place of the nose centre whose cutting side touches r.
double centre_at(const Bar& bar, double r, double R) {
  return bar.is_outer ? r + R : r - R;
}

/// What the tool's body keeps clear of, out of the work.
double safe_radius(const Bar& bar, const Region& stock, double R) {
  const double out = box(stock).r1 + turning_clearance + R;
  if (bar.is_outer) return out;
  return std::max(0.0, box(bar.region).r0 - R - turning_clearance);
}

/// Ends of the work along Z in the sense of the feed, for the nose centre.
struct Reach {
  double entry = 0;  ///< with a run-in where nothing stands before it
  double end = 0;
  double z0() const { return std::min(entry, end); }
  double z1() const { return std::max(entry, end); }
};
Reach reach_of(const Bar& bar, double R) {
  const Box b = box(bar.region);
  const double entry = bar.way > 0 ? b.z0 : b.z1;
  return {entry - bar.way * (R + turning_clearance), bar.way > 0 ? b.z1 : b.z0};
}

/// One pass along Z at the level of the nose centre, in every stretch that is free and has work.
void pass(Way& way, const Bar& bar, const std::vector<Segment>& skin, double c, double safe,
          const Box& work, double R) {
  const Reach reach = reach_of(bar, R);
  std::vector<Interval> free =
      free_on(bar, skin, c, std::max(reach.z0(), work.z0 - R - turning_clearance),
              std::min(reach.z1(), work.z1 + R + turning_clearance));
  if (bar.way < 0) std::reverse(free.begin(), free.end());
  for (const Interval& one : free) {
    if (one.z1 < work.z0 || one.z0 > work.z1) continue;
    const double from = bar.way > 0 ? one.z0 : one.z1;
    const double to = bar.way > 0 ? one.z1 : one.z0;
    if (std::abs(to - from) < 2 * merge_tolerance) continue;
    const bool is_open = std::abs(from - reach.entry) < merge_tolerance;
    const double above = bar.is_outer ? c + lift : std::max(0.0, c - lift);
    if (is_open) {
      way.rapid({way.at().r, from});
      way.rapid({c, from});
    } else {
      way.rapid({safe, way.at().z});
      way.rapid({safe, from});
      way.feed({c, from});
    }
    way.feed({c, to});
    way.feed({above, to});
    if (!is_open) way.rapid({safe, to});
  }
}

/// Along the skin from entry to end.
void follow(Way& way, const Bar& bar, std::vector<Segment> skin, double safe, double R) {
  if (!bar.is_outer) {  // where the product is solid the nose goes nowhere, not along the axis
    std::erase_if(skin, [](const Segment& row) {
      return row.start.r < merge_tolerance && row.end.r < merge_tolerance;
    });
  }
  if (skin.empty()) return;
  if (bar.way < 0) skin = reversed(std::move(skin));
  const Reach reach = reach_of(bar, R);
  way.rapid({safe, way.at().z});
  way.rapid({safe, reach.entry});
  const Point first = skin.front().start;
  if ((first.z - reach.entry) * bar.way > merge_tolerance) {
    way.rapid({first.r, reach.entry});
    way.feed(first);
  } else {
    way.rapid({safe, first.z});
    way.feed(first);
  }
  for (const Segment& row : skin) way.along(row);
  way.feed({bar.is_outer ? way.at().r + lift : std::max(0.0, way.at().r - lift), way.at().z});
  way.rapid({safe, way.at().z});
  way.rapid({safe, reach.entry});
}

/// `work_left`: of the region what no tool before has removed.
Moves bar_moves(const Unit& unit, const Bar& bar, const Region& work_left, const ToolRow& row,
                double allowance, const Region& stock, bool is_rough) {
  const double R = row.nose_radius;
  const Reach reach = reach_of(bar, R);
  const double safe = safe_radius(bar, stock, R);
  const std::vector<Segment> skin = skin_of(bar, allowance + R, reach.z0(), reach.z1());
  Way way({safe, reach.entry});
  const Box b = box(bar.region);
  if (is_rough && !is_empty(work_left)) {
    const double sign = bar.is_outer ? -1 : 1;
    double last = bar.is_outer ? b.r1 : box(work_left).r0;
    const double goal = bar.is_outer ? b.r0 + allowance : b.r1 - allowance;
    for (std::size_t count = 0; sign * (goal - last) > merge_tolerance; ++count) {
      check_count(unit, 0, count);
      double level = last + sign * row.depth_of_cut;
      if (sign * (goal - level) < 0) level = goal;
      const Region between =
          rectangle(std::min(last, level), std::max(last, level), b.z0 - 1, b.z1 + 1);
      const Box work = box(intersection_of(work_left, between));
      const double c = centre_at(bar, level, R);
      if (work.z1 - work.z0 > merge_tolerance && c >= 0) pass(way, bar, skin, c, safe, work, R);
      last = level;
    }
  }
  follow(way, bar, skin, safe, R);
  return way.take();
}

TurningStep pilot_of(const Bar& bar, const Box& on_axis, double diameter, double allowance) {
  TurningStep step;
  step.kind = TurningStep::Kind::Drill;
  step.approach = bar.way > 0 ? Approach::Front : Approach::Back;
  step.tool = {.tool = "drill 118 deg",
               .number = 6,
               .nominal_diameter = diameter,
               .pattern = "pilot drill",
               .depth_of_cut = diameter,
               .cutting_speed = 70 * 1000.0 / 60,
               .feed_per_revolution = std::min(0.3, 0.02 * diameter)};
  step.drill_diameter = diameter;
  step.drill_from = bar.way > 0 ? on_axis.z0 : on_axis.z1;
  const double end = bar.way > 0 ? on_axis.z1 : on_axis.z0;
  const double point = diameter / 2 / std::tan(drill_point_angle / 2);
  const double beyond = end + bar.way * point;
  const Region behind = intersection_of(
      bar.filled, rectangle(0, diameter / 2, std::min(end, beyond), std::max(end, beyond)));
  step.drill_to = is_empty(behind) ? beyond : end - bar.way * allowance;
  return step;
}

/// The bore from the solid: a drill that stays clear of the product by the allowance.
std::optional<TurningStep> pilot(const Bar& bar, double allowance) {
  const Box b = box(bar.region);
  if (b.r0 > merge_tolerance) return std::nullopt;
  const Box on_axis = box(intersection_of(bar.region, rectangle(0, 1e-3, b.z0, b.z1)));
  if (on_axis.z1 - on_axis.z0 < merge_tolerance) return std::nullopt;
  double narrowest = b.r1;
  for (const Segment& row : limit_of(bar.region, Limit::Greatest)) {
    if (std::abs(row.end.z - row.start.z) < merge_tolerance) continue;
    const double low = std::min(row.start.r, row.end.r);
    if (low > 10 * merge_tolerance) narrowest = std::min(narrowest, low);
  }
  for (double diameter = std::floor(2 * (narrowest - allowance) * 2) / 2; diameter >= 1;
       diameter -= 0.5) {  // half millimetres
    TurningStep step = pilot_of(bar, on_axis, diameter, allowance);
    TurningStep wider = step;
    wider.drill_diameter += 2 * allowance;
    if (volume(intersection_of(swept(wider), bar.filled)) < no_volume) return step;
  }
  return std::nullopt;
}

void turn_bar(const Program& program, const Unit& unit, TurningPaths& paths) {
  Bar bar{unit.region, filled_behind(program.product.shadow, unit.kind == UnitKind::BarOuter),
          unit.kind == UnitKind::BarOuter, unit.process == 1 ? 1 : -1};
  Region work_left = unit.region;
  for (std::size_t i = 0; i < unit.tools.size(); ++i) {
    check_row(unit, i);
    const ToolRow& row = unit.tools[i];
    const bool is_rough = i == 0;
    const double allowance = i + 1 < unit.tools.size() ? row.finish_allowance : 0;
    if (is_rough && !bar.is_outer) {
      if (std::optional<TurningStep> drill = pilot(bar, allowance)) {
        work_left = difference_of(unit.region, swept(*drill));
        paths.steps.push_back(std::move(*drill));
      }
    }
    TurningStep step;
    step.tool = row;
    step.approach = bar.is_outer ? Approach::Outer : Approach::Inner;
    step.allowance = allowance;
    step.moves = bar_moves(unit, bar, work_left, row, allowance, program.stock, is_rough);
    paths.steps.push_back(std::move(step));
  }
  const double fall = degrees(steepest_fall(bar));
  if (fall > 3) {
    paths.notes.push_back(
        "unit " + std::to_string(unit.number) + ": the product falls behind the nose at up to " +
        std::to_string(std::lround(fall)) + " deg: the trailing edge of the tool must clear that");
  }
}

/// How deep a face may be turned: what an edit wants of the product is not cut (design 1.8-o).
double face_floor(const Region& shadow, const Box& b, bool is_front) {
  const double far = std::max(b.r1, box(shadow).r1) + 1;
  const Region met = intersection_of(shadow, rectangle(b.r0, far, b.z0, b.z1));
  if (is_empty(met)) return is_front ? b.z1 : b.z0;
  return is_front ? box(met).z0 : box(met).z1;
}

void turn_face(const Program& program, const Unit& unit, TurningPaths& paths) {
  const bool is_front = unit.kind == UnitKind::FaceFront;
  const double sign = is_front ? 1 : -1;  // the way in depth
  const Box b = box(unit.region);
  const double top = is_front ? b.z0 : b.z1;
  const double floor = face_floor(program.product.shadow, b, is_front);
  const bool is_held = is_front != (unit.process == 1);
  if (is_held || sign * (floor - top) < merge_tolerance) {
    const char* why = is_held ? " lies in the chuck of its process" : " lies behind the product";
    paths.notes.push_back("unit " + std::to_string(unit.number) + why + ": no path");
    return;
  }
  for (std::size_t i = 0; i < unit.tools.size(); ++i) {
    check_row(unit, i);
    const ToolRow& row = unit.tools[i];
    const double R = row.nose_radius;
    const double allowance = i + 1 < unit.tools.size() ? row.finish_allowance : 0;
    const double goal = floor - sign * allowance;
    const double outside = b.r1 + R + turning_clearance;
    const double safe = top - sign * (R + turning_clearance);
    Way way({outside, safe});
    double level = i == 0 ? top : goal - sign * row.depth_of_cut;
    for (std::size_t count = 0; sign * (goal - level) > merge_tolerance; ++count) {
      check_count(unit, i, count);
      level += sign * row.depth_of_cut;
      if (sign * (goal - level) < 0) level = goal;
      const double c = level - sign * R;
      way.rapid({outside, c});
      way.feed({b.r0, c});
      way.feed({b.r0, c - sign * lift});
      way.rapid({outside, c - sign * lift});
    }
    way.rapid({outside, safe});
    TurningStep step;
    step.tool = row;
    step.approach = is_front ? Approach::Front : Approach::Back;
    step.allowance = allowance;
    step.moves = way.take();
    paths.steps.push_back(std::move(step));
  }
}

/// How far a tool from r to r + width may plunge before it meets the product.
double floor_at(const Region& shadow, const Region& groove, double r, double width, int way) {
  const Box g = box(groove);
  const Box s = box(intersection_of(shadow, rectangle(r, r + width, g.z0, g.z1)));
  if (s.r1 <= s.r0) return way > 0 ? g.z1 : g.z0;
  return way > 0 ? s.z0 : s.z1;
}

/// Plunges side by side, with pecks of the depth of cut.
void turn_groove(const Program& program, const Unit& unit, TurningPaths& paths) {
  const Box b = box(unit.region);
  const int way = unit.process == 1 ? 1 : -1;
  for (std::size_t i = 0; i < unit.tools.size(); ++i) {
    check_row(unit, i);
    const ToolRow& row = unit.tools[i];
    const double w = row.nominal_diameter;
    if (!(w >= 0.1 && w <= b.r1 - b.r0 + merge_tolerance)) {
      paths.notes.push_back("unit " + std::to_string(unit.number) + ": its tool is " +
                            std::to_string(w) + " mm wide, the groove " +
                            std::to_string(b.r1 - b.r0) + " mm: no path");
      return;
    }
    const double open = way > 0 ? b.z0 : b.z1;
    const double safe = open - way * turning_clearance;
    const int n = static_cast<int>(std::ceil((b.r1 - b.r0 - w) / (0.8 * w) - 1e-9));
    Way path({b.r0, safe});
    for (int k = 0; k <= n; ++k) {
      const double r = n == 0 ? b.r0 : b.r0 + (b.r1 - b.r0 - w) * k / n;
      const double floor = floor_at(program.product.shadow, unit.region, r, w, way);
      path.rapid({r, safe});
      for (double z = open; way * (floor - z) > merge_tolerance;) {
        z += way * row.depth_of_cut;
        if (way * (floor - z) < 0) z = floor;
        path.feed({r, z});
        if (z != floor) path.rapid({r, z - way * std::min(0.2, row.depth_of_cut)});
      }
      path.rapid({r, safe});
    }
    TurningStep step;
    step.tool = row;
    step.tool.nose_radius = 0;  // its corners are in the width
    step.width = w;
    step.approach = way > 0 ? Approach::Front : Approach::Back;
    step.moves = path.take();
    paths.steps.push_back(std::move(step));
  }
}

void drill_on_axis(const Unit& unit, TurningPaths& paths) {
  const Hole& hole = *unit.hole;
  const double way = hole.direction.z() > 0 ? 1 : -1;
  TurningStep step;
  step.kind = TurningStep::Kind::Drill;
  step.approach = way > 0 ? Approach::Front : Approach::Back;
  if (!unit.tools.empty()) step.tool = unit.tools.front();
  step.drill_diameter = hole.diameter;
  step.drill_from = hole.start.z();
  const double tip =
      hole.bottom == HoleBottom::Flat ? 0 : hole.diameter / 2 / std::tan(hole.point_angle / 2);
  step.drill_to = hole.start.z() + way * (hole.depth + tip);
  paths.steps.push_back(std::move(step));
}

}  // namespace

TurningPaths turning_paths(const Program& program, const Unit& unit) {
  TurningPaths paths;
  if (is_empty(unit.region)) {
    paths.notes.push_back("unit " + std::to_string(unit.number) + " removes nothing: no path");
    return paths;
  }
  switch (unit.kind) {
    case UnitKind::BarOuter:
    case UnitKind::BarInner: turn_bar(program, unit, paths); break;
    case UnitKind::FaceFront:
    case UnitKind::FaceBack: turn_face(program, unit, paths); break;
    case UnitKind::Hole:
      if (is_turned(unit)) drill_on_axis(unit, paths);
      break;
    case UnitKind::Groove: turn_groove(program, unit, paths); break;
    case UnitKind::FaceMill:
    case UnitKind::Unexplained: break;
  }
  return paths;
}

}  // namespace ridgeline::units
