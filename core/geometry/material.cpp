#include "core/geometry/material.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ridgeline::geometry {
namespace {

double square(double x) {
  return x * x;
}

Eigen::Vector3d bore_axis(const Workpiece& workpiece) {
  return workpiece.axis.normalized();
}

/// A circle of radius R about A1, extruded along A1.
Prism round_prism(const Workpiece& workpiece, double R) {
  const Eigen::Vector3d z = bore_axis(workpiece);
  const Eigen::Vector3d x = z.unitOrthogonal();
  Prism prism;
  prism.frame.axes << x, z.cross(x), z;
  prism.frame.origin = workpiece.position;
  prism.profile.R2 = R;
  return prism;
}

/// Both planes square to `direction`, `half` away from `centre`.
void add_slab(Cell& cell, const Eigen::Vector3d& centre, const Eigen::Vector3d& direction,
              double half) {
  for (const double sign : {1.0, -1.0}) {
    cell.planes.push_back({.point = centre + sign * half * direction, .normal = sign * direction});
  }
}

Cell outside_of(const Workpiece& workpiece) {
  Cell cell;
  if (workpiece.shape == BodyShape::ThickWalledCylinder) {
    cell.wall = round_prism(workpiece, workpiece.outer_radius);
    add_slab(cell, workpiece.position, bore_axis(workpiece), workpiece.length / 2);
  } else {
    const Frame frame = block_frame(workpiece);
    for (int i = 0; i < 3; ++i) {
      add_slab(cell, frame.origin, frame.axes.col(i), workpiece.size[i] / 2);
    }
  }
  return cell;
}

Cell cavity_of(const Workpiece& workpiece, const Hole& hole) {
  const Frame frame = hole_frame(workpiece, hole);
  const Eigen::Vector3d a2 = frame.axes.col(2);
  Cell cell;
  cell.wall = Prism{.frame = frame, .profile = hole.profile};
  if (const std::optional<double> floor = floor_height(workpiece, hole)) {
    cell.planes.push_back({.point = frame.origin + *floor * a2, .normal = -a2});
  }
  if (hole.walls == 1) {
    const Eigen::Vector3d a1 = bore_axis(workpiece);
    const Eigen::Vector3d up = (a2 - a2.dot(a1) * a1).normalized();
    cell.planes.push_back({.point = workpiece.position, .normal = -up});
  }
  return cell;
}

}  // namespace

Material material_of(const Workpiece& workpiece) {
  Material material;
  material.outside = outside_of(workpiece);
  Cell bore;
  bore.wall = round_prism(workpiece, workpiece.inner_radius);
  material.cavities.push_back(bore);
  for (const Hole& hole : workpiece.holes) {
    material.cavities.push_back(cavity_of(workpiece, hole));
  }
  return material;
}

// A rectangle of the straight parts, grown by R2: with q = |p| - half, outside of the rectangle the
// distance to it is |max(q, 0)|, inside it is the larger (less negative) of q.
double plane_distance(const Profile& profile, double x, double y) {
  const double qx = std::abs(x) - profile.straight_across / 2;
  const double qy = std::abs(y) - profile.straight_along / 2;
  const double out = std::sqrt(square(std::max(qx, 0.0)) + square(std::max(qy, 0.0)));
  return out + std::min(std::max(qx, qy), 0.0) - profile.R2;
}

double distance(const Cell& cell, const Eigen::Vector3d& point) {
  double d = -std::numeric_limits<double>::infinity();
  if (cell.wall) {
    const Eigen::Vector3d p = to_local(cell.wall->frame, point);
    d = plane_distance(cell.wall->profile, p.x(), p.y());
  }
  for (const Plane& plane : cell.planes) {
    d = std::max(d, plane.normal.dot(point - plane.point));
  }
  return d;
}

double distance(const Material& material, const Eigen::Vector3d& point) {
  double d = distance(material.outside, point);
  for (const Cell& cavity : material.cavities) d = std::max(d, -distance(cavity, point));
  return d;
}

double material_distance(const Workpiece& workpiece, const Eigen::Vector3d& point) {
  return distance(material_of(workpiece), point);
}

}  // namespace ridgeline::geometry
