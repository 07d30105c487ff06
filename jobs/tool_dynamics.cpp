#include "jobs/tool_dynamics.hpp"

#include <cmath>
#include <numbers>

#include "core/base/angle.hpp"
#include "core/cutting/beam.hpp"
#include "core/cutting/modal_fit.hpp"
#include "jobs/predict_case.hpp"

namespace ridgeline::jobs {
namespace {

using cutting::BeamPart;
using std::numbers::pi;

// Material and clamping of a tool taken as a beam.
struct BeamMaterial {
  double modulus = 600e3;  // N/mm2, cemented carbide
  double density = 14500;  // kg/m3
  double damping = 0.02;   // of critical
  double holder = 0;       // N/mm, 0: rigid
  int modes = 2;
};

BeamMaterial read_beam(const Value& value) {
  Object object(value);
  BeamMaterial beam;
  beam.modulus = object.number("modulus", between(1e3, 1.3e6, "N/mm2"), beam.modulus);
  beam.density = object.number("density", between(500, 25000, "kg/m3"), beam.density);
  beam.damping = object.number("damping", between(1e-4, 0.5, "of critical damping"), beam.damping);
  beam.holder = object.number("holder_stiffness", between(1, 1e9, "N/mm"), beam.holder);
  beam.modes = object.integer("modes", 1, 6, beam.modes);
  object.finish();
  return beam;
}

// The shaft above the ball, from its centre to the holder, as far as it is described. Flutes carry
// load like a shaft of 0.8 of their radius.
std::vector<BeamPart> shaft(const tool::Tool& tool) {
  constexpr double fluted = 0.8;
  const double from = tool.radius;
  const double neck = tool.neck_radius.value_or(fluted * tool.radius);
  const double neck_end = tool.neck_length.value_or(from);
  const double end = tool.stickout.value_or(neck_end);
  std::vector<BeamPart> parts;
  if (neck_end > from) parts.push_back({neck, neck_end - from});
  if (end > neck_end) parts.push_back({tool.shank_radius.value_or(neck), end - neck_end});
  return parts;
}

cutting::Compliance beam_compliance(const tool::Tool& tool, const BeamMaterial& given,
                                    const std::string& pointer) {
  cutting::Beam beam;
  beam.parts = shaft(tool);
  if (beam.parts.empty()) {
    refuse({.field = pointer,
            .limit = "given: modes_x and modes_y, or a tool with neck_length or stickout",
            .message = "how the tool gives way is not known: give its dynamics with modes, or its "
                       "neck_length or stickout, from which a beam gives an estimate"});
  }
  beam.modulus = given.modulus;
  beam.density = given.density * 1e-12;  // kg/m3 to t/mm3
  beam.damping = given.damping;
  beam.holder_stiffness = given.holder;
  beam.tip_mass = beam.density * 4 / 3 * pi * std::pow(tool.radius, 3);
  const cutting::Modes modes = cutting::beam_modes(beam, given.modes).modes;
  return {modes, modes, Eigen::Matrix2d::Identity()};
}

cutting::Modes fitted(const Value& value, CuttingTool& out) {
  const cutting::ModalFit fit = cutting::fit_modes(read_measured_response(value));
  const double percent = std::round(1000 * fit.misfit) / 10;
  out.warnings.push_back("the modes fitted to " + value.pointer() + " miss it by " + text(percent) +
                         " % rms");
  return fit.modes;
}

// One direction: its own modes or measurement, else those of both.
std::optional<cutting::Modes> direction(Object& object, const std::string& axis, CuttingTool& out) {
  for (const std::string& suffix : {"_" + axis, std::string()}) {
    object.exclude("modes" + suffix, "frf" + suffix);
    if (const std::optional<Value> modes = object.optional("modes" + suffix)) {
      return read_mode_rows(*modes);
    }
    if (const std::optional<Value> measured = object.optional("frf" + suffix)) {
      return fitted(*measured, out);
    }
  }
  return {};
}

void read_compliance(Object& object, const tool::Tool& tool, CuttingTool& out) {
  const std::optional<cutting::Modes> x = direction(object, "x", out);
  const std::optional<cutting::Modes> y = direction(object, "y", out);
  const std::optional<Value> beam = object.optional("beam");
  if (x.has_value() != y.has_value()) {
    object.refuse(x ? "modes_y" : "modes_x", "given where the other direction is; [] is rigid");
  }
  if (x && beam) object.refuse("beam", "left out where modes are given");
  if (x) {
    out.compliance = {*x, *y, Eigen::Matrix2d::Identity()};
    out.source = out.warnings.empty() ? "modes" : "modes fitted to a measured response";
    return;
  }
  out.compliance =
      beam_compliance(tool, beam ? read_beam(*beam) : BeamMaterial{}, object.pointer());
  out.is_estimate = true;
  out.source = "estimate: a stepped beam from the tool's geometry; clamping and damping assumed";
}

// A tool that turns counter-clockwise is computed as its mirror image, whose helix is right-handed.
cutting::Cutter cutter_of(const tool::Tool& tool, int elements) {
  cutting::Cutter cutter;
  cutter.r = tool::cutting_radius(tool);
  cutter.pitch = cutting::equal_pitch(tool.flutes);
  cutter.helix =
      tool.spindle == tool::SpindleSense::Clockwise ? tool.helix_angle : std::abs(tool.helix_angle);
  cutter.elements = elements;
  if (tool.shape == tool::ToolShape::Lollipop) {
    constexpr double usual_neck = 0.5, widest = 0.95;
    const double neck = tool.neck_radius.value_or(usual_neck * cutter.r) / cutter.r;
    cutter.q_end = pi - std::asin(std::min(neck, widest));
    cutter.elements = static_cast<int>(std::ceil(elements * cutter.q_end / (pi / 2)));
  }
  return cutter;
}

void read_members(Object& object, const tool::Tool& tool, CuttingTool& out) {
  constexpr std::size_t longest = 400;
  read_compliance(object, tool, out);
  read_teeth(object, out.cutter);
  if (const std::optional<Value> source = object.optional("source")) {
    if (source->string().size() > longest) source->refuse("text of at most 400 bytes");
    out.source = (out.is_estimate ? "estimate: " : "") + source->string();
  }
  object.finish();
}

}  // namespace

void check_dynamics(const Value& value, const tool::Tool& tool) {
  constexpr int any = 16;
  cutting_tool(tool, value, any);
}

CuttingTool cutting_tool(const tool::Tool& tool, const Value& dynamics, int elements) {
  constexpr double steepest = radians(80);
  CuttingTool out;
  if (!(std::abs(tool.helix_angle) <= steepest)) {
    refuse({.field = "/tool/helix_angle",
            .value = text(degrees(tool.helix_angle)),
            .limit = "at most 80 degrees for a prediction"});
  }
  out.cutter = cutter_of(tool, elements);
  if (dynamics.json().is_null()) {
    out.compliance = beam_compliance(tool, {}, dynamics.pointer());
    out.is_estimate = true;
    out.source = "estimate: a stepped carbide beam from the tool's geometry, rigidly clamped";
  } else {
    Object object(dynamics);
    read_members(object, tool, out);
  }
  if (out.is_estimate) {
    out.warnings.emplace_back(
        "how the tool gives way is an estimate from its geometry: measure it before trusting a "
        "correction");
  }
  return out;
}

namespace {

nlohmann::json modes_document(const cutting::Direction& direction) {
  nlohmann::json rows = nlohmann::json::array();
  for (const cutting::Mode& mode : cutting::modes_of(direction)) {
    rows.push_back({mode.frequency, mode.damping, mode.stiffness});
  }
  return rows;
}

}  // namespace

nlohmann::json document_of(const CuttingTool& tool) {
  return {{"source", tool.source},
          {"estimate", tool.is_estimate},
          {"modes_x", modes_document(tool.compliance.x)},
          {"modes_y", modes_document(tool.compliance.y)}};
}

}  // namespace ridgeline::jobs
