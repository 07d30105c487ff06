#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/cutting/chips.hpp"

namespace ridgeline::cutting {

/// A face or groove with what the search evaluates for every element taken out of it.
/// g(P) = P.a - h of a plane; sign (|P - c|^2 - ((P - c).a)^2 - R^2) of a cylinder.
struct Boundary {
  double sign = 0;  ///< 0 plane, +1 material inside a cylinder, -1 outside
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  Eigen::Vector3d c = Eigen::Vector3d::Zero();
  double h = 0;  ///< h, or R^2
};

/// Faces, then grooves.
std::vector<Boundary> boundaries(const Stock& stock);

/// g(U) at the displacement U of a point P: g0 + gx Ux + gy Uy + sign |U_perp|^2.
inline Term term_at(const Boundary& boundary, const Eigen::Vector3d& P) {
  const Eigen::Vector3d& a = boundary.a;
  if (boundary.sign == 0) return {P.dot(a) - boundary.h, a.x(), a.y()};
  const Eigen::Vector3d W = P - boundary.c;
  const double along = W.dot(a);
  return {boundary.sign * (W.squaredNorm() - along * along - boundary.h),
          boundary.sign * 2 * (W.x() - along * a.x()), boundary.sign * 2 * (W.y() - along * a.y())};
}

/// May P be inside for some |U| <= reach?
inline bool is_near(const Boundary& boundary, const Eigen::Vector3d& P, double reach) {
  const Term term = term_at(boundary, P);
  if (term.g0 <= 0) return true;
  const double slack = term.g0 - (boundary.sign < 0 ? reach * reach : 0);
  return slack <= 0 || slack * slack <= (term.gx * term.gx + term.gy * term.gy) * (reach * reach);
}

/// Is a point of this term inside for every U within `reach` of `centre`?
inline bool is_far_inside(const Boundary& boundary, const Term& term, const Eigen::Vector2d& centre,
                          double reach) {
  const Eigen::Vector2d a(boundary.a.x(), boundary.a.y());
  const double along = a.dot(centre);
  const double g = term.g0 + term.gx * centre.x() + term.gy * centre.y() +
                   boundary.sign * (centre.squaredNorm() - along * along);
  const Eigen::Vector2d slope =
      Eigen::Vector2d(term.gx, term.gy) + 2 * boundary.sign * (centre - along * a);
  return g + slope.norm() * reach + (boundary.sign > 0 ? reach * reach : 0) < 0;
}

}  // namespace ridgeline::cutting
