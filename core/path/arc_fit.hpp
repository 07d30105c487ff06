#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/base/progress.hpp"
#include "core/path/motion.hpp"

namespace ridgeline::path {

/// Helical arcs (and straight moves) along a curve.
struct ArcFit {
  std::vector<Move> moves;         ///< kind Cut, feed 0: the caller sets both
  std::vector<std::size_t> index;  ///< of the point that each move ends at
  double error = 0;  ///< certified bound of true curve to moves and of moves to true curve [mm]
};

/// Few arcs in `plane` of `axes`, their height linear in the angle, that stay within `tolerance` of
/// the curve through `points` (ordered; 30 or more of them an arc: those of chords with
/// tolerance / 400 are enough). The first and the last point are met exactly; a closed curve
/// repeats its first point at the end. The joints between lie on the curve as seen along the
/// plane's normal; their height z is free within the tolerance, which makes an arc up to sqrt 2
/// longer. No arc turns more than half a turn.
///
/// What helical arcs can do: where z bends they need at least integral sqrt(|z''| / (16 tolerance))
/// ds of them, lines need integral sqrt(kappa / (8 tolerance)) ds. A plain cross hole R1 20, R2 5
/// gives 25 arcs for 86 lines; the flatter the edge, the greater the gain.
///
/// Certified: `curve_error` bounds the distance of the true curve to the polyline through the
/// points, piece by piece. At every point the distance to the place of the arc at the same angle
/// is measured, and between two points arc and chord are at most r step^2 / 8 apart;
/// the bound is curve_error + the largest of both, for both directions.
///
/// Throws Error{BadInput} for fewer than two points, neighbours that coincide, or a tolerance that
/// is not above curve_error; Error{NotConverged} when the points are too sparse for it.
ArcFit fit_arcs(const std::vector<Eigen::Vector3d>& points, double tolerance, double curve_error,
                ArcPlane plane = ArcPlane::XY,
                const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity(),
                const Progress& progress = {});

}  // namespace ridgeline::path
