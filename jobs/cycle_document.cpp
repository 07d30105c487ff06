#include <cmath>

#include "core/base/angle.hpp"
#include "core/macro/cycle_section.hpp"
#include "jobs/cycle_job.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Json = nlohmann::json;
using macro::Cycle;
using macro::CycleResult;
using macro::EdgeShape;
using macro::Family;

Json array_of(const Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}
Json array_of(const Vector2d& p) {
  return {p.x(), p.y()};
}

bool is_half_round(const Cycle& cycle) {
  return cycle.family == Family::HalfConvex || cycle.family == Family::HalfConcave;
}

Json edge_points(const Cycle& cycle, const CycleResult& result, const Progress& progress) {
  Json points = Json::array();
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    progress.step(i, result.points.size(), "answer");
    const macro::CyclePoint& point = result.points[i];
    Json each;
    each[cycle.edge == EdgeShape::Straight ? "x" : "angle_deg"] = point.along;
    each["param"] = point.station.param;
    each["contact"] = array_of(point.contact);
    each["normal"] = array_of(point.normal);
    each["tip"] = array_of(point.tip);
    if (cycle.edge != EdgeShape::Straight) each["tip_radius"] = point.tip_radius;
    points.push_back(std::move(each));
  }
  return points;
}

Json section_points(const Cycle& cycle, const CycleResult& result, const Progress& progress) {
  Json points = Json::array();
  for (std::size_t i = 0; i < result.stations.size(); ++i) {
    progress.step(i, result.stations.size(), "answer");
    const macro::Station& station = result.stations[i];
    Json each = {{"phi_deg", degrees(station.param)},
                 {"contact", array_of(station.contact)},
                 {"normal", array_of(station.normal)},
                 {"tip", array_of(station.tip)}};
    if (cycle.family == Family::HalfConcave) each["reachable"] = station.reachable;
    points.push_back(std::move(each));
  }
  return points;
}

Json helix_points(const Cycle& cycle, const CycleResult& result) {
  Json points = Json::array();
  for (const macro::HelixPoint& point : result.helix) {
    Json each = {{"j", point.index}, {"angle_deg", point.angle}};
    if (cycle.family == Family::HelicalCornerR) each["phi_deg"] = point.q;
    each["tip"] = array_of(point.tip);
    each["tip_radius"] = point.tip_radius;
    points.push_back(std::move(each));
  }
  return points;
}

Json points_of(const Cycle& cycle, const CycleResult& result, const Progress& progress) {
  Json points = Json::array();
  if (cycle.family == Family::Rotation) {
    for (const macro::RotatedPoint& point : result.rotated) {
      points.push_back({{"in", array_of(point.in)},
                        {"Z_rot", array_of(point.about_z)},
                        {"X_rot", array_of(point.about_x)},
                        {"Y_rot", array_of(point.about_y)}});
    }
    return points;
  }
  if (cycle.family == Family::Series) {
    for (const macro::SeriesValue& value : result.series) {
      points.push_back({{"angle_deg", value.angle},
                        {"sin", value.sine},
                        {"cos", value.cosine},
                        {"tan", value.tangent ? Json(*value.tangent) : Json(nullptr)}});
    }
    return points;
  }
  if (!result.offsets.empty()) {
    for (std::size_t i = 0; i < result.offsets.size(); ++i) {
      progress.step(i, result.offsets.size(), "answer");
      const macro::OffsetPass& pass = result.offsets[i];
      points.push_back(
          {{"param", pass.param}, {"z_tip", pass.z_tip}, {"comp_radius", pass.offset}});
    }
    return points;
  }
  if (!result.helix.empty()) return helix_points(cycle, result);
  return is_half_round(cycle) ? section_points(cycle, result, progress)
                              : edge_points(cycle, result, progress);
}

// The triangle of the guide's straight taper (1).
void add_triangle(const Cycle& cycle, const CycleResult& result, Json& document) {
  const macro::TaperTriangle triangle = macro::taper_triangle(cycle);
  const double y = cycle.y_pos, h = cycle.z_clear;
  document["b"] = triangle.b;
  document["c"] = triangle.c;
  document["A"] = {y - cycle.D / 2, h};
  document["B"] = {y + triangle.b, h};
  document["C"] = {y - cycle.D / 2, -triangle.c};
  const double t = radians(cycle.angle);
  document["bottom_contact"] = {y - cycle.r * (1 - std::sin(t)),
                                -triangle.c + cycle.r * (1 - std::cos(t))};
  document["overrun_below_edge"] =
      -cycle.width * std::tan(t) + triangle.c - cycle.r * (1 - std::cos(t));
  const std::size_t n = result.passes.size();
  if (n >= 2) document["x_last"] = {result.passes[n - 2], result.passes[n - 1]};
}

void add_arc(const Cycle& cycle, Json& document) {
  const double a = macro::core_radius(cycle), r = cycle.r, R = cycle.R, y = cycle.y_pos;
  Json arc = {{"plane", "G19"}};
  if (cycle.family == Family::CornerR) {
    arc.update({{"centre", {y + R - a, -R - r}},
                {"radius", R + r},
                {"start", {y + R - a, 0.0}},
                {"end", {y - cycle.D / 2, -R - r}},
                {"sense", "ccw"}});
  } else {
    const double z = -cycle.depth + R - r;
    arc.update({{"centre", {y - R - a, z}},
                {"radius", R - r},
                {"start", {y - cycle.D / 2, z}},
                {"end", {y - R - a, -cycle.depth}},
                {"sense", "cw"}});
  }
  document["tip_path_arc"] = std::move(arc);
}

void add_half_round(const Cycle& cycle, Json& document) {
  const double R = cycle.R, r = cycle.r, a = macro::core_radius(cycle);
  if (cycle.family == Family::HalfConvex) {
    const double q0 = macro::half_round_limit(cycle);
    document["phi_limit_deg"] = degrees(q0);
    document["unreached_height_above_floor"] = R * std::cos(q0) - R - cycle.z_floor.value_or(-R);
  } else {
    document["reach_from_deg"] = degrees(macro::groove_reach(cycle));
    document["bottom_rest_for_bull"] = R - r - std::sqrt((R - r) * (R - r) - a * a);
  }
}

// Method 1 passes at places along the edge, method 2 once a station.
void add_counts(const Cycle& cycle, const CycleResult& result, Json& document) {
  const bool is_helix =
      cycle.family == Family::HelicalSide || cycle.family == Family::HelicalCornerR;
  if (!result.passes.empty()) {
    document["passes"] = result.passes.size();
  } else if (!is_helix && !result.stations.empty()) {
    document["passes"] = result.stations.size();
  }
  if (cycle.family == Family::HelicalSide) document["turns"] = cycle.depth / cycle.turn_pitch;
  if (cycle.family == Family::HelicalCornerR) document["turns"] = 90 / cycle.turn_step;
  if (cycle.family == Family::Taper) {
    document["slope_length"] = cycle.width / std::cos(radians(cycle.angle));
  }
}

}  // namespace

Json cycle_document(const Cycle& cycle, const CycleResult& result, const Progress& progress) {
  Json document;
  document["points"] = points_of(cycle, result, progress);
  document["stations"] = result.stations.size();
  add_counts(cycle, result, document);
  if (cycle.family != Family::Rotation && cycle.family != Family::Series) {
    document["cusp"] = result.cusp;
  }
  if (cycle.family == Family::Taper) {
    const bool is_circle_pass = cycle.method == 1 && cycle.edge != EdgeShape::Straight;
    if (is_circle_pass) {
      document["cusp_leading_order_at_lower_edge"] = macro::lower_edge_cusp(cycle);
    } else {
      document["cusp_normal"] = result.cusp;
    }
    if (cycle.method == 1 && cycle.edge == EdgeShape::Straight) {
      add_triangle(cycle, result, document);
    }
  }
  const bool has_arc = (cycle.family == Family::CornerR || cycle.family == Family::BottomR) &&
                       cycle.edge == EdgeShape::Straight;
  if (has_arc) add_arc(cycle, document);
  if (is_half_round(cycle)) add_half_round(cycle, document);
  if (!result.warnings.empty()) document["warnings"] = result.warnings;
  return document;
}

}  // namespace ridgeline::jobs
