#pragma once

#include <Eigen/Core>
#include <memory>
#include <variant>
#include <vector>

#include "core/cutting/height_map.hpp"

namespace ridgeline::cutting {

/// Material where P.n <= h, P from O' (ball centre, or a point of the axis of a square mill).
struct HalfSpace {
  Eigen::Vector3d n;  ///< unit, out of the material
  double h = 0;       ///< [mm]
};

enum class MaterialSide { Inside, Outside };

/// Material inside or outside a circular cylinder. A groove of an earlier pass is one that has its
/// material outside, its axis along the feed and the radius of the tool.
struct Round {
  Eigen::Vector3d centre;  ///< a point of the axis, from O' [mm]
  Eigen::Vector3d axis;    ///< unit
  double R = 0;            ///< [mm]
  MaterialSide material = MaterialSide::Outside;
};

using Face = std::variant<HalfSpace, Round>;

/// All: a convex edge, material where every face says so. Any: a concave edge.
enum class Combine { All, Any };

/// What the tool meets on one segment of its path: (faces combined) and outside every groove and
/// under the height map. Frame of the cut: origin O', Y+ the feed seen along the tool axis, Z+ from
/// the tip to the spindle.
struct Stock {
  std::vector<Face> faces;
  Combine combine = Combine::All;
  std::vector<Round> grooves;
  std::shared_ptr<const HeightMap> map;                    ///< may be null
  Eigen::Vector3d map_origin = Eigen::Vector3d::Zero();    ///< O' in the frame of the map
  Eigen::Matrix3d map_axes = Eigen::Matrix3d::Identity();  ///< X, Y, Z of the cut in that frame
};

}  // namespace ridgeline::cutting
