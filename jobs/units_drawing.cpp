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
#include "jobs/units_figure.hpp"
#include "jobs/units_program.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector2d;
using units::Program;
using units::Unit;

constexpr double width = 1180;
constexpr double legend_width = 430;
constexpr double line_height = 19;

/// One rule for a unit, as its colour stands in light and dark.
std::string style_of(std::size_t i) {
  return fmt::format(
      ".unit{0} {{ fill: hsl({1},65%,52%); fill-opacity: 0.6; stroke: hsl({1},65%,38%); "
      "stroke-width: 1; }}\n",
      i + 1, hue_of_unit(i));
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

}  // namespace

std::string title_of(const Program& program) {
  return program.product.name.empty() ? "Machining units" : program.product.name;
}

std::string units_svg(const Program& program) {
  const double height = height_of(program);
  const View view = view_of(program, height);
  Svg svg(width, height, title_of(program));
  std::string styles = ".unit { font-size: 12px; }\n";
  for (std::size_t i = 0; i < program.units.size(); ++i) styles += style_of(i);
  svg.add_style(styles);
  svg.text({20, 24}, title_of(program) + ": half section, X up, Z to the right", "title");
  svg.area(view, half_section(program.stock), "outline");
  svg.area(view, half_section(program.product.shadow), "body");
  for (std::size_t i = 0; i < program.units.size(); ++i) {
    svg.area(view, half_section(program.units[i]), fmt::format("unit{}", i + 1));
  }
  const units::Box s = units::box(program.stock);
  svg.polyline(view, {{view.model_min.x(), 0}, {view.model_max.x(), 0}}, "axis");
  draw_split(svg, view, program, program.split.outer, "outer split");
  if (std::abs(program.split.inner - program.split.outer) > 1e-6) {
    draw_split(svg, view, program, program.split.inner, "inner split");
  }
  svg.text(on_sheet(view, {s.z0, 0}) + Vector2d(0, 16), fmt::format("Z {:.6g}", s.z0), "small");
  svg.text(on_sheet(view, {s.z1, 0}) + Vector2d(0, 16), fmt::format("Z {:.6g}", s.z1), "small",
           Svg::Anchor::End);
  draw_legend(svg, program);
  svg.text({20, height - 12}, volume_line(program), "small");
  return std::move(svg).finish();
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
      for (const units::ToolRow& row : unit.tools) {
        fmt::format_to(line, "       T{} {}: {}\n", row.number, row.pattern, row.tool);
      }
      for (const std::string& note : unit.notes) fmt::format_to(line, "       note: {}\n", note);
    }
  }
  for (const std::string& note : program.notes) fmt::format_to(line, "note: {}\n", note);
  for (const std::string& note : program.product.notes) fmt::format_to(line, "part: {}\n", note);
  out += volume_line(program) + "\n";
  return out;
}

}  // namespace ridgeline::jobs
