#include "jobs/contour.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <map>
#include <utility>

namespace ridgeline::jobs {
namespace {

using Eigen::Vector2d;

// An edge of the grid: its lower-left node and direction (0: along x, 1: along y). A contour
// crosses each at most once.
struct GridEdge {
  int i, j, direction;
  auto operator<=>(const GridEdge&) const = default;  // NOLINT(modernize-use-nullptr): no pointer
};

// Sampled field with a border of +1 outside the rectangle, which closes the curves.
struct Grid {
  Vector2d min, step;
  int nodes;  // per side, border included
  std::vector<double> values;

  double at(int i, int j) const { return values[static_cast<std::size_t>(j * nodes + i)]; }
  Vector2d node(int i, int j) const {
    const auto clamp = [this](int k) {
      return static_cast<double>(std::clamp(k - 1, 0, nodes - 3));
    };
    return min + step.cwiseProduct(Vector2d(clamp(i), clamp(j)));
  }
  Vector2d crossing(const GridEdge& e) const {
    const int i1 = e.i + (e.direction == 0 ? 1 : 0);
    const int j1 = e.j + (e.direction == 1 ? 1 : 0);
    const double a = at(e.i, e.j);
    const double b = at(i1, j1);
    return node(e.i, e.j) + (node(i1, j1) - node(e.i, e.j)) * (a / (a - b));
  }
};

Grid sample(const std::function<double(const Vector2d&)>& field, const Vector2d& min,
            const Vector2d& max, int cells) {
  Grid grid{.min = min, .step = (max - min) / cells, .nodes = cells + 3, .values = {}};
  grid.values.assign(static_cast<std::size_t>(grid.nodes * grid.nodes), 1.0);
  for (int j = 1; j <= cells + 1; ++j) {
    for (int i = 1; i <= cells + 1; ++i) {
      grid.values[static_cast<std::size_t>(j * grid.nodes + i)] = field(grid.node(i, j));
    }
  }
  return grid;
}

// The directed pieces of one cell: from the grid edge where the curve enters to the one where it
// leaves.
std::vector<std::pair<GridEdge, GridEdge>> pieces(const Grid& grid, int i, int j) {
  const std::array<GridEdge, 4> sides{GridEdge{i, j, 0}, GridEdge{i + 1, j, 1},
                                      GridEdge{i, j + 1, 0}, GridEdge{i, j, 1}};
  const std::array<bool, 4> in{grid.at(i, j) < 0, grid.at(i + 1, j) < 0, grid.at(i + 1, j + 1) < 0,
                               grid.at(i, j + 1) < 0};
  // Counter-clockwise round the cell, side k runs from corner k to corner k + 1. With the negative
  // side on the left, a curve leaves the cell where corners go out -> in and enters it where they
  // go in -> out.
  std::vector<std::pair<GridEdge, GridEdge>> out;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!(in[k] && !in[(k + 1) % 4])) continue;
    for (std::size_t n = 1; n < 4; ++n) {
      const std::size_t l = (k + n) % 4;
      if (!in[l] && in[(l + 1) % 4]) {
        out.emplace_back(sides[k], sides[l]);
        break;
      }
    }
  }
  return out;
}

}  // namespace

std::vector<std::vector<Vector2d>> contours(const std::function<double(const Vector2d&)>& field,
                                            const Vector2d& min, const Vector2d& max, int cells) {
  const Grid grid = sample(field, min, max, cells);
  std::map<GridEdge, GridEdge> next;
  for (int j = 0; j + 1 < grid.nodes; ++j) {
    for (int i = 0; i + 1 < grid.nodes; ++i) {
      for (const auto& [from, to] : pieces(grid, i, j)) next.emplace(from, to);
    }
  }
  std::vector<std::vector<Vector2d>> curves;
  while (!next.empty()) {
    std::vector<Vector2d> curve;
    for (auto at = next.begin(); at != next.end();) {
      const GridEdge to = at->second;
      curve.push_back(grid.crossing(at->first));
      next.erase(at);
      at = next.find(to);
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace ridgeline::jobs
