#include "core/geometry/ridge.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/text.hpp"

namespace ridgeline::geometry {
namespace {

[[noreturn]] void refuse(double u) {
  throw Error(
      ErrorCode::HoleMissesBody,
      "the generator of the hole wall at u = " + text(u) + " does not meet the body surface",
      {.parameter = u});
}

// Height where the generator line of the wall through p meets the body: [E 4] for q.
double height_at(const RidgeLine& ridge, const Eigen::Vector2d& p, double u) {
  const Body& F = ridge.F;
  if (F.a == 0) return -(F.n.x() * p.x() + F.n.y() * p.y() + F.c) / F.n.z();
  if (ridge.merged) {
    return (height_across(*ridge.merged, ridge.profile, u) - F.hy * p.y()) * ridge.over_hz;
  }
  const double x = p.x() + F.f;
  const double square = (ridge.R1 - x) * (ridge.R1 + x);
  if (!(square > 0)) refuse(u);
  return (ridge.side * std::sqrt(square) - F.hy * p.y()) * ridge.over_hz;
}

}  // namespace

RidgeLine ridge_line(const Edge& edge) {
  RidgeLine line{.F = {},
                 .profile = edge.profile,
                 .m = edge.m,
                 .R1 = 0,
                 .over_hz = 1,
                 .side = edge.side == Side::Entry ? 1. : -1.,
                 .merged = edge.merged};
  if (const auto* cylinder = std::get_if<Cylinder>(&edge.body)) {
    // The axis passes (-f, 0, 0) and has no x part; q is measured across it, upwards.
    const Eigen::Vector3d& A1 = cylinder->axis;
    const double up = A1.y() < 0 ? -1 : 1;
    line.R1 = cylinder->radius;
    line.over_hz = up / A1.y();
    line.F = {.a = 1 / cylinder->radius,
              .f = -cylinder->point.x(),
              .hy = -up * A1.z(),
              .hz = up * A1.y(),
              .c = -cylinder->radius / 2};
  } else {
    const Plane& plane = std::get<Plane>(edge.body);
    line.F.n = plane.normal;
    line.F.c = -plane.normal.dot(plane.point);
  }
  return line;
}

// Document 000, [0087]..[0093], any profile and body (design: section 3).
RidgePoint ridge_at(const RidgeLine& ridge, const ProfilePoint& profile, double u) {
  const double m = ridge.m;
  const Eigen::Vector2d& t2 = profile.tangent;
  const Eigen::Vector3d P(profile.p.x(), profile.p.y(),
                          height_at(ridge, profile.p, u));  // [E 2..7]
  const Eigen::Vector3d n1 = gradient(ridge.F, P);
  const Eigen::Vector3d n2(profile.normal.x(), profile.normal.y(), 0);  // = e1 [E 8]
  // n1 in the frame (n2, t2, z'); (w, zeta) / s is e2 in it.
  const double c = m * n1.head<2>().dot(profile.normal);  // = -cos(theta)
  const double w = m * n1.head<2>().dot(t2);
  const double zeta = m * n1.z();
  const double s = std::sqrt(w * w + zeta * zeta);  // = sin(theta) = |n1 x n2|
  const double over_s = 1 / s;
  const double tau = over_s * w;
  const double rho = over_s * zeta;
  return {.P = P,
          .n1 = n1,
          .n2 = n2,
          .t = m * Eigen::Vector3d(rho * t2.x(), rho * t2.y(), -tau),  // n1 x n2 / s
          .e1 = n2,
          .e2 = {tau * t2.x(), tau * t2.y(), rho},  // [E 9]
          .theta = std::acos(std::clamp(-c, -1., 1.))};
}

ProfilePoint profile_at(const RidgeLine& ridge, double u) {
  return profile_at(ridge.profile, ridge.merged ? profile_parameter(*ridge.merged, u) : u);
}

std::vector<double> passages(const RidgeLine& ridge, double v) {
  return ridge.merged ? passages(*ridge.merged, v) : std::vector<double>{v};
}

bool is_forward(const RidgeLine& ridge, double u) {
  return !ridge.merged || std::cos(2 * std::numbers::pi * u) > 0;
}

// t.t2 = n1.z' / sin(theta), and of a cylinder n1.z' = a hz q: where a merged edge turns, q and the
// rate of the profile vanish together.
double ridge_rate(const RidgeLine& ridge, const RidgePoint& point, const ProfilePoint& profile,
                  double u) {
  const double L = perimeter(ridge.profile);
  if (!ridge.merged) return L / point.t.head<2>().dot(profile.tangent);
  const double s = ridge.m * point.n1.dot(point.e2);
  return L * ridge.merged->half * 2 * std::numbers::pi * s /
         (ridge.F.a * ridge.F.hz * height_rate(*ridge.merged, ridge.profile, u));
}

RidgePoint ridge_at(const RidgeLine& ridge, double u) {
  return ridge_at(ridge, profile_at(ridge, u), u);
}

RidgePoint ridge_at(const Edge& edge, double u) {
  return ridge_at(ridge_line(edge), u);
}

}  // namespace ridgeline::geometry
