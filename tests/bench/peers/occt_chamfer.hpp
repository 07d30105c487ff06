#pragma once

#include <limits>
#include <string>

#include "core/geometry/workpiece.hpp"

namespace ridgeline::bench {

/// What Open CASCADE makes of the chamfer of an edge.
struct OcctChamfer {
  double solid_seconds = 0;    ///< the solid by boolean operations: what any CAM station has
  double chamfer_seconds = 0;  ///< BRepFilletAPI_MakeChamfer on it
  std::string failure;         ///< why there is no chamfer
  /// Chord of the chamfer in the plane square to the ridge, over the edge [mm].
  double width_min = std::numeric_limits<double>::infinity(), width_max = 0;
  double sample_seconds = 0;  ///< the ridge as a polyline within the tolerance
  int sample_points = 0;
};

/// The symmetric chamfer with distance `leg` on both faces, of the entry edge of the first hole of
/// a tube without oblique holes; its ridge sampled to `tolerance` [mm].
OcctChamfer occt_chamfer(const geometry::Workpiece& tube, geometry::EdgeKind kind, double leg,
                         double tolerance);

}  // namespace ridgeline::bench
