#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/angle.hpp"
#include "core/macro/cycle_section.hpp"

namespace ridgeline::macro {

namespace {

using std::numbers::pi;

constexpr int halvings = 80;  // of an interval: more than a double resolves

// The x in [low, high] where `height`, which grows with x, reaches `wanted`; high when it does not.
double where(const std::function<double(double)>& height, double wanted, double low, double high) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (height(middle) < wanted ? low : high) = middle;
  }
  return (low + high) / 2;
}

double root(double square) {
  return std::sqrt(std::max(0.0, square));
}

// Slope where method 1 leaves the most: rho = r + a/sin q is smallest at the steepest place.
double steepest(const Cycle& cycle) {
  switch (cycle.family) {
    case Family::Taper: return radians(cycle.angle);
    case Family::HalfConvex: return half_round_limit(cycle);
    default: return pi / 2;
  }
}

// (p^2/8)(1/rho +- sin q/rc), rho = r + a/sin q: + outside, - inside; p is the arc between passes
// at the contact radius rc.
double cusp_on_circle(const Cycle& cycle, double step, double rc) {
  const double q = radians(cycle.angle), p = rc * radians(step);
  const double rho = cycle.r + core_radius(cycle) / std::sin(q);
  const double curvature = rc > 0 ? std::sin(q) / rc : 0;
  return p * p / 8 * (1 / rho + (cycle.side == WallSide::Outside ? curvature : -curvature));
}

// On a circle the passes diverge: the worst place is the edge of the slope with the larger radius.
double cusp_of_passes(const Cycle& cycle, double step) {
  if (cycle.edge != EdgeShape::Straight) {
    return std::max(cusp_on_circle(cycle, step, cycle.R0),
                    cusp_on_circle(cycle, step, radius_at(cycle, cycle.width)));
  }
  return cusp_across(core_radius(cycle), cycle.r, steepest(cycle), step);
}

double cusp_of_round(const Cycle& cycle, double step) {
  const double dq = radians(step);
  switch (cycle.family) {
    case Family::BottomR:
    case Family::HalfConcave: return cusp_concave(cycle.R, cycle.r, dq);
    case Family::RTaperR: {
      const double lower = cycle.lower == LowerRound::Concave ? cusp_concave(cycle.R2, cycle.r, dq)
                                                              : cusp_convex(cycle.R2, cycle.r, dq);
      return std::max(cusp_convex(cycle.R, cycle.r, dq), lower);
    }
    default: return cusp_convex(cycle.R, cycle.r, dq);
  }
}

bool has_slope(const Cycle& cycle) {
  return cycle.family == Family::Taper || cycle.family == Family::ComplexSide ||
         cycle.family == Family::RTaperR;
}

}  // namespace

// The tool's outline seen along the motion is the ellipse (a cos T, a sin q sin T) grown by r.
//   a sin T + r sin q sin T/W = p/2,  W = sqrt(sin^2 q sin^2 T + cos^2 T)
//   cusp = a sin q + r - (a sin q cos T + r cos T/W)
double cusp_across(double a, double r, double q, double p) {
  const double s = std::sin(q);
  if (s <= 0) return 0;
  const auto W = [s](double T) { return std::hypot(s * std::sin(T), std::cos(T)); };
  const auto half_pitch = [&](double T) { return a * std::sin(T) + r * s * std::sin(T) / W(T); };
  const double T = where(half_pitch, p / 2, 0, pi / 2);
  return a * s + r - (a * s * std::cos(T) + r * std::cos(T) / W(T));
}

// r - sqrt(r^2 - ds^2/4) while the two outlines meet on the corner radius: asin(ds/2r) <= q and
// <= 90 - q. Beyond, the flat bottom or the flank of one cuts the corner arc of the other.
double cusp_slope(double r, double q, double ds) {
  const double s = std::sin(q), c = std::cos(q);
  if (r <= 0) return ds * s * c;
  const double e = ds / (2 * r) < 1 ? std::asin(ds / (2 * r)) : pi / 2;
  if (e <= std::min(q, pi / 2 - q)) return r - root(r * r - ds * ds / 4);
  // The profile is y' along the slope, z' normal; outline 1 at 0, outline 2 at ds down the slope.
  // Bottom of 1 (direction at angle q to the slope) or flank (at 90 - q), whichever comes first.
  const double angle = std::min(q, pi / 2 - q);
  // Line tangent to circle 1 at angle `angle` from its contact: height above the slope at x is
  // r - r cos(angle) + (x - r sin(angle)) tan(angle). Meets circle 2 centred at (ds, r).
  const double tangent = std::tan(angle);
  const double offset = r - r * std::cos(angle) - r * std::sin(angle) * tangent;
  const auto above = [&](double x) {
    const double line = offset + x * tangent;
    const double circle = r - root(r * r - (ds - x) * (ds - x));
    return line - circle;
  };
  const double x = where(above, 0, r * std::sin(angle), ds);
  const double far_limit = r * std::sin(std::max(q, pi / 2 - q));
  if (ds - x <= far_limit) return offset + x * tangent;
  // Both straight: bottom of one and flank of the other meet under a right angle.
  const double other = std::max(q, pi / 2 - q);
  const double t2 = std::tan(other);
  const double offset2 = r - r * std::cos(other) - r * std::sin(other) * t2;
  const double meet = (offset2 - offset + ds * t2) / (tangent + t2);
  return offset + meet * tangent;
}

// The worst step has its middle at 45 degrees. While the peak is on both corner arcs, asin(half/r)
// <= 45 degrees, half = (R +- r) sin(dq/2); beyond, the flat bottom of the upper tool meets the
// flank of the lower one, at S = sin(45 +- dq/2): always so for a flat tool.
double cusp_convex(double R, double r, double dq) {
  const double half = (R + r) * std::sin(dq / 2);
  if (half <= r / std::numbers::sqrt2) {
    return (R + r) * std::cos(dq / 2) - root(r * r - half * half) - R;
  }
  const double S = std::sin(std::min(pi / 2, pi / 4 + dq / 2));
  return std::numbers::sqrt2 * ((R + r) * S - r) - R;
}

double cusp_concave(double R, double r, double dq) {
  const double half = (R - r) * std::sin(dq / 2);
  if (half <= r / std::numbers::sqrt2) {
    return R - (R - r) * std::cos(dq / 2) - root(r * r - half * half);
  }
  const double S = std::sin(std::max(0.0, pi / 4 - dq / 2));
  return R - std::numbers::sqrt2 * ((R - r) * S + r);
}

double pass_step(const Cycle& cycle) {
  if (cycle.edge == EdgeShape::Straight && cycle.pitch) return *cycle.pitch;
  if (cycle.edge != EdgeShape::Straight && cycle.angle_step) return *cycle.angle_step;
  const double most = cycle.edge == EdgeShape::Straight ? cycle.D : 30;
  return where([&](double step) { return cusp_of_passes(cycle, step); }, cycle.cusp, 0, most);
}

double lower_edge_cusp(const Cycle& cycle) {
  return cusp_on_circle(cycle, pass_step(cycle), cycle.R0);
}

double slope_step(const Cycle& cycle) {
  if (cycle.slope_step) return *cycle.slope_step;
  const double q = radians(cycle.angle);
  return where([&](double ds) { return cusp_slope(cycle.r, q, ds); }, cycle.cusp, 0, cycle.D);
}

double section_step(const Cycle& cycle) {
  if (cycle.section_step) return *cycle.section_step;
  return where([&](double step) { return cusp_of_round(cycle, step); }, cycle.cusp, 0, 30);
}

double cusp_height(const Cycle& cycle) {
  if (cycle.family == Family::HelicalSide) return 0;  // the flank of the tool cuts
  if (cycle.family == Family::HelicalCornerR) {
    return cusp_convex(cycle.R, cycle.r, radians(cycle.turn_step));
  }
  if (cycle.method == 1) return cusp_of_passes(cycle, pass_step(cycle));
  const double slope =
      has_slope(cycle) ? cusp_slope(cycle.r, radians(cycle.angle), slope_step(cycle)) : 0;
  const bool is_plain_slope = cycle.family == Family::Taper || cycle.family == Family::ComplexSide;
  if (is_plain_slope) return slope;
  return std::max(slope, cusp_of_round(cycle, section_step(cycle)));
}

}  // namespace ridgeline::macro
