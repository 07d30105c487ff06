#pragma once

#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/chamfer/section.hpp"
#include "core/geometry/ridge.hpp"

namespace ridgeline::chamfer {

/// More points than this in one loop are refused.
inline constexpr int point_limit = 2'000'000;

/// How the closed tool path round an edge is cut into points.
struct Sampling {
  double tolerance = 0.005;   ///< TA: largest distance of ideal path to polyline [mm], > 0
  std::optional<int> points;  ///< that many equal steps of u instead of choosing by tolerance, >= 3
  double start_u = 0;         ///< profile parameter of the first point
  bool reversed = false;      ///< true: in descending u
  int limit = point_limit;    ///< most points allowed
};

/// The closed polyline of tool centres, hole frame, cutting order. The first point is at start_u
/// and is not repeated at the end; the last chord returns to it.
struct Loop {
  std::vector<double> parameter;     ///< u in [0, 1) of each point
  std::vector<SectionPoint> points;  ///< by the chamfer's method
  int points_optimal = 0;            ///< N_opt = ceil(integral sqrt(kappa) ds / sqrt(8 TA))
  double chord_error = 0;            ///< certified bound of ideal path to polyline [mm]
};

/// Target points with equal chord error, [0071]..[0075] (design: section 6). Throws
/// Error: ToleranceTooSmall (more points than the limit, or finer than the numbers are),
/// WidthTooLarge, SweptNotReached (with u and P in the work frame), BadInput (tolerance, points, W,
/// D), Cancelled.
Loop loop(const geometry::Edge& edge, const Chamfer& chamfer, const Sampling& sampling,
          const Progress& progress = {});

}  // namespace ridgeline::chamfer
