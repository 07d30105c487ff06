#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/geometry/solid.hpp"
#include "core/geometry/trace.hpp"
#include "core/verify/band.hpp"

namespace ridgeline::verify {

/// The deepest cut outside the chamfer band and the place of the ball centre there.
struct Overcut {
  double depth = 0;       ///< [mm], 0: none
  std::size_t piece = 0;  ///< of the path
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

/// How deep a ball of radius D along a path cuts the material's boundary outside the chamfer band,
/// anywhere on the body. A boundary point q counts with D - (distance of q to the path), unless it
/// is in the band: on one of the two surfaces of the edge, between the ridge and the border that
/// the path itself cuts there (Band). So a clean chamfer of any width has none: its width is
/// measured elsewhere. Where the ball centre is inside the material and not in the tip that the
/// band takes off: D + its depth there. Found by following the path in steps of D / 25 and refining
/// every peak; then bounded between the places looked at, halving until nothing deeper by more than
/// 1e-5 mm is left (what arcs that stand for seams miss, geometry::seam_sag, may add as much).
Overcut overcut(const geometry::Edge& edge, const geometry::Solid& solid,
                const geometry::Trace& path, const Band& band,
                const std::vector<BandSection>& sections, double D, const Progress& progress = {});

}  // namespace ridgeline::verify
