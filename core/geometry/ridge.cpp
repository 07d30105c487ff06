#include "core/geometry/ridge.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "core/base/error.hpp"

namespace ridgeline::geometry {
namespace {

// Height where the generator line of the wall through p meets F = 0. With p fixed F is a quadratic
// in z, A z^2 / 2 + B z + C; a plane has A = 0. For the source's cylinder this is [E 4].
double height_at(const RidgeLine& ridge, const Eigen::Vector2d& p, double u) {
  const Eigen::Vector3d base(p.x(), p.y(), 0);
  const double A = ridge.F.Q(2, 2);
  const double B = gradient(ridge.F, base).z();
  const double C = value(ridge.F, base);
  if (A == 0) return -C / B;
  const double square = B * B - 2 * A * C;
  if (!(square > 0)) {
    throw Error(ErrorCode::HoleMissesBody,
                "the generator of the hole wall at u = " + std::to_string(u) +
                    " does not meet the body surface",
                {.parameter = u});
  }
  const double root = std::sqrt(square);
  return (-B + (ridge.side == Side::Entry ? root : -root)) / A;
}

}  // namespace

RidgeLine ridge_line(const Edge& edge) {
  return {.F = quadric(edge.body), .profile = edge.profile, .m = edge.m, .side = edge.side};
}

// Document 000, [0087]..[0093], any profile and body (design: section 3).
RidgePoint ridge_at(const RidgeLine& ridge, const ProfilePoint& profile, double u) {
  const double m = ridge.m;
  const Eigen::Vector3d P(profile.p.x(), profile.p.y(),
                          height_at(ridge, profile.p, u));  // [E 2..7]
  const Eigen::Vector3d n1 = gradient(ridge.F, P);
  const Eigen::Vector3d n2(profile.normal.x(), profile.normal.y(), 0);  // = e1 [E 8]
  const double c = m * n1.dot(n2);                                      // = -cos(theta)
  const Eigen::Vector3d v = m * n1 - c * n2;
  const double s = v.norm();  // = sin(theta) = |n1 x n2|
  return {.P = P,
          .n1 = n1,
          .n2 = n2,
          .t = n1.cross(n2) / s,
          .e1 = n2,
          .e2 = v / s,  // [E 9]
          .theta = std::atan2(s, -c)};
}

RidgePoint ridge_at(const RidgeLine& ridge, double u) {
  return ridge_at(ridge, profile_at(ridge.profile, u), u);
}

RidgePoint ridge_at(const Edge& edge, double u) {
  return ridge_at(ridge_line(edge), u);
}

}  // namespace ridgeline::geometry
