#include "core/chamfer/arcs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double largest_turn = std::numbers::pi * 0.9;  ///< of one arc [rad]
constexpr double largest_radius = 1e4;                   ///< [mm]; flatter is a line

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Centre of the circle through three points: |c - a|^2 = |c - b|^2 = |c - m|^2.
std::optional<Vector2d> circle_centre(const Vector2d& a, const Vector2d& m, const Vector2d& b) {
  const Vector2d p = m - a;
  const Vector2d q = b - a;
  const double twice = 2 * cross(p, q);
  if (!(std::abs(twice) > 1e-12 * q.squaredNorm())) return std::nullopt;
  const Vector2d v((q.y() * p.squaredNorm() - p.y() * q.squaredNorm()) / twice,
                   (p.x() * q.squaredNorm() - q.x() * p.squaredNorm()) / twice);
  if (!(v.norm() < largest_radius)) return std::nullopt;
  return a + v;
}

class Fitter {
public:
  Fitter(const std::vector<Vector3d>& points, double tolerance)
      : points_(points), tolerance_(tolerance) {}

  std::vector<ArcBlock> run() const {
    std::vector<ArcBlock> blocks;
    std::size_t from = 0;
    while (from + 1 < points_.size()) {
      blocks.push_back(longest(from));
      from = blocks.back().end;
    }
    return blocks;
  }

private:
  Vector2d flat(std::size_t i) const { return points_[i].head<2>(); }

  /// The best block over points from .. to; nullopt: none within the tolerance.
  std::optional<ArcBlock> block(std::size_t from, std::size_t to) const {
    std::optional<ArcBlock> best = line(from, to);
    if (to - from < 2) return best;
    const std::optional<ArcBlock> round = arc(from, to);
    return round && (!best || round->error < best->error) ? round : best;
  }

  std::optional<ArcBlock> line(std::size_t from, std::size_t to) const {
    const Vector3d& a = points_[from];
    const Vector3d d = (points_[to] - a).normalized();
    ArcBlock line{.end = to};
    for (std::size_t i = from + 1; i < to; ++i) {
      const Vector3d v = points_[i] - a;
      line.error = std::max(line.error, (v - v.dot(d) * d).norm());
    }
    if (to - from > 1 && !(line.error <= tolerance_)) return std::nullopt;
    return line;
  }

  /// Through both ends and the middle point. A point is held against the arc at its own angle, so
  /// that the error bounds its distance; the sag of the arc between two points adds to it.
  std::optional<ArcBlock> arc(std::size_t from, std::size_t to) const {
    const Vector2d a = flat(from);
    const Vector2d b = flat(to);
    const std::optional<Vector2d> centre = circle_centre(a, flat((from + to) / 2), b);
    if (!centre) return std::nullopt;
    const double radius = (a - *centre).norm();
    const auto angle_to = [&](std::size_t i) {
      const Vector2d u = flat(i - 1) - *centre;
      const Vector2d v = flat(i) - *centre;
      return std::atan2(cross(u, v), u.dot(v));
    };
    double sweep = 0;
    for (std::size_t i = from + 1; i <= to; ++i) sweep += angle_to(i);
    if (!(std::abs(sweep) < largest_turn && std::abs(sweep) > 1e-9)) return std::nullopt;
    const double rise = points_[to].z() - points_[from].z();
    ArcBlock block{.end = to, .is_arc = true, .centre = *centre, .is_counter_clockwise = sweep > 0};
    double turned = 0;
    for (std::size_t i = from + 1; i <= to; ++i) {
      const double step = angle_to(i);
      if (!(step * sweep > 0)) return std::nullopt;
      turned += step;
      const double out = (flat(i) - *centre).norm() - radius;
      const double up = points_[i].z() - points_[from].z() - rise * turned / sweep;
      const double sag = radius * (1 - std::cos(step / 2));
      block.error = std::max(block.error, std::hypot(out, up) + sag);
      if (!(block.error <= tolerance_)) return std::nullopt;
    }
    return block;
  }

  /// Doubling while it fits, then bisection.
  ArcBlock longest(std::size_t from) const {
    const std::size_t last = points_.size() - 1;
    ArcBlock best = *block(from, from + 1);
    std::size_t reach = 2, bad = last + 1;
    while (from + reach <= last) {
      const std::optional<ArcBlock> longer = block(from, from + reach);
      if (!longer) {
        bad = from + reach;
        break;
      }
      best = *longer;
      reach *= 2;
    }
    bad = std::min(bad, last + 1);
    while (best.end + 1 < bad) {
      const std::size_t middle = (best.end + bad) / 2;
      const std::optional<ArcBlock> longer = block(from, middle);
      if (longer) {
        best = *longer;
      } else {
        bad = middle;
      }
    }
    return best;
  }

  const std::vector<Vector3d>& points_;
  double tolerance_;
};

}  // namespace

std::vector<ArcBlock> fit_arcs(const std::vector<Vector3d>& points, double tolerance) {
  return Fitter(points, tolerance).run();
}

}  // namespace ridgeline::chamfer
