#include "jobs/definitions.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <set>

#include "core/base/angle.hpp"
#include "core/base/tolerance.hpp"
#include "jobs/limits.hpp"
#include "jobs/tool_dynamics.hpp"

namespace ridgeline::jobs {
namespace {

using geometry::BodyShape;
using geometry::Hole;
using geometry::Workpiece;
using tool::SpindleSense;
using tool::Tool;
using tool::ToolShape;

constexpr Choices<BodyShape, 2> body_shapes{{
    {"thick_walled_cylinder", BodyShape::ThickWalledCylinder},
    {"manifold_block", BodyShape::ManifoldBlock},
}};
enum class HoleShape { Circle, Elongated, RoundedRectangle };
constexpr Choices<HoleShape, 3> hole_shapes{{
    {"circle", HoleShape::Circle},
    {"elongated", HoleShape::Elongated},
    {"rounded_rectangle", HoleShape::RoundedRectangle},
}};
constexpr Choices<ToolShape, 2> tool_shapes{{
    {"ball", ToolShape::Ball},
    {"lollipop", ToolShape::Lollipop},
}};
constexpr Choices<SpindleSense, 2> spindle_senses{{
    {"cw", SpindleSense::Clockwise},
    {"ccw", SpindleSense::CounterClockwise},
}};

constexpr double max_penetration_angle = 80;  // design: chamfer.md section 1

/// An inline object may carry its kind, a library definition must: it has to be `kind`.
void check_kind(Object& object, std::string_view kind) {
  const std::optional<Value> value = object.optional("kind");
  if (value && !value->is_word(kind)) value->refuse("\"" + std::string(kind) + "\"");
}

std::string optional_name(Object& object, std::string_view key) {
  const std::optional<Value> value = object.optional(key);
  return value ? value->name() : std::string();
}

geometry::Profile read_profile(Object& object) {
  const HoleShape shape = object.required("shape").choice(hole_shapes);
  geometry::Profile profile;
  profile.R2 = object.number("radius", radius_range);
  if (shape != HoleShape::Circle) {
    profile.straight_along = object.number("straight_along", length_range);
  }
  if (shape == HoleShape::RoundedRectangle) {
    profile.straight_across = object.number("straight_across", length_range);
  }
  return profile;
}

/// Direction of A2: `axis`, or A2 against Z by the penetration angle, tilted towards A1 [0066].
Eigen::Vector3d read_hole_axis(Object& object, const Workpiece& body) {
  object.exclude("axis", "penetration_angle");
  if (const std::optional<Value> axis = object.optional("axis")) return axis->direction();
  const double beta = radians(object.number(
      "penetration_angle", inside(-max_penetration_angle, max_penetration_angle, "degrees"), 0));
  Eigen::Vector3d Z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d towards_A1 = body.axis - body.axis.dot(Z) * Z;
  constexpr double vertical = 1e-9;  // below it A1 has no horizontal direction to tilt towards
  if (towards_A1.norm() > vertical) {
    return std::cos(beta) * Z + std::sin(beta) * towards_A1.normalized();
  }
  if (beta != 0) {
    object.refuse("penetration_angle", "absent where A1 is vertical: give the hole's axis");
  }
  return Z;
}

/// Runs a check of the core on a hole: what it says of "/axis" is said of the hole's.
template <class Check>
auto at_hole(const Object& object, Check&& check) {
  try {
    return check();
  } catch (const Error& error) {
    ErrorDetails details = error.details();
    details.field = object.pointer() + details.field;
    throw Error(error.code(), error.what(), details);
  }
}

/// The position of a hole: where given, else at the eccentric distance from A1, else the
/// workpiece's. Given both, they must agree.
void read_hole_place(Object& object, const Workpiece& body, Hole& hole) {
  const std::optional<Value> position = object.optional("position");
  hole.position = position ? position->vector3(coordinate_range) : body.position;
  hole.eccentric_distance = object.optional_number("eccentric_distance", coordinate_range);
  const double f_of_positions =
      at_hole(object, [&] { return geometry::eccentric_distance(body, hole); });
  if (!hole.eccentric_distance) return;
  const double f = *hole.eccentric_distance;
  if (!position) {
    hole.position = geometry::position_of(body, hole.axis, f);
    return;
  }
  if (!(std::abs(f - f_of_positions) <= eccentricity_tolerance)) {
    refuse({.code = ErrorCode::InconsistentEccentricity,
            .field = object.pointer() + "/eccentric_distance",
            .value = text(f),
            .limit = text(f_of_positions) + " mm within 1e-6 mm, as the positions give it"});
  }
}

Eigen::Vector3d read_body_axis(Object& object) {
  object.exclude("axis", "arrangement_angle");
  if (const std::optional<Value> axis = object.optional("axis")) return axis->direction();
  const double alpha = radians(object.number("arrangement_angle", turn_range, 0));
  return {-std::sin(alpha), std::cos(alpha), 0};  // [0066]: counter-clockwise seen from +Z
}

void read_cylinder(Object& object, Workpiece& workpiece) {
  workpiece.inner_radius = object.number("inner_radius", radius_range);
  workpiece.outer_radius = object.number("outer_radius", radius_range);
  if (!(workpiece.outer_radius > workpiece.inner_radius)) {
    object.refuse("outer_radius",
                  "greater than inner_radius " + text(workpiece.inner_radius) + " mm");
  }
  workpiece.length = object.number("length", radius_range);
}

void read_block(Object& object, Workpiece& workpiece) {
  workpiece.inner_radius = object.number("bore_radius", radius_range);
  const Value size = object.required("size");
  workpiece.size = size.vector3(radius_range);
  workpiece.length = workpiece.size.y();
  const double D1 = 2 * workpiece.inner_radius;
  if (!(workpiece.size.x() > D1 && workpiece.size.z() > D1)) {
    size.refuse("wider and higher than the bore's " + text(D1) + " mm");
  }
}

void read_holes(Object& object, Workpiece& workpiece) {
  const std::optional<Value> holes = object.optional("holes");
  if (!holes) return;
  std::set<std::string> names;
  for (const Value& value : holes->array(0, max_holes)) {
    Hole hole = read_hole(value, workpiece);
    if (hole.name.empty()) Object(value).refuse("name", "given");
    if (!names.insert(hole.name).second) {
      Object(value).refuse("name", "another name than the holes before it");
    }
    workpiece.holes.push_back(std::move(hole));
  }
}

/// The parts of the body: what is given has to say where it begins and ends.
void read_tool_body(Object& object, Tool& tool) {
  tool.neck_radius = object.optional_number("neck_radius", radius_range);
  tool.neck_length = object.optional_number("neck_length", radius_range);
  tool.shank_radius = object.optional_number("shank_radius", radius_range);
  tool.stickout = object.optional_number("stickout", radius_range);
  tool.holder_radius = object.optional_number("holder_radius", radius_range);
  const std::string ball = "the ball's radius " + text(tool.radius) + " mm";
  if (tool.neck_radius && !(*tool.neck_radius <= tool.radius)) {
    object.refuse("neck_radius", "at most " + ball);
  }
  if (tool.shape == ToolShape::Lollipop && tool.neck_radius && *tool.neck_radius == tool.radius) {
    object.refuse("neck_radius", "less than " + ball);
  }
  if (tool.neck_length && !(*tool.neck_length >= tool.radius)) {
    object.refuse("neck_length", "at least " + ball);
  }
  if (tool.stickout && !(*tool.stickout >= tool.neck_length.value_or(tool.radius))) {
    object.refuse("stickout", "at least neck_length and radius");
  }
  if (tool.neck_radius && tool.shank_radius && !tool.neck_length) {
    object.refuse("neck_length", "given where neck and shank are: the shank begins there");
  }
  if (tool.holder_radius && !tool.stickout) {
    object.refuse("stickout", "given where the holder's radius is: the holder begins there");
  }
}

/// "; nearest: a, b" or "; the library has none", for the message of an unknown name.
std::string nearest_text(std::string_view wanted, std::vector<std::string> names) {
  if (names.empty()) return "there is none at all";
  std::string list;
  for (const std::string& name : nearest(wanted, std::move(names))) {
    list += (list.empty() ? "nearest: " : ", ") + shortened(name);
  }
  return list;
}

Definition find(const Value& value, ErrorCode code, std::string_view kind, const std::string& name,
                const Definitions& definitions) {
  std::optional<Definition> found = definitions.find(kind, name);
  if (found) return *std::move(found);
  const std::string exists = nearest_text(name, definitions.names(kind));
  refuse({.code = code,
          .field = value.pointer(),
          .value = name,
          .limit = "in the library; " + exists,
          .message = "the library has no " + std::string(kind) + " \"" + shortened(name) + "\"; " +
                     exists});
}

nlohmann::json dynamics_of(const nlohmann::json& tool) {
  return tool.value("dynamics", nlohmann::json(nullptr));
}

std::optional<std::string> material_of(const nlohmann::json& workpiece) {
  const auto found = workpiece.find("material");
  if (found == workpiece.end()) return std::nullopt;
  return found->get<std::string>();
}

}  // namespace

Hole read_hole(const Value& value, const Workpiece& body) {
  Object object(value);
  Hole hole;
  hole.name = optional_name(object, "name");
  hole.profile = read_profile(object);
  hole.axis = read_hole_axis(object, body);
  read_hole_place(object, body, hole);
  hole.depth = object.optional_number("depth", radius_range);
  hole.walls = object.integer("walls", 1, 2, hole.depth ? 1 : 2);
  if (hole.depth && hole.walls != 1) {
    object.refuse("walls", "1 where the hole has a depth: a blind hole ends in its first wall");
  }
  object.finish();
  return hole;
}

Workpiece read_workpiece(const Value& value) {
  Object object(value);
  check_kind(object, "workpiece");
  Workpiece workpiece;
  workpiece.name = optional_name(object, "name");
  workpiece.shape = object.required("shape").choice(body_shapes);
  if (const std::optional<Value> position = object.optional("position")) {
    workpiece.position = position->vector3(coordinate_range);
  }
  workpiece.axis = read_body_axis(object);
  if (workpiece.shape == BodyShape::ThickWalledCylinder) {
    read_cylinder(object, workpiece);
  } else {
    read_block(object, workpiece);
  }
  optional_name(object, "material");
  read_holes(object, workpiece);
  object.finish();
  return workpiece;
}

Tool read_tool(const Value& value) {
  Object object(value);
  check_kind(object, "tool");
  Tool tool;
  tool.number = object.integer("number", 1, max_tool_number, 0);
  tool.name = optional_name(object, "name");
  tool.shape = object.required("shape").choice(tool_shapes);
  tool.radius = object.number("radius", radius_range);
  tool.wear = object.number("wear", inside(-tool.radius, tool.radius, "mm"), 0);
  read_tool_body(object, tool);
  tool.flutes = object.integer("flutes", 1, 100, tool.flutes);
  tool.helix_angle = radians(object.number("helix_angle", inside(-90, 90, "degrees"), 0));
  tool.spindle = object.choice("spindle", spindle_senses, tool.spindle);
  tool.length_offset = object.integer("length_offset", 1, 999, 0);
  if (const std::optional<Value> dynamics = object.optional("dynamics")) {
    check_dynamics(*dynamics, tool);
  }
  object.finish();
  return tool;
}

ResolvedWorkpiece resolve_workpiece(const Value& value, const Definitions& definitions) {
  if (!value.json().is_string() && !value.json().is_object()) {
    value.refuse("a name of the library or a workpiece object");
  }
  if (value.json().is_object()) {
    return {read_workpiece(value), std::nullopt, material_of(value.json())};
  }
  const Definition found =
      find(value, ErrorCode::UnknownWorkpiece, "workpiece", value.string(), definitions);
  return {read_workpiece(Value(found.document, value.pointer())), found.revision,
          material_of(found.document)};
}

ResolvedTool resolve_tool(const Value& value, const Definitions& definitions) {
  if (value.json().is_object()) return {read_tool(value), std::nullopt, dynamics_of(value.json())};
  if (!value.json().is_string() && !value.json().is_number()) {
    value.refuse("a number or a name of the library, or a tool object");
  }
  const std::string name =
      value.json().is_string() ? value.string() : std::to_string(value.integer(1, max_tool_number));
  const Definition found = find(value, ErrorCode::UnknownTool, "tool", name, definitions);
  return {read_tool(Value(found.document, value.pointer())), found.revision,
          dynamics_of(found.document)};
}

Hole resolve_hole(const Value& value, const Workpiece& workpiece) {
  if (value.json().is_object()) return read_hole(value, workpiece);
  if (!value.json().is_string()) value.refuse("a name of the workpiece's holes or a hole object");
  const std::string& name = value.string();
  std::vector<std::string> names;
  for (const Hole& hole : workpiece.holes) {
    if (hole.name == name) return hole;
    names.push_back(hole.name);
  }
  const std::string exists = nearest_text(name, names);
  refuse({.code = ErrorCode::UnknownHole,
          .field = value.pointer(),
          .value = name,
          .limit = "a hole of the workpiece; " + exists,
          .message = "the workpiece has no hole \"" + shortened(name) + "\"; " + exists});
}

}  // namespace ridgeline::jobs
