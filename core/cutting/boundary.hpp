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

/// A boundary at one height: what a search asks of an element at every sample, g(x, y) with what
/// does not change taken out.
class Slice {
public:
  Slice(const Boundary& boundary, double z)
      : sign_(boundary.sign), ax_(boundary.a.x()), ay_(boundary.a.y()) {
    if (sign_ == 0) {
      always_ = boundary.a.z() * z - boundary.h;
      return;
    }
    cx_ = boundary.c.x();
    cy_ = boundary.c.y();
    const double up = z - boundary.c.z();
    always_ = boundary.a.z() * up;
    square_ = up * up - boundary.h;
  }

  /// May (x, y) be inside when displaced by some |U| <= reach?
  bool is_near(double x, double y, double reach) const {
    if (sign_ == 0) {
      const double g = ax_ * x + ay_ * y + always_;
      return g <= 0 || g * g <= (ax_ * ax_ + ay_ * ay_) * (reach * reach);
    }
    const double wx = x - cx_;
    const double wy = y - cy_;
    const double along = ax_ * wx + ay_ * wy + always_;
    const double g = sign_ * (wx * wx + wy * wy + square_ - along * along);
    if (g <= 0) return true;
    const double slack = g - (sign_ < 0 ? reach * reach : 0);
    const double gx = 2 * (wx - along * ax_);
    const double gy = 2 * (wy - along * ay_);
    return slack <= 0 || slack * slack <= (gx * gx + gy * gy) * (reach * reach);
  }

private:
  double sign_, ax_, ay_;
  double always_ = 0;       // of a plane g, of a cylinder the place along its axis
  double cx_ = 0, cy_ = 0;  // of the axis of a cylinder
  double square_ = 0;       // what a cylinder adds to |W|^2
};

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
