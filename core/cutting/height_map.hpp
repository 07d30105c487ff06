#pragma once

#include <Eigen/Core>
#include <vector>

namespace ridgeline::cutting {

/// Z-map: heights of arbitrary stock over a grid, material below. Read bilinearly: the nearest cell
/// costs 0.35 um and 24 N at 0.1 mm where this costs 0.08 um (design: engagement). Outside the grid
/// there is no material.
struct HeightMap {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< of the first node [mm]
  double cell = 0;                                   ///< distance of the nodes [mm]
  int columns = 0;                                   ///< nodes along X
  int rows = 0;                                      ///< nodes along Y
  std::vector<double> heights;                       ///< row by row [mm]
};

/// Height of the stock there; lower than everything outside the grid.
double height_at(const HeightMap& map, double x, double y);

/// Greatest height within `reach` of the point (it may look a little farther).
double greatest_height(const HeightMap& map, double x, double y, double reach);

/// Throws Error{BadInput}.
void validate(const HeightMap& map);

}  // namespace ridgeline::cutting
