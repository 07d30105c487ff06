#pragma once

#include <optional>
#include <string>

#include "core/units/product.hpp"
#include "core/units/region.hpp"
#include "jobs/units_nc.hpp"

namespace ridgeline::jobs {

/// A tilted work plane as the machine sees it, once the spindle stands at its angle.
struct TiltedPlane {
  nc::LathePlane plane;
  Eigen::Vector3d x, y, z;  ///< its axes, unit, in the machine frame before the spindle turns
  Eigen::Vector3d origin;   ///< likewise

  /// In the plane's coordinates.
  Eigen::Vector3d point(const Eigen::Vector3d& p) const {
    return {(p - origin).dot(x), (p - origin).dot(y), (p - origin).dot(z)};
  }
};

/// The plane across `outwards`, towards the tool, with its origin on the line through `point` that
/// runs so; machine frame. Absent where `why` tells: it leans towards the chuck, or so little that
/// its origin at X 0 is out of reach.
struct Tilt {
  std::optional<TiltedPlane> plane;
  std::string why;
};
Tilt tilted_plane(const Eigen::Vector3d& point, const Eigen::Vector3d& outwards,
                  const nc::LatheProgram& program);

/// How far above `point` along `outwards` a tool of that diameter is clear of the region turned
/// about the axis [mm]; product frame.
double clear_height(const units::Region& material, const Eigen::Vector3d& point,
                    const Eigen::Vector3d& outwards, double diameter);

}  // namespace ridgeline::jobs
