#pragma once

#include <vector>

#include "core/path/closed_curve.hpp"

namespace ridgeline::path {

/// Parameters that cut a closed curve into chords, ascending from the curve's start; the last chord
/// returns to the first point.
struct Chords {
  std::vector<double> u;   ///< in [start, start + 1)
  int optimal = 0;         ///< N_opt = ceil(integral sqrt(kappa) ds / sqrt(8 tolerance))
  double chord_error = 0;  ///< certified bound of true curve to polyline [mm], <= tolerance
};

/// Fewest chords with equal error (design: section 6): equal steps of the integral of
/// sqrt(curvature), evened out by the bounds of the chords; a point at each of `breaks`
/// (ascending, first = start, last = start + 1). Throws Error{ToleranceTooSmall} when more than
/// `limit` points would be needed. Needs curve.error < tolerance.
Chords equal_error_chords(const ClosedCurve& curve, const std::vector<double>& breaks,
                          double tolerance, int limit, const Progress& progress = {});

/// Certified bound of the true curve to the polyline through u (ascending, closed) [mm].
double chord_error(const ClosedCurve& curve, const std::vector<double>& u,
                   const Progress& progress = {});

}  // namespace ridgeline::path
