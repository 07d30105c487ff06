#include "core/units/curve.hpp"

#include <algorithm>
#include <cmath>

#include "core/units/tolerance.hpp"

namespace ridgeline::units {
namespace {

constexpr double same_curve = 1e-9;  // [mm]: rounding of two ways to write one line

double half_chord(const Curve& circle, double z) {
  const double h = std::abs(z - circle.a.z);
  const double below = circle.radius - h;
  if (!(below > 0)) return 0;
  return std::sqrt(below * (circle.radius + h));
}

void add(Crossings& found, double z, double z0, double z1) {
  if (!(z > z0 && z < z1)) return;
  if (found.count == 2) return;
  found.z[found.count++] = z;
}

Crossings line_line(const Curve& p, const Curve& q, double z0, double z1) {
  Crossings found;
  const double d0 = radius_at(p, z0) - radius_at(q, z0);
  const double d1 = radius_at(p, z1) - radius_at(q, z1);
  if ((d0 < 0) != (d1 < 0) && d0 != d1) add(found, z0 + (z1 - z0) * (d0 / (d0 - d1)), z0, z1);
  return found;
}

// Circle h^2 + g^2 = R^2 about (rc, zc) and line g = m h + k in the same coordinates:
//   (1 + m^2) h^2 + 2 m k h + k^2 - R^2 = 0,  and g has the sign of the side.
Crossings line_arc(const Curve& line, const Curve& arc, double z0, double z1) {
  Crossings found;
  const double R = arc.radius;
  const double m = (line.b.r - line.a.r) / (line.b.z - line.a.z);
  const double k = radius_at(line, arc.a.z) - arc.a.r;
  const double square = R * R * (1 + m * m) - k * k;
  if (!(square > 0)) return found;
  const double root = std::sqrt(square);
  for (const double sign : {-1.0, 1.0}) {
    const double h = (-m * k + sign * root) / (1 + m * m);
    if ((m * h + k) * arc.side >= -merge_tolerance) add(found, arc.a.z + h, z0, z1);
  }
  return found;
}

// Two circles: the radical line at distance e from the first centre along the line of centres, and
// the half chord f.
Crossings arc_arc(const Curve& p, const Curve& q, double z0, double z1) {
  Crossings found;
  const double dz = q.a.z - p.a.z;
  const double dr = q.a.r - p.a.r;
  const double distance = std::hypot(dz, dr);
  if (distance < merge_tolerance) return found;
  const double e =
      (distance * distance + (p.radius - q.radius) * (p.radius + q.radius)) / (2 * distance);
  const double square = (p.radius - e) * (p.radius + e);
  if (!(square > 0)) return found;
  const double f = std::sqrt(square);
  const double uz = dz / distance;
  const double ur = dr / distance;
  double z[2];
  int count = 0;
  for (const double sign : {-1.0, 1.0}) {
    const double h = e * uz - sign * f * ur;
    const double g = e * ur + sign * f * uz;
    if (g * p.side >= -merge_tolerance && (g - dr) * q.side >= -merge_tolerance) {
      z[count++] = p.a.z + h;
    }
  }
  if (count == 2 && z[0] > z[1]) std::swap(z[0], z[1]);
  for (int i = 0; i < count; ++i) add(found, z[i], z0, z1);
  return found;
}

}  // namespace

Curve line_through(const Point& p, const Point& q) {
  return p.z < q.z ? Curve{.a = p, .b = q} : Curve{.a = q, .b = p};
}

double radius_at(const Curve& curve, double z) {
  if (is_arc(curve)) return curve.a.r + curve.side * half_chord(curve, z);
  const double rise = curve.b.r - curve.a.r;
  if (rise == 0) return curve.a.r;
  const double t = (z - curve.a.z) / (curve.b.z - curve.a.z);
  return t < 0.5 ? curve.a.r + t * rise : curve.b.r - (1 - t) * rise;  // exact at both ends
}

double slope_at(const Curve& curve, double z) {
  if (!is_arc(curve)) return (curve.b.r - curve.a.r) / (curve.b.z - curve.a.z);
  const double g = std::max(half_chord(curve, z), merge_tolerance);
  return -curve.side * (z - curve.a.z) / g;
}

Range range(const Curve& curve, double z0, double z1) {
  const double r0 = radius_at(curve, z0);
  const double r1 = radius_at(curve, z1);
  Range found{std::min(r0, r1), std::max(r0, r1)};
  if (is_arc(curve) && z0 < curve.a.z && curve.a.z < z1) {
    const double crest = curve.a.r + curve.side * curve.radius;
    found.min = std::min(found.min, crest);
    found.max = std::max(found.max, crest);
  }
  return found;
}

Crossings crossings(const Curve& p, const Curve& q, double z0, double z1) {
  if (is_arc(p)) return is_arc(q) ? arc_arc(p, q, z0, z1) : line_arc(q, p, z0, z1);
  return is_arc(q) ? line_arc(p, q, z0, z1) : line_line(p, q, z0, z1);
}

// Line: (r0^2 + r0 r1 + r1^2)/3 dz. Circle r = c + s g, g = sqrt(R^2 - h^2):
//   r^2 = c^2 + 2 s c g + R^2 - h^2,  integral of g = (h g + R^2 asin(h/R))/2.
double squared_integral(const Curve& curve, double z0, double z1) {
  if (!is_arc(curve)) {
    const double r0 = radius_at(curve, z0);
    const double r1 = radius_at(curve, z1);
    return (z1 - z0) * (r0 * r0 + r0 * r1 + r1 * r1) / 3;
  }
  const double c = curve.a.r;
  const double R = curve.radius;
  const auto primitive = [&](double z) {
    const double h = std::clamp(z - curve.a.z, -R, R);
    const double g = std::sqrt((R - h) * (R + h));
    return (c * c + R * R) * h - h * h * h / 3 +
           curve.side * c * (h * g + R * R * std::asin(h / R));
  };
  return primitive(z1) - primitive(z0);
}

double integral(const Curve& curve, double z0, double z1) {
  if (!is_arc(curve)) return (z1 - z0) * (radius_at(curve, z0) + radius_at(curve, z1)) / 2;
  const double R = curve.radius;
  const auto primitive = [&](double z) {
    const double h = std::clamp(z - curve.a.z, -R, R);
    const double g = std::sqrt((R - h) * (R + h));
    return curve.a.r * h + curve.side * (h * g + R * R * std::asin(h / R)) / 2;
  };
  return primitive(z1) - primitive(z0);
}

bool is_same(const Curve& p, const Curve& q, double z0, double z1) {
  if (p.side != q.side) return false;
  if (is_arc(p)) {
    return std::abs(p.a.r - q.a.r) < same_curve && std::abs(p.a.z - q.a.z) < same_curve &&
           std::abs(p.radius - q.radius) < same_curve;
  }
  return std::abs(radius_at(p, z0) - radius_at(q, z0)) < same_curve &&
         std::abs(radius_at(p, z1) - radius_at(q, z1)) < same_curve;
}

}  // namespace ridgeline::units
