#include "jobs/units_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/units/figure.hpp"
#include "core/units/names.hpp"
#include "core/units/overlay.hpp"
#include "jobs/svg.hpp"
#include "jobs/text.hpp"
#include "jobs/units_program.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using units::Program;
using units::Segment;
using units::Unit;
using Loops = std::vector<std::vector<Vector2d>>;

constexpr double width = 1180;
constexpr double legend_width = 430;
constexpr double line_height = 19;
constexpr double chord_angle = 0.05;  // [rad]: of drawn arcs

/// Hues a golden angle apart: neighbours in the program never look alike. One rule for a unit, as
/// its colour stands in light and dark.
std::string style_of(std::size_t i) {
  const int hue = static_cast<int>(std::lround(std::fmod(static_cast<double>(i) * 137.508, 360)));
  return fmt::format(
      ".unit{0} {{ fill: hsl({1},65%,52%); fill-opacity: 0.6; stroke: hsl({1},65%,38%); "
      "stroke-width: 1; }}\n",
      i + 1, hue);
}

void add_points(std::vector<Vector2d>& points, const Segment& row) {
  points.emplace_back(row.start.z, row.start.r);
  if (!row.arc) return;
  const int n = std::clamp(
      static_cast<int>(std::ceil(units::length(row) / row.arc->radius / chord_angle)), 1, 200);
  for (int i = 1; i < n; ++i) {
    const units::Point p = units::point_at(row, static_cast<double>(i) / n);
    points.emplace_back(p.z, p.r);
  }
}

Loops loops_of(const units::Region& region) {
  Loops loops;
  for (const units::Contour& contour : units::contours(region)) {
    loops.emplace_back();
    for (const Segment& row : contour) add_points(loops.back(), row);
  }
  return loops;
}

/// A band of half width w about the line from p along d, turned into the half section about p's
/// polar angle.
Loops band(const Vector3d& p, const Vector3d& d, double length, double w) {
  const double r = std::hypot(p.x(), p.y());
  const Vector2d at(p.z(), r);
  const double outwards = r > 1e-9 ? (d.x() * p.x() + d.y() * p.y()) / r : 0;
  Vector2d way(d.z(), outwards);
  way = way.norm() > 1e-9 ? Vector2d(way.normalized()) : Vector2d(0, -1);
  const Vector2d side = w * Vector2d(-way.y(), way.x());
  const Vector2d end = at + length * way;
  return {{at + side, end + side, end - side, at - side}};
}

Loops loops_of(const Unit& unit) {
  if (unit.hole && units::is_empty(unit.region))
    return band(unit.hole->start, unit.hole->direction, unit.hole->depth, unit.hole->diameter / 2);
  if (unit.face) {
    const Vector3d& n = unit.face->normal;
    const double height = std::abs(n.dot(unit.face->point));
    const double z0 = unit.face->z0;
    const double z1 = unit.face->z1;
    if (std::abs(n.z()) < 0.5)
      return {{{z0, height},
               {z1, height},
               {z1, height + unit.face->depth},
               {z0, height + unit.face->depth}}};
    const double r = std::hypot(unit.face->point.x(), unit.face->point.y());
    const double w = std::max(unit.face->width / 2, 0.5);
    return band({r, 0, unit.face->point.z()}, n, unit.face->depth, w);
  }
  if (unit.remainder) {
    const units::Remainder& rest = *unit.remainder;
    return {{{rest.z0, rest.r0}, {rest.z1, rest.r0}, {rest.z1, rest.r1}, {rest.z0, rest.r1}}};
  }
  return loops_of(unit.region);
}

double height_of(const Program& program) {
  return std::max(420.0, 90 + line_height * static_cast<double>(program.units.size()));
}

View view_of(const Program& program, double height) {
  const units::Box s = units::box(program.stock);
  const double margin = 0.03 * std::max(s.r1, s.z1 - s.z0);
  return {.model_min = {s.z0 - margin, -margin},
          .model_max = {s.z1 + margin, s.r1 + margin},
          .sheet_min = {20, 40},
          .sheet_max = {width - legend_width - 20, height - 40}};
}

void draw_split(Svg& svg, const View& view, const Program& program, double z, const char* what) {
  const units::Box s = units::box(program.stock);
  if (z <= s.z0 || z >= s.z1) return;
  svg.polyline(view, {{z, 0}, {z, s.r1}}, "axis");
  svg.text(on_sheet(view, {z, 0}) + Vector2d(0, 30), what, "small", Svg::Anchor::Middle);
}

void draw_legend(Svg& svg, const Program& program) {
  double y = 52;
  const View swatch{.model_min = {0, 0},
                    .model_max = {1, 1},
                    .sheet_min = {0, 0},
                    .sheet_max = {1, 1},
                    .scale = View::Scale::Stretch};
  for (std::size_t i = 0; i < program.units.size(); ++i) {
    const Unit& unit = program.units[i];
    const double x = width - legend_width;
    const auto corner = [&](double dx, double dy) { return Vector2d(x + dx, 1 - (y - dy)); };
    svg.area(swatch, {{corner(0, -2), corner(14, -2), corner(14, 10), corner(0, 10)}},
             fmt::format("unit{}", i + 1));
    std::string label = unit_label(unit);
    label = shortened(label, 46);
    svg.text({x + 22, y}, fmt::format("P{} {}", unit.process, label), "label");
    svg.text({width - 12, y}, std::string(name(unit.state)), "small", Svg::Anchor::End);
    y += line_height;
  }
}

std::string volume_line(const Program& program) {
  const units::Volumes& v = program.volumes;
  const auto tidy = [](double x) { return std::abs(x) < 5e-4 ? 0 : x; };  // never -0.000
  return fmt::format(
      "stock {:.3f}  product {:.3f}  turned {:.3f}  units {:.3f}  overlap {:.3f} declared, {:.3f} "
      "undeclared  left {:.3f}  unexplained {:.3f} mm3",
      v.stock, v.product, v.turned, v.units, tidy(v.overlap_declared), tidy(v.overlap_undeclared),
      tidy(v.left), tidy(v.unexplained));
}

std::string title_of(const Program& program) {
  return program.product.name.empty() ? "Machining units" : program.product.name;
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string units_svg(const Program& program) {
  const double height = height_of(program);
  const View view = view_of(program, height);
  Svg svg(width, height, title_of(program));
  std::string styles = ".unit { font-size: 12px; }\n";
  for (std::size_t i = 0; i < program.units.size(); ++i) styles += style_of(i);
  svg.add_style(styles);
  svg.text({20, 24}, title_of(program) + ": half section, X up, Z to the right", "title");
  svg.area(view, loops_of(program.stock), "outline");
  svg.area(view, loops_of(program.product.shadow), "body");
  for (std::size_t i = 0; i < program.units.size(); ++i)
    svg.area(view, loops_of(program.units[i]), fmt::format("unit{}", i + 1));
  const units::Box s = units::box(program.stock);
  svg.polyline(view, {{view.model_min.x(), 0}, {view.model_max.x(), 0}}, "axis");
  draw_split(svg, view, program, program.split.outer, "outer split");
  if (std::abs(program.split.inner - program.split.outer) > 1e-6)
    draw_split(svg, view, program, program.split.inner, "inner split");
  svg.text(on_sheet(view, {s.z0, 0}) + Vector2d(0, 16), fmt::format("Z {:.6g}", s.z0), "small");
  svg.text(on_sheet(view, {s.z1, 0}) + Vector2d(0, 16), fmt::format("Z {:.6g}", s.z1), "small",
           Svg::Anchor::End);
  draw_legend(svg, program);
  svg.text({20, height - 12}, volume_line(program), "small");
  return std::move(svg).finish();
}

std::string units_html(const Program& program) {
  return "<!doctype html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>" +
         escaped(title_of(program)) + "</title></head>\n<body>\n" + units_svg(program) +
         "\n<pre>\n" + escaped(units_text(program)) + "</pre>\n</body>\n</html>\n";
}

std::string units_text(const Program& program) {
  std::string out = title_of(program) + "\n";
  const auto line = std::back_inserter(out);
  for (const int process : {1, 2}) {
    fmt::format_to(line, "process {} ({} spindle)\n", process, process == 1 ? "main" : "sub");
    for (const Unit& unit : program.units) {
      if (unit.process != process) continue;
      fmt::format_to(line, "  {}  {:.3f} mm3  {}\n", unit_label(unit), unit.volume,
                     name(unit.state));
      for (const units::ToolRow& row : unit.tools)
        fmt::format_to(line, "       T{} {}: {}\n", row.number, row.pattern, row.tool);
      for (const std::string& note : unit.notes) fmt::format_to(line, "       note: {}\n", note);
    }
  }
  for (const std::string& note : program.notes) fmt::format_to(line, "note: {}\n", note);
  for (const std::string& note : program.product.notes) fmt::format_to(line, "part: {}\n", note);
  out += volume_line(program) + "\n";
  return out;
}

}  // namespace ridgeline::jobs
