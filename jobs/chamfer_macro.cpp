#include "jobs/chamfer_macro.hpp"

#include <cmath>
#include <numbers>

#include "core/base/angle.hpp"
#include "core/macro/hole_edge.hpp"
#include "jobs/refuse.hpp"

namespace ridgeline::jobs {
namespace {

constexpr double square = 1e-9;         // cosine of axes that count as square, offset of parallels
constexpr double minute = 60;           // [s]
constexpr double approach_feed = 1000;  // [mm/min] down the hole to the height of the first point

[[noreturn]] void refuse_form(const std::string& field, const std::string& limit) {
  refuse({.code = ErrorCode::Unsupported,
          .field = field,
          .value = "",
          .limit = limit,
          .message = "--format macro serves " + limit + ": ask for --format nc"});
}

const geometry::Hole& hole_of(const chamfer::Job& job) {
  for (const geometry::Hole& hole : job.workpiece.holes) {
    if (hole.name == job.hole) return hole;
  }
  throw Error(ErrorCode::UnknownHole, "there is no hole \"" + job.hole + "\"");
}

/// What the macro's arithmetic does not have.
void check_form(const ChamferJob& chamfer, const geometry::Hole& hole) {
  const chamfer::Job& job = chamfer.job;
  if (hole.profile.straight_along != 0 || hole.profile.straight_across != 0) {
    refuse_form("/hole", "round holes");
  }
  if (std::abs(hole.axis.normalized().z()) < 1 - square) {
    refuse_form("/hole", "holes along Z, the tool's axis");
  }
  if (std::abs(job.workpiece.axis.normalized().z()) > square) {
    refuse_form("/workpiece", "bores square to Z");
  }
  const bool is_block = job.workpiece.shape == geometry::BodyShape::ManifoldBlock;
  if (is_block && job.edge == geometry::EdgeKind::Outer) {
    refuse_form("/edge", "edges on cylinders, not on plane faces");
  }
  if (const auto* axis = std::get_if<Eigen::Vector3d>(&job.tool_axis)) {
    if (axis->normalized().z() < 1 - square) refuse_form("/tool_axis", "the tool along +Z");
  } else if (std::get<chamfer::Access>(job.tool_axis) != chamfer::Access::Hole) {
    refuse_form("/tool_axis", "the tool through the hole");
  }
  if (std::holds_alternative<chamfer::AngleTable>(job.section_angle)) {
    refuse_form("/section_angle", "the bisector or one angle");
  }
  if (!job.pass_widths.empty() || job.spring_pass) {
    refuse_form("/passes", "one pass of the width in argument W; call it again for each");
  }
  if (job.control_point != chamfer::ControlPoint::Tip) {
    refuse_form("/output/control_point", "programs of the tip");
  }
  const bool is_known = chamfer.program.dialect == nc::Dialect::Fanuc ||
                        chamfer.program.dialect == nc::Dialect::LinuxCnc;
  if (!is_known) refuse_form("/output/dialect", "fanuc and linuxcnc");
}

double top_over_bore(const geometry::Workpiece& workpiece) {
  return workpiece.shape == geometry::BodyShape::ThickWalledCylinder ? workpiece.outer_radius
                                                                     : workpiece.size.z() / 2;
}

macro::HoleEdge edge_of(const ChamferJob& chamfer, const geometry::Hole& hole) {
  const chamfer::Job& job = chamfer.job;
  // The tool comes from +Z: seen from there, a hole that opens downwards has its sides exchanged.
  geometry::Hole upright = hole;
  const bool opens_down = hole.axis.z() < 0;
  upright.axis = Eigen::Vector3d::UnitZ();
  const geometry::Frame frame = geometry::hole_frame(job.workpiece, upright);
  macro::HoleEdge edge;
  edge.is_outer = job.edge == geometry::EdgeKind::Outer;
  edge.is_exit = (job.side == geometry::Side::Exit) != opens_down;
  edge.R1 = edge.is_outer ? job.workpiece.outer_radius : job.workpiece.inner_radius;
  edge.R2 = hole.profile.R2;
  edge.f = geometry::eccentric_distance(job.workpiece, upright);
  edge.width = job.width;
  if (const auto* angle = std::get_if<chamfer::ConstantAngle>(&job.section_angle)) {
    edge.section_angle = degrees(angle->delta);
  }
  edge.ball_radius = tool::cutting_radius(job.tool);
  edge.offset_number = job.tool.length_offset > 0 ? job.tool.length_offset
                       : job.tool.number > 0      ? job.tool.number
                                                  : 1;
  const double start = degrees(job.start_angle);
  edge.start_angle = opens_down ? 180 - start : start;
  // Inside a hole a clockwise cutter climbs counter-clockwise.
  const bool climbs = job.direction == chamfer::Direction::Climb;
  const bool turns_clockwise = job.tool.spindle == tool::SpindleSense::Clockwise;
  edge.is_clockwise = climbs != turns_clockwise;
  edge.position = frame.origin;
  edge.rotation = degrees(std::atan2(frame.axes(1, 0), frame.axes(0, 0)));
  edge.feed = job.feed * minute;
  edge.approach_feed = approach_feed;
  edge.z_clear = top_over_bore(job.workpiece) + job.clearance;
  edge.points = job.points ? *job.points : macro::hole_edge_points(edge, job.tolerance);
  return edge;
}

}  // namespace

std::string chamfer_macro(const ChamferJob& job) {
  const geometry::Hole& hole = hole_of(job.job);
  check_form(job, hole);
  const bool is_linuxcnc = job.program.dialect == nc::Dialect::LinuxCnc;
  macro::HoleEdgeProgram program;
  program.kind =
      is_linuxcnc ? macro::HoleEdgeProgram::Kind::Main : macro::HoleEdgeProgram::Kind::Macro;
  program.dialect = is_linuxcnc ? macro::ProgramDialect::LinuxCnc : macro::ProgramDialect::Fanuc;
  program.number = job.program.number;
  program.work_offset = job.program.work_offset;
  return macro::hole_edge_program(edge_of(job, hole), program);
}

}  // namespace ridgeline::jobs
