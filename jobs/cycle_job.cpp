#include "jobs/cycle_job.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <utility>

#include "jobs/limits.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using macro::Cycle;
using macro::EdgeShape;
using macro::Family;

constexpr std::size_t max_outline = 100'000;
constexpr std::size_t max_points = 1'000'000;

struct FamilyName {
  std::string_view name;
  Family family;
  EdgeShape edge;
};

// "taper straight": the shape of the edge is part of the name. Compared without case and blanks.
constexpr FamilyName families[] = {
    {"taper straight", Family::Taper, EdgeShape::Straight},
    {"taper circle", Family::Taper, EdgeShape::Circle},
    {"taper arc", Family::Taper, EdgeShape::Arc},
    {"corner R straight", Family::CornerR, EdgeShape::Straight},
    {"corner R circle", Family::CornerR, EdgeShape::Circle},
    {"corner R arc", Family::CornerR, EdgeShape::Arc},
    {"bottom R straight", Family::BottomR, EdgeShape::Straight},
    {"bottom R circle", Family::BottomR, EdgeShape::Circle},
    {"bottom R arc", Family::BottomR, EdgeShape::Arc},
    {"half round convex", Family::HalfConvex, EdgeShape::Straight},
    {"half round concave", Family::HalfConcave, EdgeShape::Straight},
    {"R-taper-R straight", Family::RTaperR, EdgeShape::Straight},
    {"R-taper-R circle", Family::RTaperR, EdgeShape::Circle},
    {"R-taper-R arc", Family::RTaperR, EdgeShape::Arc},
    {"complex side", Family::ComplexSide, EdgeShape::Straight},
    {"complex corner R", Family::ComplexCornerR, EdgeShape::Straight},
    {"helical side", Family::HelicalSide, EdgeShape::Circle},
    {"helical corner R", Family::HelicalCornerR, EdgeShape::Circle},
    {"coordinate rotation", Family::Rotation, EdgeShape::Straight},
    {"sin cos tan series", Family::Series, EdgeShape::Straight},
};

struct FamilyAlias {
  std::string_view alias, name;
};
constexpr FamilyAlias aliases[] = {
    {"R-taper-R", "R-taper-R straight"},
    {"half convex", "half round convex"},
    {"half concave", "half round concave"},
    {"half round convex straight", "half round convex"},
    {"half round concave straight", "half round concave"},
    {"complex taper", "complex side"},
    {"complex R chamfer", "complex corner R"},
    {"continuous in-feed side", "helical side"},
    {"continuous in-feed corner R", "helical corner R"},
    {"helical cylinder", "helical side"},
    {"rotation", "coordinate rotation"},
    {"trigonometric series", "sin cos tan series"},
    {"trig series", "sin cos tan series"},
    {"maclaurin series", "sin cos tan series"},
    {"maclaurin", "sin cos tan series"},
    {"series", "sin cos tan series"},
    {"sin cos tan", "sin cos tan series"},
    {"sin cos series", "sin cos tan series"},
    {"sine cosine tangent series", "sin cos tan series"},
    {"maclaurin sin cos tan", "sin cos tan series"},
    {"complex side taper", "complex side"},
    {"complex side machining", "complex side"},
    {"helical cylinder side", "helical side"},
    {"helical wall", "helical side"},
    {"half round convex ridge", "half round convex"},
    {"half round concave groove", "half round concave"},
    {"R-taper-R line", "R-taper-R straight"},
};

std::string squeezed(std::string_view name) {
  std::string result;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) continue;
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

const FamilyName& family_of(const Value& value) {
  std::string wanted = squeezed(value.string());
  for (const FamilyAlias& alias : aliases) {
    if (squeezed(alias.alias) == wanted) wanted = squeezed(alias.name);
  }
  std::vector<std::string_view> names;
  for (const FamilyName& family : families) {
    if (squeezed(family.name) == wanted) return family;
    names.push_back(family.name);
  }
  value.refuse(alternatives(names));
}

Vector2d read_point(const Value& value) {
  const std::vector<Value> coordinates = value.array(2, 2);
  return {coordinates[0].number_or_text(coordinate_range),
          coordinates[1].number_or_text(coordinate_range)};
}

macro::Outline read_outline(const Value& value) {
  Object object(value);
  macro::Outline outline;
  outline.start = read_point(object.required("start"));
  for (const Value& each : object.required("moves").array(1, max_outline)) {
    Object move(each);
    macro::OutlineMove read;
    read.to = read_point(move.required("to"));
    if (const auto centre = move.optional("centre")) read.centre = read_point(*centre);
    constexpr Choices<bool, 2> senses{{{"cw", false}, {"ccw", true}}};
    read.counter_clockwise = move.choice("sense", senses, true);
    move.finish();
    outline.moves.push_back(read);
  }
  constexpr Choices<bool, 2> sides{{{"left", true}, {"right", false}}};
  outline.tool_left = object.choice("tool", sides, true);
  constexpr Choices<bool, 2> edges{{{"wall", false}, {"top_edge", true}}};
  outline.is_top_edge = object.choice("edge", edges, false);
  object.finish();
  return outline;
}

/// Reads the members of "params": each key once, under any of its names.
class Params {
public:
  explicit Params(const Value& value) : object_(value) {}

  std::optional<Value> find(std::initializer_list<std::string_view> names) {
    std::optional<Value> found;
    for (const std::string_view name : names) {
      const std::optional<Value> value = object_.optional(name);
      if (value && found) object_.refuse(name, "left out, " + found->pointer() + " says the same");
      if (value) found = value;
    }
    return found;
  }
  void number(std::initializer_list<std::string_view> names, double& target) {
    if (const auto value = find(names)) target = value->number_or_text(coordinate_range);
  }
  void number(std::initializer_list<std::string_view> names, std::optional<double>& target) {
    if (const auto value = find(names)) target = value->number_or_text(coordinate_range);
  }
  void require(std::string_view name, std::initializer_list<std::string_view> names,
               double& target) {
    const auto value = find(names);
    if (!value) object_.required(name);
    target = value->number_or_text(coordinate_range);
  }
  Object& object() { return object_; }

private:
  Object object_;
};

void read_tool(Params& params, Cycle& cycle) {
  params.require("D", {"D", "tool_diameter"}, cycle.D);
  params.number({"r", "tool_corner_radius", "tool_r"}, cycle.r);
  constexpr Choices<int, 3> kinds{{{"ball", 0}, {"bull_nose", 1}, {"flat", 2}}};
  if (const auto kind = params.find({"tool", "tool_kind"})) {
    const int choice = kind->choice(kinds);
    if (choice == 0) cycle.r = cycle.D / 2;
    if (choice == 2) cycle.r = 0;
  }
}

void read_section(Params& params, Cycle& cycle) {
  const Family family = cycle.family;
  const bool has_slope =
      family == Family::Taper || family == Family::ComplexSide || family == Family::RTaperR;
  if (has_slope) {
    params.require("width", {"width", "w"}, cycle.width);
    params.require("angle_deg", {"angle_deg", "angle", "theta_deg"}, cycle.angle);
  }
  const bool has_round = family == Family::CornerR || family == Family::BottomR ||
                         family == Family::HalfConvex || family == Family::HalfConcave ||
                         family == Family::ComplexCornerR || family == Family::HelicalCornerR;
  if (has_round) params.require("R", {"R"}, cycle.R);
  if (family == Family::RTaperR) {
    params.require("R1", {"R1", "R_top", "R_upper", "R"}, cycle.R);
    params.require("R2", {"R2", "R_bottom", "R_lower"}, cycle.R2);
    constexpr Choices<macro::LowerRound, 2> rounds{
        {{"concave", macro::LowerRound::Concave}, {"convex", macro::LowerRound::Convex}}};
    if (const auto lower = params.find({"lower", "lower_R", "variant", "foot"})) {
      cycle.lower = lower->choice(rounds);
    }
  }
  if (family == Family::BottomR || family == Family::HelicalSide) {
    params.require("depth", {"depth", "H", "z_depth", "height"}, cycle.depth);
  }
  if (family == Family::HalfConvex) params.number({"z_floor"}, cycle.z_floor);
}

void read_edge(Params& params, Cycle& cycle) {
  const bool is_round = cycle.edge != EdgeShape::Straight;
  const bool is_complex =
      cycle.family == Family::ComplexSide || cycle.family == Family::ComplexCornerR;
  if (is_round) {
    params.require("R0", {"R0", "wall_radius"}, cycle.R0);
    constexpr Choices<macro::WallSide, 2> sides{
        {{"outside", macro::WallSide::Outside}, {"inside", macro::WallSide::Inside}}};
    const auto side = params.find({"side"});
    if (!side) params.object().required("side");
    cycle.side = side->choice(sides);
    if (const auto centre = params.find({"center", "centre"})) cycle.centre = read_point(*centre);
    params.number({"angle_start", "angle_start_deg", "phi_start_deg"}, cycle.angle_start);
    params.number({"angle_end", "angle_end_deg", "phi_end_deg"}, cycle.angle_end);
    // Climb milling with a clockwise spindle; a helix winds on as the angle grows.
    const bool is_helix =
        cycle.family == Family::HelicalSide || cycle.family == Family::HelicalCornerR;
    cycle.counter_clockwise = is_helix || cycle.side == macro::WallSide::Inside;
  } else if (!is_complex && cycle.family != Family::Rotation && cycle.family != Family::Series) {
    params.require("x_start", {"x_start"}, cycle.x_start);
    params.require("x_end", {"x_end"}, cycle.x_end);
    params.number({"y_pos"}, cycle.y_pos);
  }
  if (is_complex) {
    if (const auto outline = params.find({"outline"})) cycle.outline = read_outline(*outline);
  }
}

void read_steps(Params& params, Cycle& cycle) {
  params.number({"cusp"}, cycle.cusp);
  if (cycle.family == Family::HelicalSide) {
    params.require("pitch",
                   {"pitch", "pitch_per_turn", "dz_per_turn", "z_per_turn", "z_pitch", "infeed"},
                   cycle.turn_pitch);
  } else if (cycle.family == Family::HelicalCornerR) {
    params.require("phi_deg_per_turn", {"phi_deg_per_turn", "step_deg"}, cycle.turn_step);
  } else {
    params.number({"pitch", "x_pitch"}, cycle.pitch);
    params.number({"step_deg"}, cycle.section_step);
    params.number({"pitch_along_slope", "slope_pitch", "ds"}, cycle.slope_step);
    params.number({"angle_step", "angle_step_deg"}, cycle.angle_step);
    std::optional<double> arc_pitch;
    params.number({"arc_pitch"}, arc_pitch);
    if (arc_pitch) {
      if (cycle.angle_step) params.object().exclude("arc_pitch", "angle_step");
      cycle.angle_step = *arc_pitch / cycle.R0 * 180 / 3.14159265358979323846;
    }
  }
  if (const auto segments = params.find({"segments_per_turn"})) {
    cycle.segments = static_cast<int>(segments->number_or_text(between(3, 100000, "segments")));
  }
  params.number({"chord_tolerance"}, cycle.chord_tolerance);
}

void read_motion(Params& params, Cycle& cycle) {
  params.number({"z_clear"}, cycle.z_clear);
  params.number({"y_clear"}, cycle.y_clear);
  params.number({"overrun"}, cycle.overrun);
  params.number({"feed", "F"}, cycle.feed);
  params.number({"approach_feed"}, cycle.approach_feed);
  if (const auto zigzag = params.find({"zigzag"})) cycle.zigzag = zigzag->boolean();
  constexpr Choices<bool, 2> senses{{{"cw", false}, {"ccw", true}}};
  if (const auto sense = params.find({"sense"})) cycle.counter_clockwise = sense->choice(senses);
  if (const auto number = params.find({"offset_number"})) {
    cycle.offset_number = number->integer(1, 400);
  }
}

// The points that tests/oracle/cycles turns, when a job gives none.
std::vector<Vector3d> sample_points() {
  std::vector<Vector3d> points;
  points.reserve(8);
  for (int i = 0; i < 8; ++i) points.emplace_back(10 + 3 * i, -4 + 2 * i, -i);
  return points;
}

void read_rotation(Params& params, Cycle& cycle) {
  params.require("angle_deg", {"angle_deg", "angle"}, cycle.rotation);
  constexpr Choices<int, 3> axes{{{"X", 0}, {"Y", 1}, {"Z", 2}}};
  if (const auto axis = params.find({"axis"})) cycle.rotation_axis = axis->choice(axes);
  if (const auto points = params.find({"points"})) {
    for (const Value& point : points->array(1, max_points)) {
      const std::vector<Value> p = point.array(3, 3);
      cycle.points.emplace_back(p[0].number_or_text(coordinate_range),
                                p[1].number_or_text(coordinate_range),
                                p[2].number_or_text(coordinate_range));
    }
  } else {
    cycle.points = sample_points();
  }
  params.number({"feed", "F"}, cycle.feed);
}

void read_series(Params& params, Cycle& cycle) {
  if (const auto terms = params.find({"terms", "n_terms", "n"})) {
    cycle.terms = static_cast<int>(terms->number_or_text(between(1, 100, "terms")));
  }
  if (const auto angles = params.find({"angles_deg", "angles", "angle_deg", "x_deg"})) {
    if (angles->json().is_array()) {
      for (const Value& angle : angles->array(1, max_points)) {
        cycle.angles.push_back(angle.number_or_text(coordinate_range));
      }
    } else {
      cycle.angles.push_back(angles->number_or_text(coordinate_range));
    }
  } else {
    for (int angle = -180; angle <= 180; angle += 15) cycle.angles.push_back(angle);
  }
}

}  // namespace

macro::Cycle read_cycle(Object& job) {
  const FamilyName& family = family_of(job.required("family"));
  Cycle cycle;
  cycle.family = family.family;
  cycle.edge = family.edge;
  const auto method = job.optional("method");
  if (method && !method->is_null()) cycle.method = method->integer(1, 2);
  Params params(job.required("params"));
  if (cycle.family == Family::Rotation) {
    read_rotation(params, cycle);
  } else if (cycle.family == Family::Series) {
    read_series(params, cycle);
  } else {
    read_tool(params, cycle);
    read_section(params, cycle);
    read_edge(params, cycle);
    read_steps(params, cycle);
    read_motion(params, cycle);
  }
  params.object().finish();
  return cycle;
}

}  // namespace ridgeline::jobs
