#pragma once

#include <Eigen/Core>
#include <vector>

namespace ridgeline::geometry {

/// Closed plane profile of a hole: a rectangle of straight parts, grown by R2. Circle: both
/// straight parts 0; elongated: straight_along > 0; rounded rectangle: both > 0. Coordinates x', y'
/// are perpendicular to the hole axis A2; "along" is y' (towards A1), "across" is x'. Lengths in
/// mm.
struct Profile {
  double R2 = 0;               ///< radius of the circle, the semicircles or the corners, > 0
  double straight_along = 0;   ///< length of the straight parts along y', >= 0
  double straight_across = 0;  ///< length of the straight parts along x', >= 0
};

/// A point of the profile with its derivatives by arc length, counter-clockwise seen from +A2.
struct ProfilePoint {
  Eigen::Vector2d p;        ///< [mm]
  Eigen::Vector2d tangent;  ///< unit, p' by arc length
  Eigen::Vector2d normal;   ///< unit, outward
  double curvature = 0;     ///< [1/mm], >= 0
};

/// Value, gradient and Hessian of a signed distance: negative inside the hole.
struct PlaneDistance {
  double value = 0;
  Eigen::Vector2d gradient;
  Eigen::Matrix2d hessian;
};

/// Arc length once round [mm].
double perimeter(const Profile& profile);

/// The point at u in [0, 1) of the perimeter; u = 0 is phi = 0, the point on the positive x' axis.
/// Periodic in u.
ProfilePoint profile_at(const Profile& profile, double u);

/// Parameters u in [0, 1) where straight parts and arcs join, ascending; empty for a circle.
std::vector<double> joints(const Profile& profile);

/// The parameter in [0, 1) of the point at polar angle phi about A2 [rad].
double parameter_at(const Profile& profile, double phi);

/// Exact signed distance s(x', y') of the profile.
PlaneDistance signed_distance(const Profile& profile, const Eigen::Vector2d& p);

/// Half extents of the profile along x' and y' [mm].
Eigen::Vector2d half_extents(const Profile& profile);

}  // namespace ridgeline::geometry
