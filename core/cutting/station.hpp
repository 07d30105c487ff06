#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/cutting/cut.hpp"
#include "core/tool/tool.hpp"

namespace ridgeline::cutting {

/// One place of a path: where the tool is, where it goes and what is there to cut. Frame: work,
/// stock included (positions from the work origin).
struct Station {
  Eigen::Vector3d centre;     ///< O' [mm]
  Eigen::Vector3d direction;  ///< unit, of the feed
  Eigen::Vector3d n;          ///< unit, contact point of the wanted surface -> O'
  double feed = 0;            ///< per tooth [mm]
  Stock stock;
  /// Unit, other contact points -> O' at which the error is wanted too, e.g. the chamfer's borders.
  std::vector<Eigen::Vector3d> borders;
};

/// What stays the same along a path.
struct Course {
  Cutter cutter;
  tool::Coefficients coefficients;
  Eigen::Vector3d tool_axis = Eigen::Vector3d::UnitZ();  ///< tip to spindle
  tool::SpindleSense spindle = tool::SpindleSense::Clockwise;
  int samples = 1024;
  int earlier_teeth = 1;
  ChipEnd chip_end = ChipEnd::PreviousTooth;
};

/// Axes of the frame of the cut in the work frame as columns: Z the tool axis, Y the feed seen
/// along it, X to the right of the feed for a clockwise spindle. A counter-clockwise tool is the
/// mirror image of a clockwise one, so its X points the other way.
Eigen::Matrix3d cut_axes(const Course& course, const Eigen::Vector3d& direction);

/// The engagement of a station, in its own frame.
Cut cut_at(const Course& course, const Station& station);

/// Principal directions of the machine in X and Y of the cut: the work axes X and Y seen along the
/// tool axis (of a tool along X: Y and Z).
Eigen::Matrix2d machine_axes(const Course& course, const Eigen::Vector3d& direction);

}  // namespace ridgeline::cutting
