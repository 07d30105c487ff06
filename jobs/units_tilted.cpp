#include "jobs/units_tilted.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/base/angle.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector3d;

constexpr double angle_step = 1e-3;  // [degrees] of G68.2
constexpr double farthest = 9999;    // [mm] that every control takes as a coordinate
constexpr double height_step = 0.1;  // [mm]
constexpr int around = 24;           // places on the rim of a tool

}  // namespace

// With the outside direction h = (cos c sin b, sin c sin b, cos b): y = (-sin c, cos c, 0), x = y x
// h. The line through p along h meets the plane X = 0 of the turned spindle at Z = p.z - p.x' / tan
// b.
Tilt tilted_plane(const Vector3d& point, const Vector3d& outwards,
                  const nc::LatheProgram& program) {
  Tilt tilt;
  const double lean = degrees(std::atan2(std::hypot(outwards.x(), outwards.y()), outwards.z()));
  if (lean > 90) {
    tilt.why = fmt::format(
        "it leans {:.3f} degrees from the axis, towards the chuck; up to 90 a head reaches it",
        lean);
    return tilt;
  }
  const double b = std::round(lean / angle_step) * angle_step;
  const double c = std::atan2(outwards.y(), outwards.x());
  TiltedPlane found;
  const double s = std::sin(radians(b)), k = std::cos(radians(b));
  found.y = Vector3d(-std::sin(c), std::cos(c), 0);
  found.z = Vector3d(std::cos(c) * s, std::sin(c) * s, k);
  found.x = found.y.cross(found.z);
  const Vector3d across(std::cos(c), std::sin(c), 0);
  nc::LathePlane& plane = found.plane;
  plane.c = degrees(c) < 0 ? degrees(c) + 360 : degrees(c);
  plane.angle = b;
  plane.y = point.dot(found.y);
  plane.z = point.z() - point.dot(across) * k / s;
  if (!(b >= angle_step && std::abs(plane.z) < farthest)) {
    tilt.why = fmt::format("it leans {:.3f} degrees from the axis: no plane that far off", lean);
    return tilt;
  }
  found.origin = plane.y * found.y + plane.z * Vector3d::UnitZ();
  plane.level = program.safe_x * s + (program.safe_z - plane.z) * k;
  tilt.plane = found;
  return tilt;
}

double clear_height(const units::Region& material, const Vector3d& point, const Vector3d& outwards,
                    double diameter) {
  const units::Box b = units::box(material);
  const Vector3d n = outwards.normalized();
  const Vector3d u = n.unitOrthogonal(), v = n.cross(u);
  const double reach = 2 * b.r1 + (b.z1 - b.z0) + diameter;
  double clear = 0;
  for (int i = 0; i <= around; ++i) {  // the last in the middle
    const double a = 2 * std::numbers::pi * i / around;
    const double R = i == around ? 0 : diameter / 2;
    const Vector3d rim = point + R * (std::cos(a) * u + std::sin(a) * v);
    for (double h = reach; h > clear; h -= height_step) {
      const Vector3d p = rim + h * n;
      if (!units::covers(material, {std::hypot(p.x(), p.y()), p.z()})) continue;
      clear = h;
      break;
    }
  }
  return clear;
}

}  // namespace ridgeline::jobs
