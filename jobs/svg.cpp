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

constexpr std::string_view style_sheet = R"(
  :root { --ink: #1b1f24; --paper: #ffffff; --soft: #8a929c; --body: #d9dee5; --cut: #c2410c;
          --path: #1d4ed8; --tool: #0f766e; }
  @media (prefers-color-scheme: dark) {
    :root { --ink: #e6e9ee; --paper: #14171b; --soft: #7d8691; --body: #2d343d; --cut: #fb923c;
            --path: #7aa2ff; --tool: #5eead4; } }
  text { font: 13px system-ui, sans-serif; fill: var(--ink); }
  .title { font-size: 15px; font-weight: 600; } .small { font-size: 11px; fill: var(--soft); }
  .symbol { font-style: italic; font-weight: 600; }
  .sheet { fill: var(--paper); } .body { fill: var(--body); stroke: var(--ink); stroke-width: 1.2; }
  .air { fill: var(--paper); stroke: var(--ink); stroke-width: 1.2; }
  .outline { fill: none; stroke: var(--ink); stroke-width: 1.2; }
  .hidden { fill: none; stroke: var(--ink); stroke-width: 0.9; stroke-dasharray: 5 3; }
  .axis { fill: none; stroke: var(--soft); stroke-width: 0.8; stroke-dasharray: 12 3 2 3; }
  .dimension { fill: none; stroke: var(--soft); stroke-width: 0.9; }
  .ridge { fill: none; stroke: var(--cut); stroke-width: 2; }
  .path { fill: none; stroke: var(--path); stroke-width: 1.6; }
  .band { fill: var(--cut); fill-opacity: 0.35; stroke: var(--cut); stroke-width: 1.4; }
  .tool { fill: var(--tool); fill-opacity: 0.18; stroke: var(--tool); stroke-width: 1.4; }
  .grid { stroke: var(--soft); stroke-width: 0.4; } .frame { fill: none; stroke: var(--soft); }
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

Svg::Svg(double width, double height, std::string_view title) {
  out_ = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" "
      "height=\"{1:g}\" role=\"img\">\n<title>{2}</title>\n<style>{3}</style>\n"
      "<rect class=\"sheet\" width=\"{0:g}\" height=\"{1:g}\"/>\n",
      width, height, escaped(title), style_sheet);
}

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
    if (chart.series.size() < 2) continue;
    svg.text({legend, chart.sheet_min.y() + 14}, one.name, "small", Svg::Anchor::End);
    legend -= 8.0 * static_cast<double>(one.name.size()) + 40;
    svg.line({legend + 14, chart.sheet_min.y() + 10}, {legend + 34, chart.sheet_min.y() + 10},
             one.style);
  }
}

}  // namespace ridgeline::jobs
