#pragma once

#include <Eigen/Core>
#include <array>

#include "core/units/product.hpp"
#include "jobs/units_nc.hpp"

namespace ridgeline::jobs {

/// The plane of a milled bottom as the machine sees it: a to the right, b up, h towards the tool.
struct MillingPlane {
  bool is_radial = true;
  double c = 0;                    ///< spindle angle [degrees]
  Eigen::Vector3d a, b, h;         ///< unit, machine frame
  double shift = 0;                ///< of b into the half plane of regions
  std::array<double, 2> origin{};  ///< along a and b: what coordinates count from

  units::Point in(const Eigen::Vector3d& p) const { return {p.dot(b) + shift, p.dot(a)}; }
};

/// The area that a cutter of radius R may cover: the bottom, and beyond its open edges. Sets the
/// plane's shift.
units::Region milled_area(const units::Product& product, const units::MilledFace& face,
                          const LatheFrame& frame, MillingPlane& plane, double R);

}  // namespace ridgeline::jobs
