#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "core/units/contour.hpp"

/// Random half sections for the tests of core/units.
namespace ridgeline::units::shapes {

using Random = std::mt19937_64;

inline double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
inline int pick(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

/// Coordinates on a grid of `step`, so that many coincide; step 0: any.
inline double coordinate(Random& random, double low, double high, double step) {
  const double x = between(random, low, high);
  return step > 0 ? std::round(x / step) * step : x;
}

/// A star-shaped loop about a point: lines, some replaced by arcs of half circles or less.
inline Contour loop(Random& random, double step) {
  const int n = pick(random, 3, 8);
  const Point middle{coordinate(random, 6, 30, step), coordinate(random, 0, 40, step)};
  std::vector<Point> corners;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * M_PI * (i + between(random, 0, 0.8)) / n;
    const double d = between(random, 1, 6);
    Point p{middle.r + d * std::sin(a), middle.z + d * std::cos(a)};
    if (step > 0) p = {std::round(p.r / step) * step, std::round(p.z / step) * step};
    corners.push_back(p);
  }
  Contour contour;
  for (int i = 0; i < n; ++i) {
    const Point& p = corners[static_cast<std::size_t>(i)];
    const Point& q = corners[static_cast<std::size_t>((i + 1) % n)];
    const double chord = std::hypot(p.r - q.r, p.z - q.z);
    if (chord > 1e-3 && pick(random, 0, 2) == 0) {
      const double R = chord * between(random, 0.5, 3);
      contour.push_back(arc_segment(
          p, q, R, pick(random, 0, 1) != 0 ? Sense::Clockwise : Sense::CounterClockwise));
    } else {
      contour.push_back({p, q, {}});
    }
  }
  return contour;
}

/// A turned profile from the axis out: steps, tapers and fillets.
inline Contour profile(Random& random, double step) {
  std::vector<Point> points{{0, 0}};
  double z = 0;
  double r = coordinate(random, 3, 20, step > 0 ? step : 0);
  points.push_back({r, 0});
  const int n = pick(random, 2, 6);
  for (int i = 0; i < n; ++i) {
    z += std::max(step > 0 ? step : 0.01, coordinate(random, 1, 12, step));
    if (pick(random, 0, 2) == 0) r = coordinate(random, 3, 20, step);
    points.push_back({r, z});
    if (i + 1 < n) {
      r = coordinate(random, 3, 20, step);
      points.push_back({r, z});
    }
  }
  points.push_back({0, z});
  Contour contour;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    const Point& q = points[(i + 1) % points.size()];
    if (std::hypot(p.r - q.r, p.z - q.z) > 0) contour.push_back({p, q, {}});
  }
  return contour;
}

inline Region region(Random& random, double step) {
  std::vector<Contour> loops{pick(random, 0, 1) != 0 ? profile(random, step) : loop(random, step)};
  const int more = pick(random, 0, 2);
  for (int i = 0; i < more; ++i) loops.push_back(loop(random, step));
  return region_of(loops);
}

}  // namespace ridgeline::units::shapes
