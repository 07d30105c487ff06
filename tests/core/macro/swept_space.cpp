#include "tests/core/macro/swept_space.hpp"

#include <algorithm>
#include <cmath>

#include "core/path/arc.hpp"

namespace ridgeline::macro {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double pi = 3.14159265358979323846;
constexpr double chord = 1e-4;  // [mm] of arcs taken as chords

/// Signed distance of a point to the tool that stands with its tip at `tip`: the disc of radius a
/// at height r and what is above it, grown by r.
double tool_distance(const Cycle& cycle, const Vector3d& tip, const Vector3d& p) {
  const double a = cycle.D / 2 - cycle.r;
  const double rho = std::hypot(p.x() - tip.x(), p.y() - tip.y()) - a;
  const double below = cycle.r - (p.z() - tip.z());
  if (rho <= 0 && below <= 0) return std::max(rho, below) - cycle.r;
  return std::hypot(std::max(rho, 0.0), std::max(below, 0.0)) - cycle.r;
}

}  // namespace

std::vector<Segment> segments_of(const Result& motion) {
  std::vector<Segment> segments;
  Vector3d at = motion.motion.front().to;
  for (const Move& move : motion.motion) {
    if (move.kind != MoveKind::Arc) {
      segments.push_back({at, move.to});
      at = move.to;
      continue;
    }
    const ArcDetail& arc = arc_of(motion, move);
    const path::PlaneAxes axes = path::axes_of(arc.plane);
    const Vector2d centre(arc.centre[axes.first], arc.centre[axes.second]);
    const Vector2d a = Vector2d(at[axes.first], at[axes.second]) - centre;
    const Vector2d b = Vector2d(move.to[axes.first], move.to[axes.second]) - centre;
    double sweep = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    const bool ccw = arc.sense == path::ArcSense::CounterClockwise;
    if (ccw && sweep < -1e-9) sweep += 2 * pi;
    if (!ccw && sweep > 1e-9) sweep -= 2 * pi;
    if (std::abs(sweep) < 1e-9) sweep = ccw ? 2 * pi : -2 * pi;
    const double radius = std::max(a.norm(), 1e-6);
    const double step = 2 * std::acos(std::max(0.0, 1 - chord / radius));
    const auto count = static_cast<int>(std::ceil(std::abs(sweep) / step));
    const Vector3d start = at;
    for (int i = 1; i <= count; ++i) {
      const double part = static_cast<double>(i) / count, angle = sweep * part;
      Vector3d p = start + part * (move.to - start);
      p[axes.first] = centre.x() + a.x() * std::cos(angle) - a.y() * std::sin(angle);
      p[axes.second] = centre.y() + a.x() * std::sin(angle) + a.y() * std::cos(angle);
      segments.push_back({at, p});
      at = p;
    }
    at = move.to;
  }
  return segments;
}

// The tool is convex, so its distance is convex along a segment.
double swept_distance(const Cycle& cycle, const std::vector<Segment>& segments, const Vector3d& p) {
  double least = 1e9;
  for (const Segment& segment : segments) {
    const double length = (segment.to - segment.from).norm();
    const double at_from = tool_distance(cycle, segment.from, p);
    least = std::min(least, at_from);
    if (at_from - length > least) continue;  // moving by it cannot bring it nearer
    double low = 0, high = 1;
    constexpr double golden = 0.6180339887498949;
    const auto at = [&](double t) {
      return tool_distance(cycle, segment.from + t * (segment.to - segment.from), p);
    };
    double x = high - golden, y = low + golden, fx = at(x), fy = at(y);
    for (int i = 0; i < 30; ++i) {
      if (fx < fy) {
        high = y, y = x, fy = fx;
        x = high - golden * (high - low), fx = at(x);
      } else {
        low = x, x = y, fx = fy;
        y = low + golden * (high - low), fy = at(y);
      }
    }
    least = std::min({least, fx, fy, at(1)});
  }
  return least;
}

std::vector<Segment> within(const Cycle& cycle, const std::vector<Segment>& segments,
                            const Vector3d& p, double reach) {
  std::vector<Segment> kept;
  for (const Segment& segment : segments) {
    const double length = (segment.to - segment.from).norm();
    if (tool_distance(cycle, segment.from, p) - length <= reach) kept.push_back(segment);
  }
  return kept;
}

}  // namespace ridgeline::macro
