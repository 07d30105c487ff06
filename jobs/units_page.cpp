#include "jobs/units_page.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units/region.hpp"
#include "jobs/page.hpp"
#include "jobs/units_drawing.hpp"
#include "jobs/units_figure.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;
using units::FaceEdge;
using units::Program;
using units::Unit;

constexpr double chord_angle = 0.1;  // [rad]: of drawn arcs

Json loops_document(const Loops& loops) {
  Json list = Json::array();
  for (const std::vector<Eigen::Vector2d>& loop : loops) {
    std::vector<Vector3d> points;
    points.reserve(loop.size());
    for (const Eigen::Vector2d& p : loop) points.emplace_back(p.x(), p.y(), 0);
    list.push_back(page_points(points));
  }
  return list;
}

/// The row of a face's outline after its start; arcs are seen against the normal.
void add_points(std::vector<Vector3d>& points, const FaceEdge& row, const Vector3d& normal) {
  points.push_back(row.start);
  if (!row.is_arc) return;
  const Vector3d from = row.start - row.centre;
  const Vector3d to = row.end - row.centre;
  double turn = std::atan2(normal.dot(from.cross(to)), from.dot(to));
  if (row.is_clockwise) turn = -turn;
  if (turn < 1e-9) turn += 2 * std::numbers::pi;  // its ends coincide: a whole turn
  const int n = static_cast<int>(std::ceil(turn / chord_angle));
  for (int i = 1; i < n; ++i) {
    const double angle = (row.is_clockwise ? -turn : turn) * i / n;
    points.emplace_back(row.centre + Eigen::AngleAxisd(angle, normal) * from);
  }
}

/// A unit that is no solid of revolution, in space; null: it is one.
Json solid_of(const Unit& unit) {
  if (unit.hole) return "hole";
  if (!unit.face) return nullptr;
  Json outline = Json::array();
  for (const std::vector<FaceEdge>& loop : unit.face->outline) {
    std::vector<Vector3d> points;
    for (const FaceEdge& row : loop) add_points(points, row, unit.face->normal);
    outline.push_back(page_points(points));
  }
  return outline;
}

Json unit_data(const Unit& unit, std::size_t place, Json document) {
  for (const char* bulk : {"shape", "region", "core"}) document.erase(bulk);
  document["label"] = unit_label(unit);
  document["hue"] = hue_of_unit(place);
  document["section"] = loops_document(half_section(unit));
  document["solid"] = solid_of(unit);
  return document;
}

Json report_rows(const Json& document) {
  return page_rows(document, {{"volumes/stock", "stock", "mm\xC2\xB3"},
                              {"volumes/product", "product", "mm\xC2\xB3"},
                              {"volumes/turned", "to turn", "mm\xC2\xB3"},
                              {"volumes/units", "all units", "mm\xC2\xB3"},
                              {"volumes/overlap_declared", "overlap asked for", "mm\xC2\xB3"},
                              {"volumes/overlap_undeclared", "other overlap", "mm\xC2\xB3"},
                              {"volumes/left", "left by every unit", "mm\xC2\xB3"},
                              {"volumes/unexplained", "not explained", "mm\xC2\xB3"},
                              {"revision", "edits since it was planned", ""}});
}

Json warnings_of(const Program& program) {
  Json list = program.notes;
  for (const std::string& note : program.product.notes) list.push_back("part: " + note);
  return list;
}

}  // namespace

std::string units_page(const UnitsProgram& whole, const Json& document) {
  const Program& program = whole.program;
  const units::Box box = units::box(program.stock);
  Json list = Json::array();
  for (std::size_t i = 0; i < program.units.size(); ++i) {
    list.push_back(unit_data(program.units[i], i, document.at("units")[i]));
  }
  const Json splits = {{{"z", program.split.outer}, {"name", "outer split"}},
                       {{"z", program.split.inner}, {"name", "inner split"}}};
  return page(
      {{"job", "units"},
       {"title", title_of(program)},
       {"subtitle", fmt::format("{} machining units from stock X {:.6g}, Z {:.6g} to {:.6g}",
                                list.size(), box.r1, box.z0, box.z1)},
       {"units",
        {{"box", {{"z0", box.z0}, {"z1", box.z1}, {"r1", box.r1}}},
         {"stock", loops_document(half_section(program.stock))},
         {"product", loops_document(half_section(program.product.shadow))},
         {"splits", splits},
         {"list", std::move(list)}}},
       {"report", report_rows(document)},
       {"warnings", warnings_of(program)}});
}

}  // namespace ridgeline::jobs
