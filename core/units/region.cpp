#include "core/units/region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/units/tolerance.hpp"

namespace ridgeline::units {
namespace {

std::size_t root_of(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// One past the last cell of the slab that starts at `first`.
std::size_t slab_end(const Region& region, std::size_t first) {
  std::size_t end = first;
  while (end < region.cells.size() && region.cells[end].z0 == region.cells[first].z0) ++end;
  return end;
}

bool is_joined(const Cell& below, const Cell& above) {
  const double z = above.z0;
  const double r0 = std::max(radius_at(below.inner, z), radius_at(above.inner, z));
  const double r1 = std::min(radius_at(below.outer, z), radius_at(above.outer, z));
  return r1 - r0 > vertex_tolerance;
}

}  // namespace

double volume(const Region& region) {
  double sum = 0;
  for (const Cell& cell : region.cells) {
    sum += squared_integral(cell.outer, cell.z0, cell.z1) -
           squared_integral(cell.inner, cell.z0, cell.z1);
  }
  return sum * std::numbers::pi;
}

double area(const Region& region) {
  double sum = 0;
  for (const Cell& cell : region.cells) {
    sum += integral(cell.outer, cell.z0, cell.z1) - integral(cell.inner, cell.z0, cell.z1);
  }
  return sum;
}

Box box(const Region& region) {
  if (is_empty(region)) return {};
  Box found{.r0 = HUGE_VAL, .r1 = 0, .z0 = region.cells.front().z0, .z1 = region.cells.back().z1};
  for (const Cell& cell : region.cells) {
    found.r0 = std::min(found.r0, range(cell.inner, cell.z0, cell.z1).min);
    found.r1 = std::max(found.r1, range(cell.outer, cell.z0, cell.z1).max);
  }
  return found;
}

// Radial thickness of a slab piece, but no more than its height summed over the slabs that it goes
// on through.
double thickness(const Region& region) {
  const Box extents = box(region);
  double widest = 0;
  for (const Cell& cell : region.cells) {
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double z = cell.z0 + t * (cell.z1 - cell.z0);
      widest = std::max(widest, radius_at(cell.outer, z) - radius_at(cell.inner, z));
    }
  }
  return std::min(widest, extents.z1 - extents.z0);
}

bool covers(const Region& region, const Point& point, double margin) {
  for (const Cell& cell : region.cells) {
    if (point.z < cell.z0 || point.z > cell.z1) continue;
    if (point.r >= radius_at(cell.inner, point.z) - margin &&
        point.r <= radius_at(cell.outer, point.z) + margin) {
      return true;
    }
  }
  return false;
}

Region rectangle(double r0, double r1, double z0, double z1) {
  if (!(r1 - r0 > merge_tolerance && z1 - z0 > merge_tolerance)) return {};
  return {{{.z0 = z0,
            .z1 = z1,
            .inner = {.a = {r0, z0}, .b = {r0, z1}},
            .outer = {.a = {r1, z0}, .b = {r1, z1}}}}};
}

std::vector<Region> pieces(const Region& region) {
  std::vector<std::size_t> parent(region.cells.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (std::size_t first = 0; first < region.cells.size();) {
    const std::size_t next = slab_end(region, first);
    const std::size_t end = next < region.cells.size() ? slab_end(region, next) : next;
    for (std::size_t i = first; i < next; ++i) {
      for (std::size_t j = next; j < end; ++j) {
        if (region.cells[i].z1 == region.cells[j].z0 &&
            is_joined(region.cells[i], region.cells[j])) {
          parent[root_of(parent, j)] = root_of(parent, i);
        }
      }
    }
    first = next;
  }
  std::vector<Region> found;
  std::vector<std::size_t> place(region.cells.size(), region.cells.size());
  for (std::size_t i = 0; i < region.cells.size(); ++i) {
    const std::size_t root = root_of(parent, i);
    if (place[root] == region.cells.size()) {
      place[root] = found.size();
      found.emplace_back();
    }
    found[place[root]].cells.push_back(region.cells[i]);
  }
  return found;
}

}  // namespace ridgeline::units
