#include "core/geometry/break_out.hpp"

#include <cmath>
#include <numbers>

namespace ridgeline::geometry {
namespace {

using std::numbers::pi;

/// The half of the profile at y' >= 0, from x' = a + R2 down to -(a + R2), by arc length.
struct UpperHalf {
  double R2, a, b, perimeter;  // half straight parts a across, b along

  explicit UpperHalf(const Profile& profile)
      : R2(profile.R2),
        a(profile.straight_across / 2),
        b(profile.straight_along / 2),
        perimeter(geometry::perimeter(profile)) {}

  /// Where x' is c, |c| < a + R2; as a profile parameter in (0, 1/2).
  double at(double c) const {
    if (c >= a) return (b + R2 * std::acos((c - a) / R2)) / perimeter;
    if (c >= -a) return (b + R2 * pi / 2 + a - c) / perimeter;
    return (b + R2 * std::acos((c + a) / R2) + 2 * a) / perimeter;
  }

  /// Which of the parts v is on: first straight, corner, straight across, corner, last straight.
  int part(double v) const {
    const double s = v * perimeter;
    const double quarter = R2 * pi / 2;
    const double ends[] = {b, b + quarter, b + quarter + 2 * a, b + 2 * quarter + 2 * a};
    int k = 0;
    while (k < 4 && s >= ends[k]) ++k;
    return k;
  }

  /// |x'(v) - x'(v + step)| without cancellation where both are on one part.
  double fall(double v, double step, double x, double x_beyond) const {
    const int k = part(v);
    if (k != part(v + step)) return std::abs(x - x_beyond);
    if (k == 2) return std::abs(step) * perimeter;
    if (k == 0 || k == 4) return 0;
    const double phi = (v * perimeter - b - (k == 3 ? 2 * a : 0)) / R2;
    const double turn = step * perimeter / R2;
    return std::abs(2 * R2 * std::sin(phi + turn / 2) * std::sin(turn / 2));
  }
};

struct Swing {
  double sine, cosine;
};
Swing swing(double u) {
  const double w = 2 * pi * (u - std::floor(u));
  return {std::sin(w), std::cos(w)};
}

/// (R1 - xi)(R1 + xi), xi = x' + f.
double height_squared(const BreakOut& curve, const Profile& profile, double u) {
  const auto [sine, cosine] = swing(u);
  const double x = profile_at(profile, profile_parameter(curve, u)).p.x();
  double below = curve.R1 - curve.f - x;  // R1 - xi
  double above = curve.R1 + curve.f + x;
  // The way to the nearer end, and which end that is.
  const double way = curve.half * cosine * cosine / (1 + std::abs(sine));
  const bool both = curve.plus >= 0 && curve.minus >= 0;
  const bool at_plus = both ? (sine > 0) == curve.mirrored : curve.plus >= 0;
  const UpperHalf upper(profile);
  if (at_plus) {
    below = upper.fall(curve.plus, way, curve.R1 - curve.f, x);
  } else {
    above = upper.fall(curve.minus, -way, -curve.R1 - curve.f, x);
  }
  return below * above;
}

}  // namespace

bool breaks_out(const Profile& profile, double f, double R1) {
  return half_extents(profile).x() + std::abs(f) > R1;
}

BreakOut break_out(const Profile& profile, double f, double R1, bool upper) {
  const UpperHalf half(profile);
  const double width = half.a + half.R2;
  BreakOut curve{.R1 = R1, .f = f};
  if (R1 - f < width) curve.plus = half.at(R1 - f);
  if (-R1 - f > -width) curve.minus = half.at(-R1 - f);
  if (curve.minus < 0) {
    curve.middle = 0.5;
    curve.half = 0.5 - curve.plus;
  } else if (curve.plus < 0) {
    curve.middle = 0;
    curve.half = curve.minus;
  } else {
    curve.mirrored = !upper;
    curve.middle = (curve.plus + curve.minus) / 2;
    if (curve.mirrored) curve.middle = 1 - curve.middle;
    curve.half = (curve.minus - curve.plus) / 2;
  }
  return curve;
}

double profile_parameter(const BreakOut& curve, double u) {
  const double v = curve.middle + curve.half * swing(u).sine;
  return v - std::floor(v);
}

double height_across(const BreakOut& curve, const Profile& profile, double u) {
  return std::copysign(std::sqrt(height_squared(curve, profile, u)), swing(u).cosine);
}

double height_rate(const BreakOut& curve, const Profile& profile, double u) {
  return std::sqrt(height_squared(curve, profile, u)) / std::abs(swing(u).cosine);
}

std::vector<double> passages(const BreakOut& curve, double v) {
  const double sine = std::remainder(v - curve.middle, 1) / curve.half;
  if (!(std::abs(sine) < 1)) return {};
  const double u = std::asin(sine) / (2 * pi);
  return {u - std::floor(u), 0.5 - u};
}

}  // namespace ridgeline::geometry
