#pragma once

#include <optional>
#include <vector>

#include "core/cutting/station.hpp"
#include "core/geometry/ridge.hpp"

namespace ridgeline::cutting {

/// One point of our own path round an edge, as the chamfer solver gives it. Frame: work.
struct ChamferPoint {
  Eigen::Vector3d target;     ///< P, on the ridge
  Eigen::Vector3d centre;     ///< C
  Eigen::Vector3d G1, G2;     ///< chamfer borders on the body and on the hole wall
  Eigen::Vector3d direction;  ///< unit, of the feed
  double feed = 0;            ///< per tooth [mm]
  std::optional<Eigen::Vector3d> earlier_centre;  ///< of the pass before, which has cut there
};

/// The wedge of the edge at a point: body surface and hole wall, the wall as the cylinder or plane
/// that it is there. The wanted surface is the middle of the chamfer, borders are G1 and G2.
Station chamfer_station(const geometry::Edge& edge, const ChamferPoint& point, double radius);

/// Width of the chamfer where the errors at G1 and G2 are e1 and e2: the ball ends r - e from C
/// there. 0 where it does not reach a face [mm].
double chamfer_width(const geometry::Edge& edge, const ChamferPoint& point, double e1, double e2);

/// Unit directions along a path of points: towards the next, averaged with from the one before.
std::vector<Eigen::Vector3d> directions(const std::vector<Eigen::Vector3d>& points);

}  // namespace ridgeline::cutting
