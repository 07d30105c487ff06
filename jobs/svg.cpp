#include "jobs/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace ridgeline::jobs {
namespace {

using Eigen::Vector2d;

// Plain values, no CSS variables: other programs than browsers read these files too.
constexpr std::string_view style_sheet = R"(
  text { font: 13px system-ui, sans-serif; fill: #1b1f24; }
  .title { font-size: 15px; font-weight: 600; }
  .small { font-size: 11px; fill: #8a929c; }
  .symbol { font-style: italic; font-weight: 600; }
  .sheet { fill: #ffffff; }
  .body { stroke-width: 1.2; fill: #d9dee5; stroke: #1b1f24; }
  .air { stroke-width: 1.2; fill: #ffffff; stroke: #1b1f24; }
  .outline { fill: none; stroke-width: 1.2; stroke: #1b1f24; }
  .axis { fill: none; stroke-width: 0.8; stroke-dasharray: 12 3 2 3; stroke: #8a929c; }
  .dimension { fill: none; stroke-width: 0.9; stroke: #8a929c; }
  .ridge { fill: none; stroke-width: 2; stroke: #c2410c; }
  .path { fill: none; stroke-width: 1.6; stroke: #1d4ed8; }
  .band { fill-opacity: 0.35; stroke-width: 1.4; fill: #c2410c; stroke: #c2410c; }
  .tool { fill-opacity: 0.18; stroke-width: 1.4; fill: #0f766e; stroke: #0f766e; }
  .grid { stroke-width: 0.4; stroke: #8a929c; }
  @media (prefers-color-scheme: dark) {
    text { fill: #e6e9ee; }
    .small { fill: #7d8691; }
    .sheet { fill: #14171b; }
    .body { fill: #2d343d; stroke: #e6e9ee; }
    .air { fill: #14171b; stroke: #e6e9ee; }
    .outline { stroke: #e6e9ee; }
    .axis { stroke: #7d8691; }
    .dimension { stroke: #7d8691; }
    .ridge { stroke: #fb923c; }
    .path { stroke: #7aa2ff; }
    .band { fill: #fb923c; stroke: #fb923c; }
    .tool { fill: #5eead4; stroke: #5eead4; }
    .grid { stroke: #7d8691; }
  }
)";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

/// A step of 1, 2 or 5 times a power of ten that gives about `wanted` ticks over the span.
double tick_step(double span, double wanted) {
  const double raw = span / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double ratio = raw / power;
  return power * (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10);
}

/// A tick value with just the decimals that its step needs.
std::string tick_label(double value, double step) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return fmt::format("{:.{}f}", std::abs(value) < step * 1e-6 ? 0.0 : value, decimals);
}

struct Range {
  double low = 0, high = 1;
};

Range range_of(const std::vector<Series>& series, Eigen::Index coordinate) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Series& one : series) {
    for (const Vector2d& p : one.points) {
      range.low = std::min(range.low, p[coordinate]);
      range.high = std::max(range.high, p[coordinate]);
    }
  }
  if (!(range.low <= range.high)) return {0, 1};
  const double least = std::max(1e-9, 1e-6 * std::abs(range.high));
  const double margin = std::max(0.0, (least - (range.high - range.low)) / 2);
  return {range.low - margin, range.high + margin};
}

}  // namespace

Vector2d on_sheet(const View& view, const Vector2d& model) {
  const Vector2d model_size = view.model_max - view.model_min;
  const Vector2d sheet_size = view.sheet_max - view.sheet_min;
  Vector2d scale = sheet_size.cwiseQuotient(model_size);
  if (view.scale == View::Scale::Proportional) scale.setConstant(scale.minCoeff());
  const Vector2d middle = (view.sheet_min + view.sheet_max) / 2;
  const Vector2d offset = (model - (view.model_min + view.model_max) / 2).cwiseProduct(scale);
  return {middle.x() + offset.x(), middle.y() - offset.y()};
}

Svg::Svg(double width, double height, std::string_view title)
    : out_(fmt::format(
          "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
          "height=\"{1:g}\" role=\"img\">\n<title>{2}</title>\n<style>{3}</style>\n"
          "<rect class=\"sheet\" width=\"{0:g}\" height=\"{1:g}\"/>\n",
          width, height, escaped(title), style_sheet)) {}

void Svg::points(const View& view, const std::vector<Vector2d>& points) {
  for (const Vector2d& p : points) {
    const Vector2d at = on_sheet(view, p);
    fmt::format_to(std::back_inserter(out_), "{:.2f},{:.2f} ", at.x(), at.y());
  }
}

void Svg::polyline(const View& view, const std::vector<Vector2d>& line, std::string_view style) {
  fmt::format_to(std::back_inserter(out_), "<polyline class=\"{}\" points=\"", style);
  points(view, line);
  out_ += "\"/>\n";
}

void Svg::polygon(const View& view, const std::vector<Vector2d>& line, std::string_view style) {
  fmt::format_to(std::back_inserter(out_), "<polygon class=\"{}\" points=\"", style);
  points(view, line);
  out_ += "\"/>\n";
}

void Svg::area(const View& view, const std::vector<std::vector<Vector2d>>& loops,
               std::string_view style) {
  fmt::format_to(std::back_inserter(out_), "<path class=\"{}\" fill-rule=\"evenodd\" d=\"", style);
  for (const std::vector<Vector2d>& loop : loops) {
    out_ += "M";
    points(view, loop);
    out_ += "Z ";
  }
  out_ += "\"/>\n";
}

void Svg::add_style(std::string_view css) {
  out_ += fmt::format("<style>{}</style>\n", css);
}

void Svg::circle(const View& view, const Vector2d& centre, double radius, std::string_view style) {
  const Vector2d at = on_sheet(view, centre);
  const double pixels = std::abs(on_sheet(view, centre + Vector2d(radius, 0)).x() - at.x());
  fmt::format_to(std::back_inserter(out_),
                 "<circle class=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", style, at.x(),
                 at.y(), pixels);
}

void Svg::line(const Vector2d& from, const Vector2d& to, std::string_view style) {
  fmt::format_to(std::back_inserter(out_),
                 "<line class=\"{}\" x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\"/>\n",
                 style, from.x(), from.y(), to.x(), to.y());
}

void Svg::text(const Vector2d& at, std::string_view text, std::string_view style, Anchor anchor) {
  constexpr std::array<std::string_view, 3> anchors{"start", "middle", "end"};
  fmt::format_to(std::back_inserter(out_),
                 "<text class=\"{}\" x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\">{}</text>\n",
                 style, at.x(), at.y(), anchors[static_cast<std::size_t>(anchor)], escaped(text));
}

std::string Svg::finish() && {
  out_ += "</svg>\n";
  return std::move(out_);
}

void draw(Svg& svg, const Chart& chart) {
  const Range x = range_of(chart.series, 0);
  const Range y = range_of(chart.series, 1);
  const View view{.model_min = {x.low, y.low},
                  .model_max = {x.high, y.high},
                  .sheet_min = chart.sheet_min + Vector2d(64, 26),
                  .sheet_max = chart.sheet_max - Vector2d(12, 40),
                  .scale = View::Scale::Stretch};
  svg.text(chart.sheet_min + Vector2d(0, 14), chart.title, "title");

  const double x_step = tick_step(x.high - x.low, 8);
  for (double tick = std::ceil(x.low / x_step - 1e-9) * x_step; tick <= x.high + 1e-9 * x_step;
       tick += x_step) {
    const Vector2d foot = on_sheet(view, {tick, y.low});
    svg.line(foot, {foot.x(), view.sheet_min.y()}, "grid");
    svg.text(foot + Vector2d(0, 14), tick_label(tick, x_step), "small", Svg::Anchor::Middle);
  }
  const double y_step = tick_step(y.high - y.low, 5);
  for (double tick = std::ceil(y.low / y_step - 1e-9) * y_step; tick <= y.high + 1e-9 * y_step;
       tick += y_step) {
    const Vector2d foot = on_sheet(view, {x.low, tick});
    svg.line(foot, {view.sheet_max.x(), foot.y()}, "grid");
    svg.text(foot + Vector2d(-6, 4), tick_label(tick, y_step), "small", Svg::Anchor::End);
  }
  svg.text({(view.sheet_min.x() + view.sheet_max.x()) / 2, chart.sheet_max.y() - 8}, chart.x_title,
           "small", Svg::Anchor::Middle);
  svg.text(chart.sheet_min + Vector2d(0, 24 + 8), chart.y_title, "small");

  double legend = view.sheet_max.x();
  for (const Series& one : chart.series) {
    svg.polyline(view, one.points, one.style);
    if (chart.series.size() < 2 || one.name.empty()) continue;
    svg.text({legend, chart.sheet_min.y() + 14}, one.name, "small", Svg::Anchor::End);
    legend -= 8.0 * static_cast<double>(one.name.size()) + 40;
    svg.line({legend + 14, chart.sheet_min.y() + 10}, {legend + 34, chart.sheet_min.y() + 10},
             one.style);
  }
}

}  // namespace ridgeline::jobs
