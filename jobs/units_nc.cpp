#include "jobs/units_nc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units/figure.hpp"
#include "core/units/names.hpp"
#include "core/units/overlay.hpp"
#include "core/units/passes.hpp"
#include "jobs/units_program.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
using nc::LatheMove;
using nc::LatheProgram;
using nc::LatheStep;
using units::Approach;
using units::TurningMove;
using units::TurningStep;
using units::Unit;

/// Product cut that is nothing but rounding [mm^3].
constexpr double no_gouge = 1e-2;
constexpr double metres_per_minute = 1000.0 / 60;  // [mm/s]

constexpr Choices<nc::LatheControl, 2> dialects{{
    {"fanuc", nc::LatheControl::Fanuc},
    {"linuxcnc", nc::LatheControl::LinuxCnc},
}};

struct Output {
  nc::LatheControl control = nc::LatheControl::Fanuc;
  std::string_view dialect = "fanuc";
  int number = 1;
  std::optional<int> process;
  double top_speed = 3000;
};

Output read_output(const std::optional<Value>& value) {
  Output output;
  if (!value) return output;
  Object object(*value);
  output.control = object.choice("dialect", dialects, output.control);
  output.dialect = name_of(dialects, output.control);
  output.number = object.integer("program", 1, 9998, 1);
  if (object.has("process")) output.process = object.integer("process", 1, 2, 1);
  output.top_speed = object.number("top_speed", between(1, 100'000, "rev/min"), output.top_speed);
  object.finish();
  return output;
}

/// The imaginary tip of a turning tool, which tool setters measure, from its nose centre.
units::Point tip(const units::Point& centre, double R, Approach approach) {
  return {approach == Approach::Inner ? centre.r + R : centre.r - R, centre.z};
}

void add_path(const TurningMove& move, const TurningStep& step, const LatheFrame& frame,
              std::vector<LatheMove>& moves) {
  const double R = step.tool.nose_radius;
  const bool is_arc = move.path.arc.has_value();
  const double turn = is_arc ? units::length(move.path) / move.path.arc->radius : 0;
  const int n = std::max(1, static_cast<int>(std::ceil(turn / (std::numbers::pi / 2) - 1e-9)));
  for (int i = 1; i <= n; ++i) {
    const units::Point centre =
        i == n ? move.path.end : units::point_at(move.path, static_cast<double>(i) / n);
    const units::Point at = tip(centre, R, step.approach);
    LatheMove out;
    out.kind = move.kind == TurningMove::Kind::Rapid ? LatheMove::Kind::Rapid
               : is_arc                              ? LatheMove::Kind::Arc
                                                     : LatheMove::Kind::Line;
    out.x = at.r;
    out.z = frame.z(at.z) - R;
    out.feed = step.tool.feed_per_revolution;
    if (is_arc) {
      out.radius = move.path.arc->radius;
      const bool is_clockwise = move.path.arc->sense == units::Sense::Clockwise;
      out.is_clockwise = frame.process == 1 ? !is_clockwise : is_clockwise;  // Z is mirrored
    }
    moves.push_back(out);
  }
}

LatheStep drill_step(const TurningStep& step, const LatheFrame& frame) {
  LatheStep out;
  out.is_constant_surface = false;
  const double d = std::max(step.drill_diameter, 0.1);
  out.speed = step.tool.cutting_speed * 60 / (std::numbers::pi * d);
  out.feed = step.tool.feed_per_revolution;
  nc::LatheHole hole;
  hole.z = frame.z(step.drill_from);
  hole.end = frame.z(step.drill_to);
  hole.peck = d;
  out.holes.push_back(hole);
  return out;
}

LatheStep turn_step(const TurningStep& step, const LatheFrame& frame, const LatheProgram& program) {
  LatheStep out;
  out.speed = step.tool.cutting_speed / metres_per_minute;
  if (step.moves.empty()) return out;
  const units::Point start = step.moves.front().path.start;
  const TurningMove first{TurningMove::Kind::Rapid, {start, start, {}}};
  std::vector<LatheMove> begin;
  add_path(first, step, frame, begin);
  LatheMove between = begin.front();
  if (step.approach == Approach::Inner) {
    between.z = program.safe_z;  // in through the bore's mouth
  } else {
    between.x = program.safe_x;
  }
  out.moves = {between, begin.front()};
  for (const TurningMove& move : step.moves) add_path(move, step, frame, out.moves);
  if (step.approach == Approach::Inner) {
    LatheMove back = out.moves.back();
    back.kind = LatheMove::Kind::Rapid;
    back.z = program.safe_z;
    out.moves.push_back(back);
  }
  return out;
}

Json add_turned(const units::Program& program, const Unit& unit, const LatheFrame& frame,
                LatheProgram& text, std::vector<std::string>& notes) {
  const units::TurningPaths paths = units::turning_paths(program, unit);
  const units::TurningCheck check = units::check_turning(program, unit, paths);
  if (check.gouge > no_gouge) {
    throw Error(ErrorCode::VerificationFailed,
                fmt::format("the path of unit {} would cut {:.4f} mm3 of the product", unit.number,
                            check.gouge),
                {.field = fmt::format("/program/units/{}", unit.number - 1),
                 .value = fmt::format("{:.4f}", check.gouge),
                 .limit = "0 mm3"});
  }
  for (const std::string& note : paths.notes) notes.push_back(note);
  for (const TurningStep& step : paths.steps) {
    LatheStep out = step.kind == TurningStep::Kind::Drill ? drill_step(step, frame)
                                                          : turn_step(step, frame, text);
    out.tool = std::max(1, step.tool.number);
    out.comment = fmt::format("UNIT {} {} {}, {}", unit.number, name(unit.kind), step.tool.pattern,
                              step.tool.tool);
    if (step.kind == TurningStep::Kind::Turn) {
      out.comment += fmt::format(", LEAVES {:.6g}", step.allowance);
    }
    text.steps.push_back(std::move(out));
  }
  return {{"number", unit.number},
          {"gouge", check.gouge},
          {"left", check.left},
          {"left_thickness", check.thickness}};
}

/// What turning has left of the stock before a unit.
units::Region standing(const units::Program& program, const Unit& unit) {
  std::vector<units::Region> cut;
  for (const Unit& one : program.units) {
    if (one.number < unit.number && units::is_turned(one)) cut.push_back(one.region);
  }
  return units::difference_of(program.stock, units::union_of(cut));
}

struct Written {
  LatheProgram program;
  Json units = Json::array();
  std::vector<std::string> notes;
};

Written written(const units::Program& program, int process, const Output& output) {
  const units::Box product = units::box(program.product.shadow);
  const units::Box stock = units::box(program.stock);
  const LatheFrame frame{process, product.z1};
  Written out;
  out.program.number = output.number + process - 1;
  out.program.title = (program.product.name.empty() ? "part" : program.product.name) +
                      (process == 1 ? ", main spindle" : ", sub spindle");
  out.program.comments = {"x diameters, z from the finished end, out of the material",
                          "turning tools: imaginary tip, nose radius already taken into account"};
  out.program.safe_x = std::ceil(stock.r1) + 20;
  out.program.safe_z = std::ceil(process == 1 ? -stock.z0 : stock.z1 - product.z1) + 20;
  out.program.top_speed = output.top_speed;
  for (const Unit& unit : program.units) {
    if (unit.process != process) continue;
    if (unit.kind == units::UnitKind::Unexplained) {
      out.notes.push_back(fmt::format("unit {} is not explained: no path", unit.number));
    } else if (units::is_turned(unit)) {
      out.units.push_back(add_turned(program, unit, frame, out.program, out.notes));
    } else if (unit.kind == units::UnitKind::Hole) {
      add_hole_steps(unit, frame, standing(program, unit), output.control, out.program, out.notes);
    } else {
      add_mill_steps(program.product, unit, frame, output.control, out.program, out.notes);
    }
  }
  return out;
}

bool has_process(const units::Program& program, int process) {
  return std::ranges::any_of(program.units,
                             [&](const Unit& unit) { return unit.process == process; });
}

}  // namespace

Answer units_nc(const units::Program& program, const std::optional<Value>& output_value,
                std::string_view format) {
  const Output output = read_output(output_value);
  Answer answer;
  answer.document = {{"job", "units"},
                     {"status", "ok"},
                     {"operation", "nc"},
                     {"dialect", output.dialect},
                     {"programs", Json::array()},
                     {"units", Json::array()},
                     {"notes", Json::array()}};
  for (const int process : {1, 2}) {
    if (output.process.value_or(process) != process || !has_process(program, process)) continue;
    Written one = written(program, process, output);
    const std::string text = nc::lathe_text(one.program, output.control);
    answer.document["programs"].push_back(
        {{"process", process}, {"number", one.program.number}, {"text", text}});
    for (Json& unit : one.units) answer.document["units"].push_back(std::move(unit));
    for (const std::string& note : one.notes) answer.document["notes"].push_back(note);
    answer.text += text;
  }
  const bool is_one_file = output.control == nc::LatheControl::Fanuc;
  if (format == "nc" && !is_one_file && answer.document["programs"].size() > 1) {
    refuse(
        {.code = ErrorCode::Unsupported,
         .field = "/output/process",
         .value = "absent",
         .limit = "1 or 2",
         .message = "LinuxCNC keeps one program in a file: ask for process 1 or 2, or for json"});
  }
  // two FANUC programs are one file: a single % at each end
  const std::string between = "%\n%\n";
  if (const std::size_t at = answer.text.find(between); at != std::string::npos) {
    answer.text.erase(at, between.size());
  }
  return answer;
}

}  // namespace ridgeline::jobs
