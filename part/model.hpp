#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

/// A solid as plain values: what the recognition of axis, shadow, features and hole edges works on.
namespace ridgeline::part {

enum class SurfaceKind { Plane, Cylinder, Cone, Sphere, Torus, Other };

/// Cylinder, cone and torus about `axis` through `origin`; sphere about origin; plane through
/// origin with the normal `axis`. Cone: `radius` in the plane of the origin, growing along the axis
/// by tan(half_angle).
struct Surface {
  SurfaceKind kind = SurfaceKind::Other;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double radius = 0;        ///< torus: of the circle of centres [mm]
  double minor_radius = 0;  ///< torus: of the tube [mm]
  double half_angle = 0;    ///< cone, in (-pi/2, pi/2) [rad]
};

/// A point inside a face with the normal out of the product.
struct Sample {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;
};

/// An edge as a face uses it, in the direction that keeps the face on its left, seen from outside.
struct EdgeUse {
  int edge = 0;
  bool is_reversed = false;
};

struct Face {
  Surface surface;
  double side = 1;   ///< +1: the product is on the axis' side of a round surface (a shaft), -1: a
                     ///< hole; plane: +1 when its axis is the normal out of the product
  double area = 0;   ///< [mm^2]
  double sweep = 0;  ///< angle of a round face about its own axis [rad]; 2 pi when closed
  std::vector<std::vector<EdgeUse>> loops;
  std::vector<Sample> samples;  ///< at least one; a grid when the surface is of no kind
  /// Integrals of n dA and of p n^T dA: flux through the face in any frame.
  Eigen::Vector3d normal_integral = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moment_integral = Eigen::Matrix3d::Zero();
};

enum class CurveKind { Line, Circle, Other };

struct Edge {
  CurveKind kind = CurveKind::Other;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< circle
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();   ///< circle: its sense is counter-clockwise
  double radius = 0;                                 ///< circle
  std::vector<Eigen::Vector3d> points;  ///< on the curve, from start to end; a line has two
  std::array<int, 2> vertices{-1, -1};  ///< equal for a closed edge
  std::vector<int> faces;               ///< one twice for a seam
  bool is_seam = false;
  double angle = 0;       ///< between the normals of its two faces at its middle [rad]
  bool is_convex = true;  ///< the material fills less than a half space there
};

struct Model {
  std::string name;
  std::vector<Face> faces;
  std::vector<Edge> edges;
  std::vector<Eigen::Vector3d> vertices;
  double volume = 0;                              ///< [mm^3]
  bool has_cavity = false;                        ///< more than one closed skin
  Eigen::Vector3d low = Eigen::Vector3d::Zero();  ///< extents of vertices and edge points
  Eigen::Vector3d high = Eigen::Vector3d::Zero();
};

/// The normal of a round or plane surface away from its axis or along its own, at a point on it.
Eigen::Vector3d natural_normal(const Surface& surface, const Eigen::Vector3d& point);

/// Flux of (x, y, 0)/2 in the frame (origin, axis) through a face, out of the product: the volume
/// between the face and the axis [mm^3].
double flux(const Face& face, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis);

}  // namespace ridgeline::part
