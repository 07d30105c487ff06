#include "core/verify/hull_bound.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ridgeline::verify {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Bound cavity_bound(const geometry::Cell& cell, const std::vector<Corner>& corners) {
  Bound bound;
  bound.value = infinity;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    bound.at[i] = -geometry::distance(cell, corners[i].p);
    bound.value = std::min(bound.value, bound.at[i]);
  }
  return bound;
}

Bound linear_bound(double value, const Eigen::Vector3d& gradient, const Eigen::Vector3d& middle,
                   const std::vector<Corner>& corners) {
  Bound bound;
  bound.value = infinity;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    bound.at[i] = value + gradient.dot(corners[i].p - middle);
    bound.value = std::min(bound.value, bound.at[i]);
  }
  return bound;
}

/// A supporting plane of the body: it lies behind, no corner is nearer to the plane than h.
struct Support {
  double h = 0;
  Eigen::Vector3d normal;
};

struct OutsideBound {
  Bound bound;                    ///< of the best plane
  Eigen::Vector3d normal;         ///< its normal
  std::vector<Support> supports;  ///< those with h > 0
};

OutsideBound outside_bound(const geometry::Cell& cell, const Eigen::Vector3d& middle,
                           const std::vector<Corner>& corners) {
  OutsideBound best;
  const auto offer = [&](double value, const Eigen::Vector3d& gradient) {
    const Bound bound = linear_bound(value, gradient, middle, corners);
    if (bound.value > 0) best.supports.push_back({bound.value, gradient});
    if (bound.value > best.bound.value) {
      best.bound = bound;
      best.normal = gradient;
    }
  };
  for (const geometry::Plane& plane : cell.planes) {
    offer(plane.normal.dot(middle - plane.point), plane.normal);
  }
  if (cell.wall) {  // the outside of a body is round when it has a wall
    const Eigen::Vector3d p = geometry::to_local(cell.wall->frame, middle);
    const double r = std::hypot(p.x(), p.y());
    if (r > 0) {
      const Eigen::Vector3d local(p.x() / r, p.y() / r, 0);
      offer(r - cell.wall->profile.R2, geometry::direction_to_outer(cell.wall->frame, local));
    }
  }
  return best;
}

/// Distance to what is behind both of two planes.
double wedge_distance(const Support& a, const Support& b) {
  const double cosine = a.normal.dot(b.normal);
  if (b.h <= a.h * cosine) return a.h;  // the foot on a is behind b
  if (a.h <= b.h * cosine) return b.h;
  const double sine = a.normal.cross(b.normal).norm();
  if (!(sine > 1e-6)) return std::max(a.h, b.h);
  return std::sqrt(a.h * a.h + b.h * b.h - 2 * a.h * b.h * cosine) / sine;
}

double wedge_bound(const OutsideBound& outside) {
  double best = -infinity;
  for (std::size_t i = 0; i < outside.supports.size(); ++i) {
    for (std::size_t k = i + 1; k < outside.supports.size(); ++k) {
      best = std::max(best, wedge_distance(outside.supports[i], outside.supports[k]));
    }
  }
  return best;
}

/// What is behind a supporting plane of the body (h away, unit normal n) and outside of a prism
/// along `axis` (g away): v to it has n.v <= -h and a part square to the axis of at least g. With
/// s and c the parts of n square to the axis and along it, the least |v| has the part l = max(g, h
/// s) square to the axis and (h - s l) / c along it.
double corner_distance(double g, double h, const Eigen::Vector3d& n, const Eigen::Vector3d& axis) {
  const double c = std::abs(n.dot(axis));
  const double s = n.cross(axis).norm();
  const double l = std::max(g, h * s);
  const double rest = std::max(0.0, h - s * l);
  return c > 1e-6 ? std::hypot(l, rest / c) : l;
}

/// As corner_distance, for a cavity; past one of its own planes (a floor) there is material too.
double corner_bound(const geometry::Cell& cavity, double g, const OutsideBound& outside,
                    const std::vector<Corner>& corners) {
  if (!(g > 0 && outside.bound.value > 0 && cavity.wall)) return -infinity;
  double least =
      corner_distance(g, outside.bound.value, outside.normal, cavity.wall->frame.axes.col(2));
  for (const geometry::Plane& plane : cavity.planes) {
    for (const Corner& corner : corners) {
      least = std::min(least, plane.normal.dot(plane.point - corner.p));
    }
  }
  return least;
}

}  // namespace

Bound hull_bound(const geometry::Material& material, const Eigen::Vector3d& middle,
                 const std::vector<Corner>& corners) {
  const OutsideBound outside = outside_bound(material.outside, middle, corners);
  Bound best = outside.bound;
  double at_corner = wedge_bound(outside);
  for (const geometry::Cell& cavity : material.cavities) {
    const double here = -geometry::distance(cavity, middle);  // the middle is in the hull
    if (here <= best.value && !(here > 0 && outside.bound.value > 0)) continue;
    const Bound bound = cavity_bound(cavity, corners);
    at_corner = std::max(at_corner, corner_bound(cavity, bound.value, outside, corners));
    if (bound.value > best.value) best = bound;
  }
  best.value = std::max(best.value, at_corner);
  return best;
}

}  // namespace ridgeline::verify
