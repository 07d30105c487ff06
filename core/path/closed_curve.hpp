#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "core/base/progress.hpp"

namespace ridgeline::path {

/// A polynomial of degree 5 over [from, to], by its Bernstein coefficients.
struct CurvePiece {
  double from = 0, to = 0;
  std::array<Eigen::Vector3d, 6> b;
};

/// A closed curve over u in [start, start + 1] as polynomial pieces, so that bounds over whole
/// intervals follow from convex hulls of coefficients. Continuous; ascending pieces without gaps.
struct ClosedCurve {
  std::vector<CurvePiece> pieces;
  double error = 0;  ///< bound of |true curve - pieces| at equal u [mm], see model()
};

/// Interpolates a periodic curve (period 1) piece by piece, starting new pieces at `breaks`
/// (ascending, first = start, last = start + 1) and halving until the difference at checks between
/// the nodes, doubled, is at most `tolerance`. Throws Error{NotConverged} when a piece of 2^-40
/// does not reach it (the curve is not continuous).
ClosedCurve model(const std::function<Eigen::Vector3d(double u)>& curve,
                  const std::vector<double>& breaks, double tolerance,
                  const Progress& progress = {});

/// The point at u in [start, start + 1].
Eigen::Vector3d point_at(const ClosedCurve& curve, double u);

/// Bound of the distance of the curve between a < b to the chord from point a to point b, at most
/// `enough` or else as tight as can be had [mm]. The curve's own error is not added.
double chord_bound(const ClosedCurve& curve, double a, double b, double enough);

/// Integral of sqrt(curvature) ds from the start to each u of a fine grid.
struct CurvatureTable {
  std::vector<double> u;
  std::vector<double> integral;
};
CurvatureTable curvature_table(const ClosedCurve& curve, const Progress& progress = {});

}  // namespace ridgeline::path
