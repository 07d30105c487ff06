#pragma once

#include <Eigen/Core>
#include <variant>

namespace ridgeline::geometry {

/// Circular cylinder of infinite length. Distance > 0 outside.
struct Cylinder {
  Eigen::Vector3d point;  ///< on the axis [mm]
  Eigen::Vector3d axis;   ///< unit
  double radius = 0;      ///< [mm], > 0
};

/// Plane. Distance > 0 on the side of the normal.
struct Plane {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;  ///< unit
};

/// What a hole breaks into or out of.
using Surface = std::variant<Cylinder, Plane>;

/// Value, gradient and Hessian of the signed distance of a surface.
struct SurfaceDistance {
  double value = 0;
  Eigen::Vector3d gradient;
  Eigen::Matrix3d hessian;
};

/// A surface as F(p) = p.Q p / 2 + l.p + c = 0, scaled so that its gradient Q p + l is the unit
/// normal on the surface: one polynomial for every body, [E 4, 13] for the cylinder.
struct Quadric {
  Eigen::Matrix3d Q;
  Eigen::Vector3d l;
  double c = 0;
};

inline double value(const Quadric& F, const Eigen::Vector3d& p) {
  return 0.5 * p.dot(F.Q * p) + F.l.dot(p) + F.c;
}
inline Eigen::Vector3d gradient(const Quadric& F, const Eigen::Vector3d& p) {
  return F.Q * p + F.l;
}

Quadric quadric(const Surface& surface);

SurfaceDistance signed_distance(const Surface& surface, const Eigen::Vector3d& p);

}  // namespace ridgeline::geometry
