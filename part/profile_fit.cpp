#include "part/profile_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ridgeline::part {
namespace {

using units::Curve;
using units::Point;

constexpr double largest_radius = 1e6;  // [mm], as documents of shapes have it
constexpr double across = 1e-7;         // [mm]: a run in z shorter than this has no r(z)

/// Circle through three points; nullopt when they are in line.
std::optional<Curve> circle_through(const Point& a, const Point& b, const Point& c) {
  const double abz = b.z - a.z, abr = b.r - a.r, acz = c.z - a.z, acr = c.r - a.r;
  const double twice_area = 2 * (abz * acr - abr * acz);
  const double l2 = acz * acz + acr * acr;
  if (std::abs(twice_area) < 1e-9 * l2) return std::nullopt;
  const double b2 = abz * abz + abr * abr;
  const double z = a.z + (acr * b2 - abr * l2) / twice_area;
  const double r = a.r + (abz * l2 - acz * b2) / twice_area;
  const double R = std::hypot(a.z - z, a.r - r);
  if (!(R <= largest_radius)) return std::nullopt;
  const int side = b.r > r ? 1 : -1;
  if ((a.r - r) * side < -1e-9 || (c.r - r) * side < -1e-9) return std::nullopt;
  return Curve{.a = {r, z}, .b = {}, .radius = R, .side = side};
}

double deviation(const Curve& curve, const Point& p) {
  if (units::is_arc(curve)) {
    return std::abs(std::hypot(p.z - curve.a.z, p.r - curve.a.r) - curve.radius);
  }
  const double dz = curve.b.z - curve.a.z;
  const double dr = curve.b.r - curve.a.r;
  return std::abs((p.z - curve.a.z) * dr - (p.r - curve.a.r) * dz) / std::hypot(dz, dr);
}

std::optional<Curve> piece(std::span<const Point> points, double tolerance) {
  const Point& first = points.front();
  const Point& last = points.back();
  if (std::abs(last.z - first.z) < across) return std::nullopt;
  const bool rises = last.z > first.z;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if ((points[i + 1].z - points[i].z) * (rises ? 1 : -1) < -across) return std::nullopt;
  }
  const auto fits = [&](const Curve& curve) {
    return std::all_of(points.begin(), points.end(),
                       [&](const Point& p) { return deviation(curve, p) <= tolerance; });
  };
  const Curve line = units::line_through(first, last);
  if (fits(line)) return line;
  const std::optional<Curve> circle = circle_through(first, points[points.size() / 2], last);
  if (circle && fits(*circle)) return circle;
  return std::nullopt;
}

}  // namespace

std::vector<FittedPiece> fitted(std::span<const Point> points, double tolerance) {
  std::vector<FittedPiece> pieces;
  std::size_t i = 0;
  while (i + 1 < points.size()) {
    std::optional<Curve> best;
    std::size_t end = i + 1;
    // The longest run that one curve fits: double, then halve.
    for (std::size_t step = points.size() - 1 - i; step > 0; step /= 2) {
      while (end + step < points.size()) {
        const std::optional<Curve> longer = piece(points.subspan(i, end + step - i + 1), tolerance);
        if (!longer) break;
        best = longer;
        end += step;
      }
    }
    if (!best) best = piece(points.subspan(i, 2), tolerance);
    if (best) {
      const double za = points[i].z;
      const double zb = points[end].z;
      pieces.push_back({*best, std::min(za, zb), std::max(za, zb), i, end});
    }
    i = end;
  }
  return pieces;
}

std::vector<FittedPiece> fitted_along(const std::function<Point(double t)>& curve,
                                      double tolerance) {
  constexpr std::size_t fewest = 64, most = 1024;
  constexpr double between = 1.1;  // of the tolerance, for points that were not fitted
  std::vector<Point> points;
  for (std::size_t i = 0; i <= fewest; ++i) {
    points.push_back(curve(static_cast<double>(i) / fewest));
  }
  for (std::size_t n = fewest;; n *= 2) {
    std::vector<FittedPiece> pieces = fitted(points, tolerance);
    if (n == most) return pieces;
    std::vector<Point> denser;
    for (std::size_t i = 0; i < n; ++i) {
      denser.push_back(points[i]);
      denser.push_back(curve((static_cast<double>(i) + 0.5) / static_cast<double>(n)));
    }
    denser.push_back(points.back());
    const bool fits = std::ranges::all_of(pieces, [&](const FittedPiece& piece) {
      for (std::size_t i = piece.first; i < piece.last; ++i) {
        if (deviation(piece.curve, denser[2 * i + 1]) > between * tolerance) return false;
      }
      return true;
    });
    if (fits) return pieces;
    points = std::move(denser);
  }
}

}  // namespace ridgeline::part
