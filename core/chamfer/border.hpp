#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/chamfer/section.hpp"

namespace ridgeline::chamfer {

/// How the borders of the chamfer run on at a section point: derivatives by the profile parameter
/// u, hole frame.
struct BorderRates {
  Eigen::Vector3d G1;  ///< dG1/du [mm]
  Eigen::Vector3d G2;  ///< dG2/du [mm]
  Eigen::Vector3d P;   ///< dP/du [mm]
  Eigen::Vector3d P2;  ///< d2P/du2 [mm], second derivative of the ridge, near that of the borders
};

/// Implicit differentiation of the section method's equations (design: section 4) at a point that
/// section_at() gave for u. At a joint of the profile: of the side that profile_at(u) is on.
BorderRates border_rates(const Section& section, const SectionPoint& point, double u);

/// Parameters near the joints of the profile where G2, which is not in the same generator as P,
/// crosses them: the borders bend differently before and behind. Not sorted, not wrapped to [0, 1);
/// none for a circle and where no chamfer is possible.
std::vector<double> wall_breaks(const Section& section);

}  // namespace ridgeline::chamfer
