#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/base/angle.hpp"
#include "core/macro/cycle.hpp"
#include "core/nc/reader.hpp"
#include "jobs/cycle_job.hpp"
#include "jobs/predict_work.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double same_axis = 1e-5;  // as far as a program's angles are rounded

Vector3d bottom_normal(const Vector3d&) {
  return Vector3d::UnitZ();
}

nc::Program program_of(const nc::Reading& reading, int number) {
  nc::Program program;
  program.number = number;
  program.dialect = reading.dialect;
  program.tool_number = reading.tool_number.value_or(0);
  program.length_offset = reading.length_offset.value_or(0);
  program.spindle_speed = reading.spindle_speed.value_or(0);
  program.spindle_clockwise = reading.spindle_clockwise.value_or(true);
  program.work_offset = reading.work_offset;
  return program;
}

/// Arcs of the interpreter, whose whole turns become arcs of their own.
void append(const macro::Result& result, const macro::Move& move, Vector3d& at,
            path::Motion& motion) {
  path::Move out{move.kind == macro::MoveKind::Rapid ? path::MoveKind::Rapid : path::MoveKind::Cut,
                 move.to,
                 move.feed / 60,
                 {}};
  if (move.kind == macro::MoveKind::Arc) {
    const macro::ArcDetail& arc = macro::arc_of(result, move);
    out.arc = path::Arc{arc.centre, arc.plane, arc.sense, Eigen::Matrix3d::Identity()};
    if (arc.turns > 0) {
      refuse({.code = ErrorCode::Unsupported,
              .field = "/along",
              .value = std::to_string(arc.turns) + " turns in one block",
              .limit = "arcs of at most a turn"});
    }
  }
  at = move.to;
  motion.moves.push_back(std::move(out));
}

path::Motion motion_of(const macro::Result& result) {
  path::Motion motion;
  Vector3d at = Vector3d::Zero();
  for (const macro::Move& move : result.motion) {
    if (move.kind == macro::MoveKind::Dwell) continue;
    if (move.machine_fixed) continue;
    append(result, move, at, motion);
  }
  return motion;
}

/// The normal of the cycle's station whose tip is nearest in the section, turned to where it is.
class SectionNormals {
public:
  SectionNormals(const macro::Cycle& cycle, const macro::CycleResult& result, double radius)
      : cycle_(cycle), points_(result.points), radius_(radius) {}

  Vector3d operator()(const Vector3d& centre) const {
    const Vector3d tip = centre - Vector3d(0, 0, radius_);
    const macro::CyclePoint* best = &points_.front();
    double nearest = std::numeric_limits<double>::infinity();
    for (const macro::CyclePoint& point : points_) {
      const double distance = (section(tip) - section(point.tip)).squaredNorm();
      if (!(distance < nearest)) continue;
      nearest = distance;
      best = &point;
    }
    if (cycle_.edge == macro::EdgeShape::Straight) return best->normal;
    const Vector3d out = radial(centre);
    return best->normal.dot(radial(best->tip)) * out + Vector3d(0, 0, best->normal.z());
  }

private:
  Vector2d section(const Vector3d& p) const {
    if (cycle_.edge == macro::EdgeShape::Straight) return {p.y(), p.z()};
    return {(p.head<2>() - cycle_.centre).norm(), p.z()};
  }
  Vector3d radial(const Vector3d& p) const {
    const Vector2d from = p.head<2>() - cycle_.centre;
    if (from.norm() < 1e-12) return Vector3d::UnitX();
    return Vector3d(from.x(), from.y(), 0) / from.norm();
  }

  macro::Cycle cycle_;
  std::vector<macro::CyclePoint> points_;
  double radius_;
};

}  // namespace

Answer predict_nc(Object& job, const Value& along, const Request& request) {
  Object object(along);
  object.required("job");
  const std::string& program = object.required("program").string();
  const int number = object.integer("number", 1, 99'999'999, 1);
  WorkPath work;
  work.kind = "program";
  work.normal = bottom_normal;
  if (const std::optional<Value> normal = object.optional("normal")) {
    work.normal = [n = normal->direction()](const Vector3d&) { return n; };
  }
  const nc::Reading reading = nc::read(program, {}, request.progress.part(0, 0));
  work.program = program_of(reading, number);
  if (reading.tool_axis) work.tool_axis = reading.tool_axis->normalized();
  if (const std::optional<Value> given = object.optional("tool_axis")) {
    const Vector3d axis = given->direction();
    if (reading.tool_axis && !axis.isApprox(work.tool_axis, same_axis)) {
      given->refuse("the tool axis of the program's plane, or left out");
    }
    work.tool_axis = axis;
    if (!reading.tool_axis) work.program.tilted = nc::TiltedOutput::WorkFrame;
  }
  constexpr double most_tilt = 1e-6;  // sine of the axis above the level
  if (!(work.tool_axis.z() > most_tilt)) {
    refuse({.code = ErrorCode::Unsupported,
            .field = "/along/program",
            .value = "an axis with Z " + text(work.tool_axis.z()),
            .limit = "a tool that comes from above: the stock is a height map"});
  }
  work.motion = reading.motion;
  work.rpm = reading.spindle_speed;
  return predict_work(job, object, std::move(work), resolve_path_tool(job, request.definitions),
                      request);
}

Answer predict_cycle(Object& job, const Value& along, const Request& request) {
  Object object(along);
  object.required("job");
  for (const char* label : {"id", "frame"}) object.has(label);
  const macro::Cycle cycle = read_cycle(object);
  WorkPath work;
  work.kind = "cycle";
  work.program.number = 1;
  if (const std::optional<Value> program = object.optional("program")) {
    Object output(*program);
    for (const char* other : {"kind", "dialect", "work_offset", "tool"}) output.has(other);
    work.program.number = output.integer("number", 1, 99'999'998, 1);
    work.rpm = output.optional_number("spindle_speed", between(0, 1e6, "rev/min"));
    output.finish();
  }
  const ResolvedTool tool = resolve_path_tool(job, request.definitions);
  const double radius = tool::cutting_radius(tool.tool);
  constexpr double same = 1e-6;  // mm
  if (std::abs(cycle.r - cycle.D / 2) > same || std::abs(cycle.r - radius) > same) {
    refuse({.code = ErrorCode::Unsupported,
            .field = "/along/params/r",
            .value = text(cycle.r) + " mm",
            .limit = "the tool's radius " + text(radius) + " mm and D/2: a ball"});
  }
  const macro::CycleResult result = macro::solve(cycle, request.progress.part(0, 0.05));
  if (result.points.empty()) {
    refuse({.code = ErrorCode::Unsupported,
            .field = "/along/family",
            .limit = "a family whose stations have contact points and normals"});
  }
  work.motion = motion_of(result.motion);
  work.program.spindle_speed = work.rpm.value_or(0);
  work.normal = SectionNormals(cycle, result, radius);
  return predict_work(job, object, std::move(work), tool, request);
}

}  // namespace ridgeline::jobs
