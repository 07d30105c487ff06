#include "part/model.hpp"

#include <cmath>

namespace ridgeline::part {

Eigen::Vector3d natural_normal(const Surface& surface, const Eigen::Vector3d& point) {
  const Eigen::Vector3d& a = surface.axis;
  const Eigen::Vector3d d = point - surface.origin;
  const Eigen::Vector3d radial = d - d.dot(a) * a;
  switch (surface.kind) {
    case SurfaceKind::Cylinder: return radial.normalized();
    case SurfaceKind::Cone: {
      const Eigen::Vector3d e = radial.normalized();
      return std::cos(surface.half_angle) * e - std::sin(surface.half_angle) * a;
    }
    case SurfaceKind::Sphere: return d.normalized();
    case SurfaceKind::Torus: {
      // The tube's circle on this side of the axis, or the other for the inner part of a spindle.
      const Eigen::Vector3d near = d - surface.radius * radial.normalized();
      const Eigen::Vector3d far = d + surface.radius * radial.normalized();
      const double r = surface.minor_radius;
      return (std::abs(near.norm() - r) <= std::abs(far.norm() - r) ? near : far).normalized();
    }
    case SurfaceKind::Plane:
    case SurfaceKind::Other: break;
  }
  return a;
}

// With p' = p - c:  integral of (p' - (p'.a) a).n / 2 dA = (tr M' - a^T M' a)/2,
// M' = M - c N^T,  N = integral of n dA,  M = integral of p n^T dA.
double flux(const Face& face, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis) {
  const Eigen::Matrix3d M = face.moment_integral - origin * face.normal_integral.transpose();
  return (M.trace() - axis.dot(M * axis)) / 2;
}

}  // namespace ridgeline::part
