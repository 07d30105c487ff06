#include <cmath>
#include <string>

#include "core/base/angle.hpp"
#include "core/macro/cycle.hpp"
#include "core/macro/cycle_section.hpp"
#include "core/macro/refuse.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

namespace {

constexpr double most_passes = 1e6;  // passes, levels or segments of one cycle
constexpr double largest = 1e5;      // [mm]
constexpr double tolerance = 1e-9;   // [mm], rounding of numbers that should be equal

void require(bool holds, const std::string& field, double value, const std::string& limit) {
  if (!holds) refuse(field, value, limit);
}

void check_step(const std::string& field, double step, double range) {
  require(step > 0, field, step, "greater than 0");
  require(std::abs(range) / step <= most_passes, field, step,
          "at least a millionth of the way " + number_text(std::abs(range)));
}

void check_tool(const Cycle& cycle) {
  require(cycle.D > 0 && cycle.D <= largest, "D", cycle.D, "greater than 0 and at most 100000 mm");
  require(cycle.r >= 0 && cycle.r <= cycle.D / 2 + tolerance, "r", cycle.r,
          "0 to D/2 = " + number_text(cycle.D / 2) + " mm");
}

void check_slope(const Cycle& cycle) {
  require(cycle.width >= 0 && cycle.width <= largest, "width", cycle.width, "0 to 100000 mm");
  require(cycle.angle > 0 && cycle.angle < 90, "angle_deg", cycle.angle,
          "greater than 0 and less than 90 degrees");
}

void check_round(const Cycle& cycle) {
  require(cycle.R > 0 && cycle.R <= largest, "R", cycle.R, "greater than 0 and at most 100000 mm");
  if (cycle.family == Family::BottomR || cycle.family == Family::HalfConcave) {
    require(cycle.r <= cycle.R + tolerance, "r", cycle.r,
            "at most R = " + number_text(cycle.R) + " mm");
  }
  if (cycle.family == Family::BottomR) {
    require(cycle.depth >= cycle.R && cycle.depth <= largest, "depth", cycle.depth,
            "at least R = " + number_text(cycle.R) + " mm");
  }
  if (cycle.family == Family::HalfConcave) {
    require(cycle.D <= 2 * cycle.R + tolerance, "D", cycle.D,
            "at most 2 R = " + number_text(2 * cycle.R) + " mm");
  }
  if (cycle.family == Family::HalfConvex && cycle.z_floor) {
    require(*cycle.z_floor < 0 && *cycle.z_floor >= -cycle.R - cycle.r - tolerance, "z_floor",
            *cycle.z_floor, "less than 0 and at least -R - r");
  }
}

void check_r_taper_r(const Cycle& cycle) {
  check_slope(cycle);
  require(cycle.R > 0 && cycle.R <= largest, "R1", cycle.R, "greater than 0 and at most 100000 mm");
  require(cycle.R2 > 0 && cycle.R2 <= largest, "R2", cycle.R2,
          "greater than 0 and at most 100000 mm");
  if (cycle.lower == LowerRound::Concave) {
    require(cycle.r <= cycle.R2 + tolerance, "r", cycle.r,
            "at most R2 = " + number_text(cycle.R2) + " mm");
  }
  const RTaperRLengths lengths = r_taper_r(cycle);
  const double slope = cycle.width / std::cos(radians(cycle.angle));
  require(lengths.t1 + lengths.t2 <= slope + tolerance, "width", cycle.width,
          "wide enough that both rounds fit on the slope, t1 + t2 = " +
              number_text(lengths.t1 + lengths.t2) + " mm <= w/cos t");
}

void check_circle(const Cycle& cycle) {
  require(cycle.R0 > 0 && cycle.R0 <= largest, "R0", cycle.R0,
          "greater than 0 and at most 100000 mm");
  const bool is_helix =
      cycle.family == Family::HelicalSide || cycle.family == Family::HelicalCornerR;
  if (cycle.side == WallSide::Outside) {
    const double top = cycle.family == Family::Taper     ? cycle.width
                       : cycle.family == Family::RTaperR ? r_taper_r(cycle).K1.x()
                       : cycle.family == Family::CornerR || cycle.family == Family::HelicalCornerR
                           ? cycle.R
                           : 0;
    require(cycle.R0 - top >= 0, "R0", cycle.R0,
            "at least the way to the top edge, " + number_text(top) + " mm");
  }
  if (!is_helix) {
    require(std::abs(cycle.angle_end - cycle.angle_start) <= 360 + tolerance &&
                cycle.angle_end != cycle.angle_start,
            "angle_end", cycle.angle_end, "up to 360 degrees from angle_start");
  }
}

void check_sections(const Cycle& cycle) {
  switch (cycle.family) {
    case Family::Taper:
    case Family::ComplexSide: check_slope(cycle); break;
    case Family::RTaperR: check_r_taper_r(cycle); break;
    case Family::HelicalSide:
      require(cycle.depth > 0 && cycle.depth <= largest, "depth", cycle.depth,
              "greater than 0 and at most 100000 mm");
      check_step("pitch", cycle.turn_pitch, cycle.depth);
      break;
    default: check_round(cycle); break;
  }
  if (cycle.family == Family::HelicalCornerR) {
    require(cycle.turn_step > 0 && cycle.turn_step <= 90, "phi_deg_per_turn", cycle.turn_step,
            "greater than 0 and at most 90 degrees");
    const double segments = cycle.segments.value_or(72);
    require(segments >= 3 && segments <= 100000, "segments_per_turn", segments, "3 to 100000");
    require(segments * 90 / cycle.turn_step <= most_passes, "segments_per_turn", segments,
            "so few that the spiral has at most a million");
  }
}

void check_steps(const Cycle& cycle) {
  require(cycle.cusp > 0 && cycle.cusp <= largest, "cusp", cycle.cusp, "greater than 0 mm");
  if (cycle.family == Family::HelicalSide || cycle.family == Family::HelicalCornerR) return;
  if (cycle.method == 1) {
    const bool is_straight = cycle.edge == EdgeShape::Straight;
    const double range =
        is_straight ? cycle.x_end - cycle.x_start : cycle.angle_end - cycle.angle_start;
    check_step(is_straight ? "pitch" : "angle_step", pass_step(cycle), range);
  }
  const bool has_slope = cycle.family == Family::Taper || cycle.family == Family::ComplexSide ||
                         cycle.family == Family::RTaperR;
  if (has_slope && cycle.method == 2) {
    check_step("pitch_along_slope", slope_step(cycle),
               cycle.width / std::cos(radians(cycle.angle)));
  }
  if (cycle.family != Family::Taper && cycle.family != Family::ComplexSide) {
    check_step("step_deg", section_step(cycle), 180);
  }
}

void check_motion(const Cycle& cycle) {
  require(cycle.feed > 0, "feed", cycle.feed, "greater than 0 mm/min");
  require(cycle.approach_feed > 0, "approach_feed", cycle.approach_feed, "greater than 0 mm/min");
  require(cycle.z_clear >= 0 && cycle.z_clear <= largest, "z_clear", cycle.z_clear,
          "0 to 100000 mm");
  require(cycle.y_clear >= 0 && cycle.y_clear <= largest, "y_clear", cycle.y_clear,
          "0 to 100000 mm");
  require(cycle.overrun >= 0 && cycle.overrun <= largest, "overrun", cycle.overrun,
          "0 to 100000 mm");
  for (const double x : {cycle.x_start, cycle.x_end, cycle.y_pos, cycle.centre.x(),
                         cycle.centre.y(), cycle.angle_start, cycle.angle_end}) {
    require(std::abs(x) <= largest, "position", x, "within 100000 mm of the origin");
  }
}

void check_combination(const Cycle& cycle) {
  require(cycle.method == 1 || cycle.method == 2, "method", cycle.method, "1 or 2");
  if (cycle.method == 2) return;
  const bool traces_section = cycle.family == Family::Taper || cycle.family == Family::CornerR ||
                              cycle.family == Family::BottomR ||
                              cycle.family == Family::HalfConvex ||
                              cycle.family == Family::HalfConcave;
  if (!traces_section || (cycle.edge != EdgeShape::Straight && cycle.family != Family::Taper)) {
    throw Error(ErrorCode::Unsupported,
                "method 1 is offered for tapers and, on straight edges, for corner R, bottom R and "
                "half rounds: an arc in a radial plane cannot be commanded; use method 2");
  }
}

}  // namespace

void validate(const Cycle& cycle) {
  if (cycle.family == Family::Rotation || cycle.family == Family::Series) {
    require(std::isfinite(cycle.rotation), "angle_deg", cycle.rotation, "a number");
    require(cycle.terms >= 1 && cycle.terms <= 100, "terms", cycle.terms, "1 to 100");
    return;
  }
  check_tool(cycle);
  check_sections(cycle);
  const bool is_helix =
      cycle.family == Family::HelicalSide || cycle.family == Family::HelicalCornerR;
  if (!is_helix) check_combination(cycle);
  if (is_helix || cycle.edge != EdgeShape::Straight) check_circle(cycle);
  check_motion(cycle);
  check_steps(cycle);
}

}  // namespace ridgeline::macro
