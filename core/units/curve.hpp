#pragma once

#include <optional>
#include <vector>

namespace ridgeline::units {

/// A point of the half section: r >= 0 from the turning axis, z along it [mm].
struct Point {
  double r = 0;
  double z = 0;
};

/// r as a function of z. A line through a and b (a.z < b.z), or the half of a circle about a that
/// lies on one side of it: side +1 for r >= a.r, -1 for r <= a.r.
struct Curve {
  Point a;
  Point b;            ///< line only
  double radius = 0;  ///< of the circle; 0 for a line
  int side = 0;       ///< of the circle; 0 for a line
};

constexpr bool is_arc(const Curve& curve) {
  return curve.side != 0;
}

/// The line through two points; their z must differ.
Curve line_through(const Point& p, const Point& q);

/// r at z. A circle keeps the r of its pole beyond it.
double radius_at(const Curve& curve, double z);

/// dr/dz at z; very large at the pole of a circle.
double slope_at(const Curve& curve, double z);

/// Least and greatest r between z0 and z1.
struct Range {
  double min = 0;
  double max = 0;
};
Range range(const Curve& curve, double z0, double z1);

/// At most two z strictly between z0 and z1 where the curves cross, ascending.
struct Crossings {
  int count = 0;
  double z[2] = {0, 0};
};
Crossings crossings(const Curve& p, const Curve& q, double z0, double z1);

/// Integral of r^2 dz from z0 to z1 [mm^3], closed form: a volume of revolution divided by pi.
double squared_integral(const Curve& curve, double z0, double z1);

/// Integral of r dz from z0 to z1 [mm^2].
double integral(const Curve& curve, double z0, double z1);

/// Do both describe the same r within 1e-9 mm between z0 and z1?
bool is_same(const Curve& p, const Curve& q, double z0, double z1);

}  // namespace ridgeline::units
