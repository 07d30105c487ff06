#include "jobs/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/angle.hpp"
#include "jobs/contour.hpp"
#include "jobs/svg.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int cells = 220;  // of a contour grid: a cell is under two pixels of a view

// A plane of the drawing: origin and two unit vectors, work frame.
struct Sheet {
  Vector3d origin, right, up;
  Vector2d in(const Vector3d& p) const { return {(p - origin).dot(right), (p - origin).dot(up)}; }
  Vector3d out(const Vector2d& q) const { return origin + q.x() * right + q.y() * up; }
};

std::vector<Vector2d> projected(const Sheet& sheet, const std::vector<Vector3d>& points) {
  constexpr std::size_t most = 6000;  // more than pixels
  const std::size_t step = 1 + points.size() / most;
  std::vector<Vector2d> out;
  for (std::size_t i = 0; i < points.size(); i += step) out.push_back(sheet.in(points[i]));
  if (!out.empty()) out.push_back(out.front());
  return out;
}

void draw_section(Svg& svg, const View& view, const Sheet& sheet,
                  const geometry::Workpiece& workpiece) {
  const auto field = [&](const Vector2d& q) {
    return geometry::material_distance(workpiece, sheet.out(q));
  };
  auto curves = contours(field, view.model_min, view.model_max, cells);
  // Bodies are filled first, then the air inside them: counter-clockwise curves enclose material.
  const auto area = [](const std::vector<Vector2d>& c) {
    double twice = 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Vector2d& a = c[i];
      const Vector2d& b = c[(i + 1) % c.size()];
      twice += a.x() * b.y() - a.y() * b.x();
    }
    return twice / 2;
  };
  std::ranges::stable_sort(curves, std::greater{}, area);
  for (const auto& curve : curves) svg.polygon(view, curve, area(curve) > 0 ? "body" : "air");
}

double extent(const geometry::Workpiece& workpiece) {
  if (workpiece.shape == geometry::BodyShape::ManifoldBlock) return workpiece.size.maxCoeff() / 2;
  return workpiece.outer_radius;
}

View view_of(const Vector2d& centre, double half, const Vector2d& sheet_min,
             const Vector2d& sheet_max) {
  const Vector2d corner = Vector2d::Constant(half);
  return {.model_min = centre - corner,
          .model_max = centre + corner,
          .sheet_min = sheet_min,
          .sheet_max = sheet_max};
}

void draw_part(Svg& svg, const View& view, const Sheet& sheet, const chamfer::Job& job,
               const chamfer::Result& result) {
  draw_section(svg, view, sheet, job.workpiece);
  svg.polyline(view, projected(sheet, result.targets), "ridge");
  svg.polyline(view, projected(sheet, result.centres), "path");
  svg.circle(view, sheet.in(result.centres.front()), tool::cutting_radius(job.tool), "tool");
}

// Axis A2 and the foot of A1 with the eccentric distance f between them.
void draw_axes(Svg& svg, const View& view, const Sheet& sheet, const chamfer::Job& job, double f) {
  const double half = (view.model_max.y() - view.model_min.y()) / 2;
  svg.polyline(view, {{0, -half}, {0, half}}, "axis");
  svg.text(on_sheet(view, {0, half}) + Vector2d(4, 12), "A2", "symbol");
  const Vector2d A1 = sheet.in(job.workpiece.position);
  const Vector2d mark(half * 0.06, 0);
  svg.polyline(view, {A1 - mark, A1 + mark}, "outline");
  svg.polyline(view, {A1 - Vector2d(0, mark.x()), A1 + Vector2d(0, mark.x())}, "outline");
  svg.text(on_sheet(view, A1) + Vector2d(-8, 16), "A1", "symbol", Svg::Anchor::End);
  const Vector2d on_bore =
      A1 + job.workpiece.inner_radius * Vector2d(-std::numbers::sqrt2, -std::numbers::sqrt2) / 2;
  svg.polyline(view, {A1, on_bore}, "dimension");
  svg.text(on_sheet(view, (A1 + on_bore) / 2) + Vector2d(6, 12), "R1", "symbol");
  if (std::abs(f) > 1e-9) {
    svg.polyline(view, {{A1.x(), A1.y() - 2 * mark.x()}, {0, A1.y() - 2 * mark.x()}}, "dimension");
    svg.text(on_sheet(view, {A1.x() / 2, A1.y() - 2 * mark.x()}) + Vector2d(0, 14), "f", "symbol",
             Svg::Anchor::Middle);
  }
}

// The section at the start of the loop, in the plane VP: wedge, chamfer and ball.
void draw_detail(Svg& svg, const Vector2d& sheet_min, const Vector2d& sheet_max,
                 const chamfer::Job& job, const geometry::Edge& edge,
                 const chamfer::Result& result) {
  const geometry::RidgePoint ridge = geometry::ridge_at(edge, result.parameter.front());
  const Sheet sheet{.origin = result.targets.front(),
                    .right = geometry::direction_to_outer(edge.frame, ridge.e1),
                    .up = geometry::direction_to_outer(edge.frame, -ridge.e2)};
  const Vector2d G1 = sheet.in(result.G1.front());
  const Vector2d G2 = sheet.in(result.G2.front());
  const View view = view_of((G1 + G2) / 2, 2.2 * job.width, sheet_min, sheet_max);
  draw_section(svg, view, sheet, job.workpiece);

  const Vector2d C = sheet.in(result.centres.front());
  std::vector<Vector2d> band{G1, Vector2d::Zero(), G2};
  std::vector<Vector2d> ball;
  const double D = tool::cutting_radius(job.tool);
  const Vector2d d1 = G1 - C;
  const Vector2d d2 = G2 - C;
  const double from = std::atan2(d2.y(), d2.x());
  const double turn = std::remainder(std::atan2(d1.y(), d1.x()) - from, 2 * std::numbers::pi);
  for (int i = 1; i < 24; ++i) {
    const double a = from + turn * i / 24;
    band.emplace_back(C + D * Vector2d(std::cos(a), std::sin(a)));
  }
  for (int i = 0; i <= 48; ++i) {
    const double a = from + turn * (4.0 * i / 48 - 1.5);
    ball.emplace_back(C + D * Vector2d(std::cos(a), std::sin(a)));
  }
  svg.polygon(view, band, "band");
  svg.polyline(view, ball, "path");
  const auto label = [&](const Vector2d& p, const char* text, const Vector2d& shift) {
    svg.circle(view, p, job.width * 0.03, "outline");
    svg.text(on_sheet(view, p) + shift, text, "symbol");
  };
  label(G1, "G1", {6, -6});
  label(G2, "G2", {6, -6});
  label(Vector2d::Zero(), "P", {-16, -4});
  svg.text(sheet_min + Vector2d(0, 14), fmt::format("Section at P: W = {:.4g} mm", job.width),
           "title");
}

const geometry::Hole& hole_of(const chamfer::Job& job) {
  return *std::ranges::find(job.workpiece.holes, job.hole, &geometry::Hole::name);
}

void draw_table(Svg& svg, const Vector2d& at, const chamfer::Job& job, const geometry::Edge& edge,
                double f) {
  const geometry::Profile& profile = hole_of(job).profile;
  const Vector3d A1 = job.workpiece.axis;
  const double beta = std::asin(std::clamp(A1.dot(edge.frame.axes.col(2)), -1.0, 1.0));
  std::vector<std::string> rows{
      fmt::format("R1 = {:.6g} mm  bore radius", job.workpiece.inner_radius),
      fmt::format("R2 = {:.6g} mm  hole radius", profile.R2),
      fmt::format("f = {:.6g} mm  eccentric distance", f),
      fmt::format("β = {:.6g}°  penetration angle", degrees(beta)),
      fmt::format("D = {:.6g} mm  tool radius", tool::cutting_radius(job.tool)),
      fmt::format("W = {:.6g} mm  chamfer width", job.width)};
  if (job.workpiece.shape == geometry::BodyShape::ThickWalledCylinder) {
    rows.insert(rows.begin() + 1,
                fmt::format("RT = {:.6g} mm  outer radius", job.workpiece.outer_radius));
  }
  if (profile.straight_along > 0 || profile.straight_across > 0) {
    rows.push_back(fmt::format("straight parts {:.6g} mm along, {:.6g} mm across",
                               profile.straight_along, profile.straight_across));
  }
  double y = at.y();
  for (const std::string& row : rows) {
    svg.text({at.x(), y}, row);
    y += 19;
  }
}

}  // namespace

std::string chamfer_drawing(const chamfer::Job& job, const geometry::Edge& edge,
                            const chamfer::Result& result, const Progress& progress) {
  const auto& axes = edge.frame.axes;
  const Vector3d origin = edge.frame.origin;
  const Sheet across{.origin = origin, .right = axes.col(0), .up = axes.col(2)};
  const Sheet along{.origin = origin, .right = axes.col(1), .up = axes.col(2)};
  const Sheet above{.origin = result.targets.front(), .right = axes.col(0), .up = axes.col(1)};
  const double f = -across.in(job.workpiece.position).x();
  const double half = 1.12 * extent(job.workpiece) + std::abs(f) / 2;

  Svg svg(1060, 760, fmt::format("Chamfer of hole {} in {}", job.hole, job.workpiece.name));
  progress.at(0, "drawing");
  svg.text({20, 24}, "Section across the bore axis A1, through A2", "title");
  const View across_view = view_of({-f / 2, 0}, half, {20, 34}, {380, 394});
  draw_part(svg, across_view, across, job, result);
  draw_axes(svg, across_view, across, job, f);

  progress.at(0.3, "drawing");
  svg.text({410, 24}, "Section along A1, through A2", "title");
  draw_part(svg, view_of({0, 0}, half, {410, 34}, {770, 394}), along, job, result);

  progress.at(0.6, "drawing");
  svg.text({20, 420}, "Seen along A2: ridge and tool centre", "title");
  const Vector2d reach = geometry::half_extents(edge.profile);
  const View above_view = view_of(above.in(origin), 1.25 * reach.maxCoeff(), {20, 432}, {380, 740});
  svg.polyline(above_view, projected(above, result.targets), "ridge");
  svg.polyline(above_view, projected(above, result.centres), "path");
  svg.circle(above_view, above.in(result.centres.front()), tool::cutting_radius(job.tool), "tool");
  svg.circle(above_view, above.in(result.targets.front()), reach.maxCoeff() * 0.02, "band");
  svg.text(on_sheet(above_view, above.in(result.targets.front())) + Vector2d(8, 4), "start",
           "small");

  progress.at(0.8, "drawing");
  draw_detail(svg, {410, 406}, {740, 740}, job, edge, result);
  draw_table(svg, {785, 60}, job, edge, f);
  return std::move(svg).finish();
}

}  // namespace ridgeline::jobs
