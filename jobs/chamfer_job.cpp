#include "jobs/chamfer_job.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/angle.hpp"
#include "jobs/chamfer_comments.hpp"
#include "jobs/limits.hpp"

namespace ridgeline::jobs {
namespace {

using chamfer::Access;
using chamfer::ControlPoint;
using chamfer::Direction;
using chamfer::FeedAt;
using chamfer::Method;
using geometry::EdgeKind;
using geometry::Side;

constexpr Choices<EdgeKind, 2> edges{{{"inner", EdgeKind::Inner}, {"outer", EdgeKind::Outer}}};
constexpr Choices<Side, 2> sides{{{"entry", Side::Entry}, {"exit", Side::Exit}}};
constexpr Choices<Method, 2> methods{{{"swept", Method::Swept}, {"section", Method::Section}}};
constexpr Choices<Direction, 2> directions{
    {{"climb", Direction::Climb}, {"conventional", Direction::Conventional}}};
constexpr Choices<FeedAt, 2> feed_points{
    {{"contact", FeedAt::Contact}, {"centre", FeedAt::Centre}}};
constexpr Choices<ControlPoint, 2> control_points{
    {{"tip", ControlPoint::Tip}, {"centre", ControlPoint::Centre}}};
constexpr Choices<nc::Dialect, 4> dialects{{{"fanuc", nc::Dialect::Fanuc},
                                            {"siemens", nc::Dialect::Siemens},
                                            {"heidenhain", nc::Dialect::Heidenhain},
                                            {"linuxcnc", nc::Dialect::LinuxCnc}}};
constexpr Choices<nc::Positioning, 2> positionings{
    {{"absolute", nc::Positioning::Absolute}, {"incremental", nc::Positioning::Incremental}}};
constexpr Choices<nc::ProgramKind, 2> program_kinds{
    {{"main", nc::ProgramKind::Main}, {"sub", nc::ProgramKind::Subprogram}}};
constexpr Choices<nc::Coolant, 3> coolants{
    {{"none", nc::Coolant::None}, {"flood", nc::Coolant::Flood}, {"mist", nc::Coolant::Mist}}};
constexpr Choices<nc::TiltedOutput, 2> tilted_outputs{
    {{"work_plane", nc::TiltedOutput::WorkPlane}, {"work_frame", nc::TiltedOutput::WorkFrame}}};

enum class NamedAxis { X, Y, Z, Hole, Bore };
constexpr Choices<NamedAxis, 5> named_axes{{{"z", NamedAxis::Z},
                                            {"x", NamedAxis::X},
                                            {"y", NamedAxis::Y},
                                            {"hole", NamedAxis::Hole},
                                            {"bore", NamedAxis::Bore}}};

constexpr Range width_range = between(1e-4, 1e5, "mm");
constexpr Range tolerance_range = above(0, 10, "mm");
constexpr Range feed_range = above(0, 1e6, "mm/min");
constexpr Range section_angle_range = above(0, 90, "degrees");
constexpr int max_passes = 100;

std::variant<Eigen::Vector3d, Access> read_tool_axis(Object& object) {
  const std::optional<Value> value = object.optional("tool_axis");
  if (!value) return Eigen::Vector3d(0, 0, 1);
  if (value->json().is_array()) return value->direction();
  switch (value->choice(named_axes)) {
    case NamedAxis::X: return Eigen::Vector3d(1, 0, 0);
    case NamedAxis::Y: return Eigen::Vector3d(0, 1, 0);
    case NamedAxis::Z: return Eigen::Vector3d(0, 0, 1);
    case NamedAxis::Hole: return Access::Hole;
    case NamedAxis::Bore: return Access::Bore;
  }
  throw Error(ErrorCode::Internal, "a named axis without a meaning");
}

chamfer::AngleTable read_angle_table(const Value& value) {
  constexpr std::size_t max_entries = 10'000;
  chamfer::AngleTable table;
  for (const Value& entry : value.array(1, max_entries)) {
    const std::vector<Value> pair = entry.array(2, 2);
    const double phi = radians(pair[0].number({0, 360, "degrees", false, true}));
    if (!table.entries.empty() && !(phi > table.entries.back().phi)) {
      pair[0].refuse("greater than the angle before it: the table ascends in phi");
    }
    table.entries.push_back({phi, radians(pair[1].number(section_angle_range))});
  }
  return table;
}

chamfer::SectionAngle read_section_angle(Object& object) {
  const std::optional<Value> value = object.optional("section_angle");
  if (!value) return chamfer::Bisector{};
  if (value->json().is_number()) {
    return chamfer::ConstantAngle{radians(value->number(section_angle_range))};
  }
  if (value->json().is_array()) return read_angle_table(*value);
  if (!value->is_word("bisector")) {
    value->refuse("\"bisector\", an angle in degrees or a table [[phi, angle], ...]");
  }
  return chamfer::Bisector{};
}

/// W, given or by the cutting amount: W = sqrt(2) Q [E 1].
double read_width(Object& object) {
  object.exclude("width", "cutting_amount");
  if (const std::optional<double> Q = object.optional_number("cutting_amount", width_range)) {
    return std::numbers::sqrt2 * *Q;
  }
  if (!object.has("width")) object.refuse("width", "give it or cutting_amount");
  return object.number("width", width_range);
}

/// Widths of the passes. A number of passes gives each the same area of chip: the area of a chamfer
/// grows with the square of its width.
std::vector<double> read_passes(Object& object, double width) {
  const std::optional<Value> value = object.optional("passes");
  if (!value) return {};
  std::vector<double> widths;
  if (value->json().is_array()) {
    for (const Value& each : value->array(1, max_passes)) {
      widths.push_back(each.number(width_range));
      if (widths.size() > 1 && !(widths.back() > widths[widths.size() - 2])) {
        each.refuse("wider than the pass before it");
      }
    }
    constexpr double same_width = 1e-6;  // mm; a cutting amount gives an irrational width
    if (!(std::abs(widths.back() - width) <= same_width)) {
      value->refuse("a list that ends with the job's width " + text(width) + " mm");
    }
    widths.back() = width;
    return widths;
  }
  const int count = value->integer(1, max_passes);
  for (int i = 1; i < count; ++i) widths.push_back(width * std::sqrt(double(i) / count));
  widths.push_back(width);
  return widths;
}

void read_motion(Object& object, chamfer::Job& job) {
  job.tool_axis = read_tool_axis(object);
  job.direction = object.choice("direction", directions, job.direction);
  job.start_angle = radians(object.number("start_angle", turn_range, 0));
  job.overlap = radians(object.number("overlap", between(0, 360, "degrees"), 5));
  job.pass_widths = read_passes(object, job.width);
  job.spring_pass = object.boolean("spring_pass", false);
  job.feed = object.number("feed", feed_range, 300) / 60;
  if (const std::optional<double> feed = object.optional_number("lead_in_feed", feed_range)) {
    job.lead_in_feed = *feed / 60;
  }
  job.feed_at = object.choice("feed_at", feed_points, job.feed_at);
  job.clearance = object.number("clearance", above(0, 1e5, "mm"), job.clearance);
  job.lead_radius = object.optional_number("lead_radius", radius_range);
  if (const std::optional<Value> end = object.optional("end_position")) {
    job.end_position = end->vector3(coordinate_range);
  }
}

/// true: by 10; a number: by that; false: none.
std::optional<int> read_block_numbers(Object& output) {
  const std::optional<Value> value = output.optional("block_numbers");
  if (!value) return std::nullopt;
  constexpr int usual_step = 10;
  if (!value->json().is_boolean()) return value->integer(1, 1000);
  return value->boolean() ? std::optional(usual_step) : std::nullopt;
}

/// One word or two, e.g. "G54", "G54.1 P12", "G505"; the writer knows which its control has.
std::string read_work_offset(Object& output, const std::string& otherwise) {
  const std::optional<Value> value = output.optional("work_offset");
  if (!value) return otherwise;
  const std::string& offset = value->string();
  const auto is_part = [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == ' ';
  };
  constexpr std::size_t longest = 16;
  if (offset.size() > longest || !std::ranges::all_of(offset, is_part)) {
    value->refuse("a work offset such as \"G54\"");
  }
  return offset;
}

void read_output(const Value& value, ChamferJob& result) {
  Object output(value);
  nc::Program& program = result.program;
  program.number = output.integer("program", 1, 99'999'999, program.number);
  program.dialect = output.choice("dialect", dialects, program.dialect);
  program.positioning = output.choice("positioning", positionings, program.positioning);
  program.kind = output.choice("type", program_kinds, program.kind);
  program.decimals = output.integer("decimals", 1, 6, program.decimals);
  program.work_offset = read_work_offset(output, program.work_offset);
  program.block_number_step = read_block_numbers(output);
  program.coolant = output.choice("coolant", coolants, program.coolant);
  program.tilted = output.choice("tilted", tilted_outputs, program.tilted);
  result.job.decimals = program.decimals;
  result.job.arcs = output.boolean("arcs", false);
  if (program.tilted == nc::TiltedOutput::WorkFrame) {
    const bool has_any_helix = program.dialect != nc::Dialect::Heidenhain;
    result.job.arc_frame =
        has_any_helix ? chamfer::ArcFrame::WorkFrame : chamfer::ArcFrame::WorkFrameXY;
  }
  result.job.control_point =
      output.choice("control_point", control_points, result.job.control_point);
  output.finish();
}

/// The hole is in the workpiece from then on: an inline one is added, or takes its namesake's
/// place.
std::string take_hole(geometry::Hole hole, geometry::Workpiece& workpiece) {
  if (hole.name.empty()) hole.name = "inline hole";
  const auto same = std::ranges::find(workpiece.holes, hole.name, &geometry::Hole::name);
  std::string name = hole.name;
  if (same == workpiece.holes.end()) {
    workpiece.holes.push_back(std::move(hole));
  } else {
    *same = std::move(hole);
  }
  return name;
}

void read_definitions(Object& object, const Definitions& definitions, ChamferJob& result) {
  ResolvedWorkpiece workpiece = resolve_workpiece(object.required("workpiece"), definitions);
  result.job.workpiece = std::move(workpiece.workpiece);
  result.workpiece_revision = workpiece.revision;
  result.material = std::move(workpiece.material);
  result.job.hole =
      take_hole(resolve_hole(object.required("hole"), result.job.workpiece), result.job.workpiece);
  ResolvedTool tool = resolve_tool(object.required("tool"), definitions);
  result.job.tool = std::move(tool.tool);
  result.tool_revision = tool.revision;
  result.tool_dynamics = std::move(tool.dynamics);
  if (result.job.tool.number == 0) {
    result.warnings.emplace_back("the tool has no number: the program does not call one");
  }
}

}  // namespace

std::string_view name(EdgeKind edge) {
  return name_of(edges, edge);
}
std::string_view name(Side side) {
  return name_of(sides, side);
}
std::string_view name(Method method) {
  return name_of(methods, method);
}
std::string_view name(Direction direction) {
  return name_of(directions, direction);
}

ChamferJob read_chamfer_job(const Value& value, const Definitions& definitions) {
  Object object(value);
  const Value kind = object.required("job");
  if (!kind.is_word("chamfer")) kind.refuse("\"chamfer\"");
  ChamferJob result;
  chamfer::Job& job = result.job;
  job.edge = object.required("edge").choice(edges);
  job.side = object.choice("side", sides, Side::Entry);
  job.width = read_width(object);
  job.tolerance = object.number("tolerance", tolerance_range, job.tolerance);
  job.section_angle = read_section_angle(object);
  job.method = object.choice("method", methods, job.method);
  if (const std::optional<Value> points = object.optional("points")) {
    job.points = points->integer(3, max_points);
  }
  read_motion(object, job);
  result.program.spindle_speed = object.number("spindle_speed", between(0, 1e6, "rev/min"), 8000);
  if (const std::optional<Value> output = object.optional("output")) read_output(*output, result);
  read_definitions(object, definitions, result);
  object.finish();

  result.program.tool_number = job.tool.number;
  result.program.length_offset = job.tool.length_offset;
  result.program.spindle_clockwise = job.tool.spindle == tool::SpindleSense::Clockwise;
  result.program.comments = comments_of(result);
  return result;
}

double width_limit(const ChamferJob& job) {
  constexpr double per_tolerance = 1.5;
  constexpr double per_step = 4;
  return std::max(per_tolerance * job.job.tolerance,
                  per_step * std::pow(10, -job.program.decimals));
}

}  // namespace ridgeline::jobs
