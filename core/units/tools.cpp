#include "core/units/tools.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/units/figure.hpp"

namespace ridgeline::units {
namespace {

/// [mm/s] from the m/min of the catalogues.
constexpr double metres_per_minute(double v) {
  return v * 1000 / 60;
}

/// Turret places of the usual tools: what a program calls when nobody numbers them.
enum Place : int {
  RoughTurning = 1,
  FinishTurning = 2,
  RoughBoring = 3,
  FinishBoring = 4,
  Grooving = 5,
  Drilling = 6,
  Milling = 7,
  Countersinking = 8
};

ToolRow rough_turning() {
  return {.tool = "turning tool 80 deg R0.8",
          .number = RoughTurning,
          .nose_radius = 0.8,
          .pattern = "rough",
          .depth_of_cut = 2.5,
          .finish_allowance = 0.3,
          .cutting_speed = metres_per_minute(180),
          .feed_per_revolution = 0.3};
}

ToolRow finish_turning() {
  return {.tool = "turning tool 35 deg R0.4",
          .number = FinishTurning,
          .nose_radius = 0.4,
          .pattern = "finish",
          .depth_of_cut = 0.3,
          .cutting_speed = metres_per_minute(220),
          .feed_per_revolution = 0.12};
}

std::vector<ToolRow> boring() {
  ToolRow rough = rough_turning();
  rough.tool = "boring bar 80 deg R0.8";
  rough.number = RoughBoring;
  rough.depth_of_cut = 1.5;
  rough.cutting_speed = metres_per_minute(135);
  rough.feed_per_revolution = 0.2;
  ToolRow finish = finish_turning();
  finish.tool = "boring bar 35 deg R0.4";
  finish.number = FinishBoring;
  finish.cutting_speed = metres_per_minute(165);
  finish.feed_per_revolution = 0.1;
  return {rough, finish};
}

ToolRow grooving() {
  return {.tool = "grooving tool 2 mm R0.2",
          .number = Grooving,
          .nominal_diameter = 2,
          .nose_radius = 0.2,
          .pattern = "groove",
          .depth_of_cut = 1.5,
          .cutting_speed = metres_per_minute(100),
          .feed_per_revolution = 0.08};
}

std::vector<ToolRow> drilling(const Hole& hole) {
  const bool is_flat = hole.bottom == HoleBottom::Flat;
  std::vector<ToolRow> rows{{.tool = is_flat ? "flat drill" : "drill 118 deg",
                             .number = Drilling,
                             .nominal_diameter = hole.diameter,
                             .pattern = "drill",
                             .depth_of_cut = hole.diameter,
                             .cutting_speed = metres_per_minute(70),
                             .feed_per_revolution = std::min(0.3, 0.02 * hole.diameter)}};
  for (const HoleStep& step : hole.steps) {
    if (step.diameter <= hole.diameter + 1e-6) continue;
    const bool is_cone = step.diameter > step.end_diameter + 1e-6;
    rows.push_back({.tool = is_cone ? "countersink" : "counterbore mill",
                    .number = is_cone ? Countersinking : Milling,
                    .nominal_diameter = step.diameter,
                    .pattern = is_cone ? "countersink" : "counterbore",
                    .depth_of_cut = step.length,
                    .cutting_speed = metres_per_minute(60),
                    .feed_per_revolution = 0.1});
  }
  return rows;
}

/// Twice the area of an outline over its length: about the width of what is long and narrow, half
/// of that of a square.
double narrowness(const MilledFace& face) {
  std::vector<Eigen::Vector3d> points;
  for (const FaceEdge& edge : face.outline.front()) {
    points.push_back(edge.start);
    if (!edge.is_arc) continue;
    if ((edge.end - edge.start).norm() < 1e-9) {  // a whole circle
      const Eigen::Vector3d u = edge.start - edge.centre;
      const Eigen::Vector3d v = face.normal.cross(u);
      points.insert(points.end(), {edge.centre + v, edge.centre - u, edge.centre - v});
      continue;
    }
    const Eigen::Vector3d out = (edge.start + edge.end) / 2 - edge.centre;
    if (out.norm() > 1e-9) {
      points.push_back(edge.centre + (edge.start - edge.centre).norm() * out.normalized());
    }
  }
  Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();
  double length = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d a = points[i] - face.point;
    const Eigen::Vector3d b = points[(i + 1) % points.size()] - face.point;
    twice_area += a.cross(b);
    length += (b - a).norm();
  }
  return length > 0 ? 2 * (twice_area.norm() / 2) / length : 0;
}

/// The largest end mill of the usual steps that enters the plan.
ToolRow milling(const MilledFace& face) {
  double limit = 20;
  if (face.form == "pocket" && face.width <= 0 && !face.outline.empty()) {
    const double narrow = narrowness(face);
    if (narrow > 0) limit = std::min(limit, narrow);
  }
  if (face.corner_radius > 0) limit = std::min(limit, 2 * face.corner_radius);
  if (face.width > 0) limit = std::min(limit, face.width);
  double diameter = limit;
  for (const double usual : {20.0, 16.0, 12.0, 10.0, 8.0, 6.0, 5.0, 4.0, 3.0, 2.0}) {
    if (usual <= limit) {
      diameter = usual;
      break;
    }
  }
  return {.tool = "end mill",
          .number = Milling,
          .nominal_diameter = diameter,
          .pattern = "zigzag",
          .depth_of_cut = diameter / 2,
          .cutting_speed = metres_per_minute(120),
          .feed_per_revolution = 0.2};
}

}  // namespace

std::vector<ToolRow> usual_tools(const Unit& unit) {
  switch (unit.kind) {
    case UnitKind::FaceFront:
    case UnitKind::FaceBack:
    case UnitKind::BarOuter: return {rough_turning(), finish_turning()};
    case UnitKind::BarInner: return boring();
    case UnitKind::Groove: return {grooving()};
    case UnitKind::Hole: return unit.hole ? drilling(*unit.hole) : std::vector<ToolRow>{};
    case UnitKind::FaceMill:
      return unit.face ? std::vector<ToolRow>{milling(*unit.face)} : std::vector<ToolRow>{};
    case UnitKind::Unexplained: return {};
  }
  return {};
}

}  // namespace ridgeline::units
