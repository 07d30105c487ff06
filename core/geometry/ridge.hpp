#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/geometry/frame.hpp"
#include "core/geometry/profile.hpp"
#include "core/geometry/surface.hpp"

namespace ridgeline::geometry {

enum class Side { Entry, Exit };

/// Where the wall or the body surface ends: the far side of the wall, the ends of the workpiece.
/// Hole frame.
struct Bound {
  Surface surface;
  double m = 1;      ///< material at m * distance > 0
  std::string name;  ///< for messages, e.g. "the outer surface"
};

/// One ridge line, in the hole frame: z' along A2, x' along A1 x A2, y' = z' x x' (towards A1).
/// Origin on A2 at the foot of the shortest line between A2 and A1, which passes x' = -f. Source:
/// document 000, [0066]..[0075], equations (2)..(7), written for any profile and body.
struct Edge {
  Frame frame;      ///< hole frame in work coordinates
  Profile profile;  ///< wall SW: the profile extruded along z'
  Surface body;     ///< SS, in the hole frame
  double m = 1;     ///< material sign: +1 material at body distance > 0 (bore), -1 at < 0 (outside)
  Side side = Side::Entry;    ///< entry: the meeting point of greater z'
  std::vector<Bound> bounds;  ///< a chamfer must keep inside each
  bool merged = false;  ///< broken-out hole: entry and exit are one curve, parametrised about A1
};

/// A point of the ridge with its section frame (design: sections 2 and 3; [E 2]..[E 10]). Hole
/// frame.
struct RidgePoint {
  Eigen::Vector3d P;   ///< machining target point [mm]
  Eigen::Vector3d n1;  ///< unit outward normal of SS (gradient of its distance)
  Eigen::Vector3d n2;  ///< unit outward normal of the profile (away from A2)
  Eigen::Vector3d t;   ///< unit tangent n1 x n2
  Eigen::Vector3d e1;  ///< = n2 [E 8]
  Eigen::Vector3d e2;  ///< along the wall into the material [E 9]
  double theta = 0;    ///< material wedge angle [rad]
};

/// An edge made ready for many evaluations.
struct RidgeLine {
  Quadric F;        ///< body surface SS
  Profile profile;  ///< wall SW
  double m = 1;
  Side side = Side::Entry;
};
RidgeLine ridge_line(const Edge& edge);

/// The ridge at parameter u in [0, 1), counter-clockwise seen from +A2 from phi = 0; merged edges:
/// angle about A1.
/// Throws Error{HoleMissesBody} where the generator at u does not meet the body (an edge that
/// edge_of() did not make).
RidgePoint ridge_at(const Edge& edge, double u);
RidgePoint ridge_at(const RidgeLine& ridge, double u);

/// The same where the point of the profile at u is already known.
RidgePoint ridge_at(const RidgeLine& ridge, const ProfilePoint& profile, double u);

}  // namespace ridgeline::geometry
