#include "core/geometry/surface.hpp"

#include <Eigen/Geometry>

namespace ridgeline::geometry {
namespace {

SurfaceDistance distance(const Cylinder& cylinder, const Eigen::Vector3d& p) {
  const Eigen::Vector3d& a = cylinder.axis;
  const Eigen::Vector3d v = p - cylinder.point;
  const Eigen::Vector3d q = v - v.dot(a) * a;  // from the axis to p
  const double r = q.norm();
  const Eigen::Vector3d n = r > 0 ? Eigen::Vector3d(q / r) : Eigen::Vector3d(a.unitOrthogonal());
  SurfaceDistance s{.value = r - cylinder.radius, .gradient = n, .hessian = {}};
  s.hessian.setZero();
  if (r > 0) {
    s.hessian = (Eigen::Matrix3d::Identity() - a * a.transpose() - n * n.transpose()) / r;
  }
  return s;
}

SurfaceDistance distance(const Plane& plane, const Eigen::Vector3d& p) {
  return {.value = (p - plane.point).dot(plane.normal),
          .gradient = plane.normal,
          .hessian = Eigen::Matrix3d::Zero()};
}

Quadric as_quadric(const Cylinder& cylinder) {
  const Eigen::Vector3d& a = cylinder.axis;
  const Eigen::Matrix3d Q =
      (Eigen::Matrix3d::Identity() - a * a.transpose()) / cylinder.radius;  // projects off the axis
  const Eigen::Vector3d l = -Q * cylinder.point;
  return {.Q = Q, .l = l, .c = (-cylinder.point.dot(l) - cylinder.radius) / 2};
}

Quadric as_quadric(const Plane& plane) {
  return {.Q = Eigen::Matrix3d::Zero(), .l = plane.normal, .c = -plane.normal.dot(plane.point)};
}

}  // namespace

SurfaceDistance signed_distance(const Surface& surface, const Eigen::Vector3d& p) {
  return std::visit([&](const auto& s) { return distance(s, p); }, surface);
}

Quadric quadric(const Surface& surface) {
  return std::visit([](const auto& s) { return as_quadric(s); }, surface);
}

}  // namespace ridgeline::geometry
