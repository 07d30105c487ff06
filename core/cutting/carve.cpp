#include "core/cutting/carve.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline::cutting {
namespace {

double ball_height(const Eigen::Vector3d& centre, double r, const Eigen::Vector2d& at,
                   double none) {
  const double room = r * r - (at - centre.head<2>()).squaredNorm();
  return room >= 0 ? centre.z() - std::sqrt(room) : none;
}

}  // namespace

// The sweep is a capsule: both balls and, between them, a cylinder. The vertical line through
// (x, y) meets the cylinder where |w - (w.u) u| = r, w = point - from: a z^2 + 2 b z + c = 0.
double swept_height(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double r,
                    const Eigen::Vector2d& at, double none) {
  const double lowest = std::min(ball_height(from, r, at, none), ball_height(to, r, at, none));
  const double length = (to - from).norm();
  constexpr double no_way = 1e-9;  // mm
  if (length < no_way) return lowest;
  const Eigen::Vector3d u = (to - from) / length;
  const Eigen::Vector2d level = at - from.head<2>();
  const double along = level.dot(u.head<2>());
  const double a = 1 - u.z() * u.z();
  const double b = -along * u.z();
  const double c = level.squaredNorm() - along * along - r * r;
  const double room = b * b - a * c;
  constexpr double upright = 1e-12;
  if (a < upright || room < 0) return lowest;
  const double z = (-b - std::sqrt(room)) / a;
  const double foot = along + z * u.z();
  return foot >= 0 && foot <= length ? std::min(lowest, from.z() + z) : lowest;
}

void carve(HeightMap& map, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double r) {
  const auto node = [&](double place, double origin, int nodes) {
    return static_cast<int>(
        std::clamp((place - origin) / map.cell, -1.0, static_cast<double>(nodes)));
  };
  const int left = std::max(0, node(std::min(from.x(), to.x()) - r, map.origin.x(), map.columns));
  const int right = std::min(map.columns - 1,
                             node(std::max(from.x(), to.x()) + r, map.origin.x(), map.columns) + 1);
  const int low = std::max(0, node(std::min(from.y(), to.y()) - r, map.origin.y(), map.rows));
  const int high =
      std::min(map.rows - 1, node(std::max(from.y(), to.y()) + r, map.origin.y(), map.rows) + 1);
  for (int row = low; row <= high; ++row) {
    for (int column = left; column <= right; ++column) {
      const Eigen::Vector2d at = map.origin + map.cell * Eigen::Vector2d(column, row);
      double& height =
          map.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns) +
                      static_cast<std::size_t>(column)];
      height = std::min(height, swept_height(from, to, r, at, height));
    }
  }
}

HeightMap block_map(const Eigen::Vector3d& min, const Eigen::Vector3d& max, double cell) {
  HeightMap map;
  map.origin = min.head<2>();
  map.cell = cell;
  map.columns = static_cast<int>(std::ceil((max.x() - min.x()) / cell)) + 1;
  map.rows = static_cast<int>(std::ceil((max.y() - min.y()) / cell)) + 1;
  map.heights.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows),
                     max.z());
  return map;
}

}  // namespace ridgeline::cutting
