#include "core/verify/band.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/verify/extreme.hpp"

namespace ridgeline::verify {
namespace {

using geometry::Edge;
using geometry::Foot;
using geometry::RidgePoint;

constexpr int root_steps = 60;
constexpr double root_settled = 1e-13;   ///< [mm] step along the border curve
constexpr double curve_settled = 1e-12;  ///< [mm] distance of a curve point from its surface
constexpr double search_factor = 2;      ///< of the farthest that a chamfer of the width reaches
constexpr double peak_worth = 1e-9;      ///< [mm] of width
constexpr int marches = 16;              ///< fewest steps over the search range

struct CurvePoint {
  Eigen::Vector3d p;
  Eigen::Vector3d tangent;  ///< by the curve's parameter
};

/// The section of a surface with VP: from P along `along`, at each parameter as far along `across`
/// as the surface's distance `surface` asks for (Newton; nullopt where it turns away).
template <typename Surface>
class SectionCurve {
public:
  SectionCurve(const Eigen::Vector3d& P, const Eigen::Vector3d& along,
               const Eigen::Vector3d& across, Surface surface)
      : P_(P), along_(along), across_(across), surface_(surface) {}

  std::optional<CurvePoint> operator()(double T) const {
    double S = S_;
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < root_steps; ++i) {
      const Eigen::Vector3d p = P_ + T * along_ + S * across_;
      const auto [value, gradient] = surface_(p);
      const double slope = gradient.dot(across_);
      if (!(std::abs(slope) > 0.05)) return std::nullopt;  // the curve turns back
      const double residual = std::abs(value);
      // Far from the origin rounding alone exceeds curve_settled: then the residual stops falling.
      if (residual < curve_settled || (residual < 1e-9 && residual >= before)) {
        S_ = S;
        return CurvePoint{.p = p, .tangent = along_ - across_ * (gradient.dot(along_) / slope)};
      }
      before = residual;
      S -= value / slope;
    }
    return std::nullopt;
  }

private:
  Eigen::Vector3d P_, along_, across_;
  Surface surface_;
  mutable double S_ = 0;  // of the last point: the next is near
};

struct ValueAndGradient {
  double value;
  Eigen::Vector3d gradient;
};

/// Farthest that G1 or G2 of a chamfer of width W lies from P, by the sine rule in the wedge.
double reach(double W, double theta) {
  return theta < std::numbers::pi / 2 ? W / std::sin(theta) : W;
}

}  // namespace

Band::Band(const Edge& edge, const geometry::Trace& path, double D, double width)
    : edge_(edge), path_(path), D_(D), width_(width) {}

Foot Band::foot(const Eigen::Vector3d& p) const {
  Foot found = path_.nearest(geometry::to_outer(edge_.frame, p), hint_);
  hint_ = found.piece;
  return found;
}

// f(T) = distance of the curve at T to the path, less D: negative at the ridge. March outward to
// the first sign change, then Newton inside the bracket.
template <typename Curve>
Band::Border Band::border(const Curve& curve, double range) const {
  struct Sample {
    CurvePoint c;
    double f, slope;
  };
  const auto sample = [&](double T) -> std::optional<Sample> {
    const std::optional<CurvePoint> c = curve(T);
    if (!c) return std::nullopt;
    const Foot near = foot(c->p);
    const Eigen::Vector3d away = c->p - geometry::to_local(edge_.frame, near.point);
    return Sample{*c, near.distance - D_, away.dot(c->tangent) / near.distance};
  };
  double low = 0;
  std::optional<Sample> here = sample(0);
  if (!here) return {.G = {}, .open = true};
  Eigen::Vector3d last = here->c.p;
  double high = 0;
  while (true) {
    const double step = std::max(range / marches, -0.9 * here->f);
    high = std::min(range, low + step);
    here = sample(high);
    if (!here) return {.G = last, .open = true};
    last = here->c.p;
    if (here->f >= 0) break;
    if (high >= range) return {.G = last, .open = true};
    low = high;
  }
  double T = high;
  for (int i = 0; i < root_steps; ++i) {
    const double newton = T - here->f / here->slope;
    const double next = newton > low && newton < high ? newton : (low + high) / 2;
    const double moved = std::abs(next - T);
    T = next;
    here = sample(T);
    if (!here) return {.G = last, .open = true};
    last = here->c.p;
    (here->f < 0 ? low : high) = T;
    if (moved < root_settled || here->f == 0) break;
  }
  return {.G = last, .open = false};
}

BandSection Band::at(double u) const {
  const RidgePoint ridge = geometry::ridge_at(edge_, u);
  BandSection section;
  section.u = u;
  section.P = section.G1 = section.G2 = ridge.P;
  section.t = ridge.t;
  if (!(foot(ridge.P).distance < D_)) return section;
  section.cut = true;
  const double range = search_factor * reach(width_, ridge.theta);
  const Eigen::Vector3d along_body = (ridge.e1 - ridge.e1.dot(ridge.n1) * ridge.n1).normalized();
  const auto body = [this](const Eigen::Vector3d& p) {
    const geometry::SurfaceDistance d = geometry::signed_distance(edge_.body, p);
    return ValueAndGradient{d.value, d.gradient};
  };
  const auto wall = [this](const Eigen::Vector3d& p) {
    const geometry::PlaneDistance d =
        geometry::signed_distance(edge_.profile, Eigen::Vector2d(p.head<2>()));
    return ValueAndGradient{d.value, {d.gradient.x(), d.gradient.y(), 0}};
  };
  const Border on_body = border(SectionCurve(ridge.P, along_body, ridge.n1, body), range);
  const Border on_wall = border(SectionCurve(ridge.P, ridge.e2, ridge.e1, wall), range);
  section.G1 = on_body.G;
  section.G2 = on_wall.G;
  section.open = on_body.open || on_wall.open;
  return section;
}

std::vector<BandSection> sections(const Band& band, int count, const Progress& progress) {
  std::vector<BandSection> all;
  all.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double u = static_cast<double>(i) / count;
    if (i % 64 == 0) progress.at(u, "width");
    all.push_back(band.at(u));
  }
  return all;
}

WidthRange width_range(const Band& band, const std::vector<BandSection>& sections,
                       const Progress& progress) {
  std::vector<double> widths;
  widths.reserve(sections.size());
  for (const BandSection& section : sections) widths.push_back(width(section));
  const double step = 1 / static_cast<double>(sections.size());
  const auto at = [&](double i) {
    progress.at(0, "width");
    const double u = i * step;
    return width(band.at(u - std::floor(u)));
  };
  const Extreme high = sampled_maximum(widths, at, Ends::Closed, peak_worth);
  for (double& w : widths) w = -w;
  const Extreme low = sampled_maximum(
      widths, [&](double i) { return -at(i); }, Ends::Closed, peak_worth);
  const auto wrapped = [&](double i) { return i * step - std::floor(i * step); };
  return {
      .min = -low.value, .max = high.value, .min_at = wrapped(low.at), .max_at = wrapped(high.at)};
}

}  // namespace ridgeline::verify
