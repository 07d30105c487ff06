#include "part/outline.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ridgeline::part {
namespace {

using units::FaceEdge;

constexpr double same_point = 1e-4;  // [mm]

Eigen::Vector3d dropped(const Eigen::Vector3d& p, const Eigen::Vector3d& n, double bottom) {
  return p - (p.dot(n) - bottom) * n;
}

/// Rows of one edge as a face uses it.
std::vector<FaceEdge> rows_of(const Edge& edge, bool is_reversed, const Eigen::Vector3d& n,
                              double bottom) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : edge.points) points.push_back(dropped(p, n, bottom));
  if (is_reversed) std::reverse(points.begin(), points.end());
  const bool is_flat = edge.kind == CurveKind::Circle && edge.axis.cross(n).norm() < 1e-6;
  if (edge.kind != CurveKind::Line && !is_flat) {
    std::vector<FaceEdge> rows;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      rows.push_back({.start = points[i], .end = points[i + 1]});
    }
    return rows;
  }
  FaceEdge row{.start = points.front(), .end = points.back()};
  if (is_flat) {
    row.is_arc = true;
    row.centre = dropped(edge.centre, n, bottom);
    row.is_clockwise = (edge.axis.dot(n) > 0) == is_reversed;
  }
  return {row};
}

/// Puts rows end to end; what does not join starts another loop.
std::vector<std::vector<FaceEdge>> joined(std::vector<FaceEdge> rows) {
  std::vector<std::vector<FaceEdge>> loops;
  while (!rows.empty()) {
    std::vector<FaceEdge> loop{rows.back()};
    rows.pop_back();
    for (bool grows = true; grows;) {
      grows = false;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        FaceEdge row = rows[i];
        if ((row.end - loop.back().end).norm() < same_point) {
          std::swap(row.start, row.end);
          row.is_clockwise = !row.is_clockwise;
        }
        if ((row.start - loop.back().end).norm() >= same_point) continue;
        loop.push_back(row);
        rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(i));
        grows = true;
        break;
      }
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

double extent(const std::vector<FaceEdge>& loop) {
  Eigen::Vector3d low = loop.front().start;
  Eigen::Vector3d high = low;
  for (const FaceEdge& row : loop) {
    low = low.cwiseMin(row.start);
    high = high.cwiseMax(row.start);
  }
  return (high - low).norm();
}

void put_outer_first(std::vector<std::vector<FaceEdge>>& loops) {
  std::stable_sort(loops.begin(), loops.end(),
                   [](const auto& p, const auto& q) { return extent(p) > extent(q); });
}

}  // namespace

std::vector<std::vector<FaceEdge>> floor_outline(const Placed& part, const std::vector<int>& floors,
                                                 const Eigen::Vector3d& n, double bottom) {
  std::vector<std::vector<FaceEdge>> loops;
  for (const int number : floors) {
    const Face& face = part.model().faces[static_cast<std::size_t>(number)];
    if (std::abs(face.surface.origin.dot(n) - bottom) > same_point) continue;
    for (const std::vector<EdgeUse>& loop : face.loops) {
      std::vector<FaceEdge> rows;
      for (const EdgeUse& use : loop) {
        const Edge& edge = part.model().edges[static_cast<std::size_t>(use.edge)];
        for (const FaceEdge& row : rows_of(edge, use.is_reversed, n, bottom)) rows.push_back(row);
      }
      std::reverse(rows.begin(), rows.end());
      for (std::vector<FaceEdge>& one : joined(std::move(rows))) loops.push_back(std::move(one));
    }
  }
  put_outer_first(loops);
  return loops;
}

std::vector<std::vector<FaceEdge>> through_outline(const Placed& part,
                                                   const std::vector<int>& walls,
                                                   const Eigen::Vector3d& n, double bottom) {
  std::vector<FaceEdge> rows;
  for (const int number : walls) {
    const Face& face = part.model().faces[static_cast<std::size_t>(number)];
    // A wall's plan runs between the edges along n that bound it.
    std::vector<Eigen::Vector3d> ends;
    for (const std::vector<EdgeUse>& loop : face.loops) {
      for (const EdgeUse& use : loop) {
        for (const Eigen::Vector3d& point :
             part.model().edges[static_cast<std::size_t>(use.edge)].points) {
          const Eigen::Vector3d p = dropped(point, n, bottom);
          if (std::none_of(ends.begin(), ends.end(),
                           [&](const auto& q) { return (p - q).norm() < same_point; })) {
            ends.push_back(p);
          }
        }
      }
    }
    if (ends.size() < 2) continue;
    FaceEdge row;
    if (face.surface.kind == SurfaceKind::Cylinder) {
      row.is_arc = true;
      row.centre = dropped(face.surface.origin, n, bottom);
      // The ends are the two points farthest from the middle of the arc.
      const Eigen::Vector3d u = (ends.front() - row.centre).normalized();
      const Eigen::Vector3d v = n.cross(u);
      Eigen::Vector2d sum = Eigen::Vector2d::Zero();
      for (const Eigen::Vector3d& p : ends) {
        sum += Eigen::Vector2d((p - row.centre).dot(u), (p - row.centre).dot(v));
      }
      const double middle = std::atan2(sum.y(), sum.x());
      const auto angle = [&](const Eigen::Vector3d& p) {
        const Eigen::Vector3d d = p - row.centre;
        return std::remainder(std::atan2(d.dot(v), d.dot(u)) - middle, 2 * M_PI);
      };
      const auto [first, last] =
          std::minmax_element(ends.begin(), ends.end(),
                              [&](const auto& p, const auto& q) { return angle(p) < angle(q); });
      row.start = *first;
      row.end = *last;
      row.is_clockwise = false;
    } else {
      const Eigen::Vector3d along = n.cross(face.surface.axis).normalized();
      const auto [first, last] = std::minmax_element(
          ends.begin(), ends.end(),
          [&](const auto& p, const auto& q) { return p.dot(along) < q.dot(along); });
      row.start = *first;
      row.end = *last;
    }
    rows.push_back(row);
  }
  std::vector<std::vector<FaceEdge>> loops = joined(std::move(rows));
  put_outer_first(loops);
  return loops;
}

}  // namespace ridgeline::part
