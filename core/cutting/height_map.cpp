#include "core/cutting/height_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/cutting/require.hpp"

namespace ridgeline::cutting {
namespace {

constexpr double no_material = -1e30;

double node(const HeightMap& map, int column, int row) {
  return map.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns) +
                     static_cast<std::size_t>(column)];
}

}  // namespace

double height_at(const HeightMap& map, double x, double y) {
  const double u = (x - map.origin.x()) / map.cell;
  const double v = (y - map.origin.y()) / map.cell;
  if (!(u >= 0 && v >= 0 && u <= map.columns - 1 && v <= map.rows - 1)) return no_material;
  const int column = std::min(static_cast<int>(u), map.columns - 2);
  const int row = std::min(static_cast<int>(v), map.rows - 2);
  const double s = u - column;
  const double t = v - row;
  return (1 - t) * ((1 - s) * node(map, column, row) + s * node(map, column + 1, row)) +
         t * ((1 - s) * node(map, column, row + 1) + s * node(map, column + 1, row + 1));
}

double greatest_height(const HeightMap& map, double x, double y, double reach) {
  const auto clamped = [&map](double at, double from, int nodes) {
    return static_cast<int>(
        std::clamp(std::floor((at - from) / map.cell), 0.0, static_cast<double>(nodes - 1)));
  };
  const int left = clamped(x - reach, map.origin.x(), map.columns);
  const int right = std::min(clamped(x + reach, map.origin.x(), map.columns) + 1, map.columns - 1);
  const int low = clamped(y - reach, map.origin.y(), map.rows);
  const int high = std::min(clamped(y + reach, map.origin.y(), map.rows) + 1, map.rows - 1);
  double greatest = no_material;
  for (int row = low; row <= high; ++row) {
    for (int column = left; column <= right; ++column) {
      greatest = std::max(greatest, node(map, column, row));
    }
  }
  return greatest;
}

void validate(const HeightMap& map) {
  constexpr int most_nodes = 20000;
  require_between("/case/engagement/map/cell", map.cell, 1e-4, 1e3, "mm");
  require_between("/case/engagement/map/columns", map.columns, 2, most_nodes, "nodes");
  require_between("/case/engagement/map/rows", map.rows, 2, most_nodes, "nodes");
  const auto nodes = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
  if (map.heights.size() != nodes) {
    throw Error(ErrorCode::BadInput,
                "heights: " + std::to_string(map.heights.size()) + " values for " +
                    std::to_string(nodes) + " nodes",
                {.field = "/case/engagement/map/heights"});
  }
  for (const double height : map.heights) {
    require_between("/case/engagement/map/heights", height, -1e6, 1e6, "mm");
  }
}

}  // namespace ridgeline::cutting
