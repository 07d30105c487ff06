#include "jobs/units_area.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/units/overlay.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector3d;
using units::FaceEdge;
using units::MilledFace;
using units::Point;
using units::Region;
using units::Segment;
using units::Sense;

constexpr double clear = 2;  // [mm] beyond open edges

/// Does the work end at this edge, or does material stand behind it?
bool is_open(const units::Product& product, const FaceEdge& edge, const Vector3d& outwards) {
  constexpr double step = 0.02;  // [mm]
  const Vector3d p = (edge.start + edge.end) / 2 + step * outwards;
  return !units::covers(product.shadow, {std::hypot(p.x(), p.y()), p.z()});
}

/// The middle of an arc of an outline; `n` out of the product.
Vector3d middle_of(const FaceEdge& arc, const Vector3d& n) {
  const Vector3d u = arc.start - arc.centre, v = arc.end - arc.centre;
  const Vector3d w = n.cross(u);
  double turn = std::atan2(v.dot(w), v.dot(u));
  if (arc.is_clockwise != (turn < 0)) {
    turn += turn < 0 ? 2 * std::numbers::pi : -2 * std::numbers::pi;
  }
  return arc.centre + std::cos(turn / 2) * u + std::sin(turn / 2) * w;
}

/// The band beyond an arc that bulges into the open.
std::optional<Region> arc_wing(const units::Product& product, const FaceEdge& edge,
                               const Segment& row, const Vector3d& n, double by) {
  const Vector3d middle = middle_of(edge, n);
  const Vector3d out = (middle - edge.centre).normalized();
  if (!is_open(product, {middle, middle}, out)) return std::nullopt;
  const Segment::Round& round = *row.arc;
  const auto beyond = [&](const Point& p) {
    const double f = (round.radius + by) / round.radius;
    return Point{round.centre.r + f * (p.r - round.centre.r),
                 round.centre.z + f * (p.z - round.centre.z)};
  };
  const bool is_clockwise = round.sense == Sense::Clockwise;
  const Point start = beyond(row.start), end = beyond(row.end);
  return units::region_of(
      units::Contour{{row.start, start, {}},
                     {start, end, Segment::Round{round.centre, round.radius + by, round.sense}},
                     {end, row.end, {}},
                     {row.end, row.start,
                      Segment::Round{round.centre, round.radius,
                                     is_clockwise ? Sense::CounterClockwise : Sense::Clockwise}}});
}

}  // namespace

Region milled_area(const units::Product& product, const MilledFace& face, const LatheFrame& frame,
                   MillingPlane& plane, double R) {
  double least = 0;
  for (const auto& loop : face.outline) {
    for (const FaceEdge& edge : loop) {
      least = std::min(
          {least, frame.point(edge.start).dot(plane.b), frame.point(edge.end).dot(plane.b)});
    }
  }
  plane.shift = 1000 + 4 * R - least;
  const Vector3d right = plane.a;
  const Vector3d up = plane.b;
  const bool is_seen_from_outside = right.cross(up).dot(plane.h) > 0;
  std::vector<units::Contour> loops;
  std::vector<Region> parts;
  for (std::size_t l = 0; l < face.outline.size(); ++l) {
    units::Contour loop;
    for (const FaceEdge& edge : face.outline[l]) {
      Segment row{plane.in(frame.point(edge.start)), plane.in(frame.point(edge.end)), {}};
      if (edge.is_arc) {
        const Point centre = plane.in(frame.point(edge.centre));
        const bool is_clockwise = edge.is_clockwise == is_seen_from_outside;
        row.arc = Segment::Round{centre, std::hypot(row.start.r - centre.r, row.start.z - centre.z),
                                 is_clockwise ? Sense::Clockwise : Sense::CounterClockwise};
      }
      loop.push_back(row);
    }
    loops.push_back(std::move(loop));
  }
  parts.push_back(units::region_of(loops));
  for (std::size_t l = 0; l < face.outline.size(); ++l) {
    for (std::size_t i = 0; i < face.outline[l].size(); ++i) {
      const FaceEdge& edge = face.outline[l][i];
      const Vector3d t = edge.end - edge.start;
      const Vector3d n = face.normal;
      if (t.norm() < 1e-6) continue;
      if (edge.is_arc) {
        const std::optional<Region> wing =
            l == 0 ? arc_wing(product, edge, loops[l][i], n, R + clear) : std::nullopt;
        if (wing) parts.push_back(*wing);
        continue;
      }
      Vector3d side = t.cross(n).normalized();
      const Point middle =
          plane.in(frame.point(Vector3d((edge.start + edge.end) / 2 + 0.02 * side)));
      if (units::covers(parts.front(), middle)) side = -side;
      if (!is_open(product, edge, side)) continue;
      const double by = R + clear;
      const Vector3d over = t.normalized() * by;
      units::Contour wing;
      const std::vector<Vector3d> corners{edge.start - over, edge.end + over,
                                          edge.end + over + by * side,
                                          edge.start - over + by * side};
      // a wing as long as the edge; it grows over its ends only where they are open too
      const std::vector<Vector3d> plain{edge.start, edge.end, edge.end + by * side,
                                        edge.start + by * side};
      const bool ends_open =
          is_open(product, {edge.start - over, edge.start - over}, Vector3d::Zero()) &&
          is_open(product, {edge.end + over, edge.end + over}, Vector3d::Zero());
      const std::vector<Vector3d>& used = ends_open ? corners : plain;
      for (std::size_t k = 0; k < 4; ++k) {
        wing.push_back(
            {plane.in(frame.point(used[k])), plane.in(frame.point(used[(k + 1) % 4])), {}});
      }
      parts.push_back(units::region_of(wing));
    }
  }
  return units::union_of(parts);
}

}  // namespace ridgeline::jobs
