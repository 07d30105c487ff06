#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/break_out.hpp"
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
  Side side = Side::Entry;              ///< entry: the meeting point of greater z'
  std::vector<Bound> bounds;            ///< a chamfer must keep inside each
  std::optional<BreakOut> merged = {};  ///< of a hole that breaks out: entry and exit are one curve
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

/// A body surface in the hole frame, where a cylinder's axis A1 has no x' part: with
/// q = hy y + hz z (distance from A1 across x'),
///   F = a ((x + f)^2 + q^2) / 2 + n.p + c = 0,
/// scaled so that grad F is the unit normal on the surface. Cylinder: a = 1 / R1, n = 0. Plane:
/// a = 0. The Hessian is a (x x^T + h h^T).
struct Body {
  double a = 0, f = 0, hy = 0, hz = 0;
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  double c = 0;
};

inline double value(const Body& F, const Eigen::Vector3d& p) {
  const double x = p.x() + F.f;
  const double q = F.hy * p.y() + F.hz * p.z();
  return 0.5 * F.a * (x * x + q * q) + F.n.dot(p) + F.c;
}
inline Eigen::Vector3d gradient(const Body& F, const Eigen::Vector3d& p) {
  const double q = F.a * (F.hy * p.y() + F.hz * p.z());
  return Eigen::Vector3d(F.a * (p.x() + F.f), q * F.hy, q * F.hz) + F.n;
}
/// H v with the Hessian H.
inline Eigen::Vector3d hessian_times(const Body& F, const Eigen::Vector3d& v) {
  const double q = F.a * (F.hy * v.y() + F.hz * v.z());
  return {F.a * v.x(), q * F.hy, q * F.hz};
}
/// v.H w.
inline double second(const Body& F, const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
  return F.a * (v.x() * w.x() + (F.hy * v.y() + F.hz * v.z()) * (F.hy * w.y() + F.hz * w.z()));
}

/// An edge made ready for many evaluations.
struct RidgeLine {
  Body F;              ///< body surface SS
  Profile profile;     ///< wall SW
  double m = 1;        ///< material sign
  double R1 = 0;       ///< of a cylinder, 0 for a plane [mm]
  double over_hz = 1;  ///< 1 / F.hz
  double side = 1;     ///< of q: +1 entry, -1 exit
  std::optional<BreakOut> merged = {};
};
RidgeLine ridge_line(const Edge& edge);

/// The point of the profile that the ridge at u stands over.
ProfilePoint profile_at(const RidgeLine& ridge, double u);

/// The u in [0, 1) at which the ridge stands over the point v of the profile: one; of a merged edge
/// two or none.
std::vector<double> passages(const RidgeLine& ridge, double v);

/// Does the profile parameter grow with u there? (Of a merged edge it swings to and fro.)
bool is_forward(const RidgeLine& ridge, double u);

/// The ridge at parameter u in [0, 1), counter-clockwise seen from +A2 from phi = 0; merged edges:
/// as BreakOut says.
/// Throws Error{HoleMissesBody} where the generator at u does not meet the body (an edge that
/// edge_of() did not make).
RidgePoint ridge_at(const Edge& edge, double u);
RidgePoint ridge_at(const RidgeLine& ridge, double u);

/// The same where the point of the profile at u is already known.
RidgePoint ridge_at(const RidgeLine& ridge, const ProfilePoint& profile, double u);

/// How fast P runs along its tangent t at u: dP/du = rate t [mm].
double ridge_rate(const RidgeLine& ridge, const RidgePoint& point, const ProfilePoint& profile,
                  double u);

}  // namespace ridgeline::geometry
