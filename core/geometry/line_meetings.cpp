#include "core/geometry/line_meetings.hpp"

#include <cmath>

#include "core/geometry/material.hpp"

namespace ridgeline::geometry {
namespace {

// |p + z d| = R: d.d z^2 + 2 p.d z + p.p - R^2 = 0.
Roots circle_roots(double R, const Eigen::Vector2d& p, const Eigen::Vector2d& d) {
  const double a = d.squaredNorm();
  const double half = -p.dot(d) / a;
  const double square = half * half - (p.squaredNorm() - R * R) / a;
  if (!(square > 0)) return {};
  const double root = std::sqrt(square);
  return {{half - root, half + root}, 2};
}

template <typename Function>
double bisect(const Function& s, double positive, double negative) {
  for (int i = 0; i < 80; ++i) {
    const double middle = (positive + negative) / 2;
    (s(middle) > 0 ? positive : negative) = middle;
  }
  return (positive + negative) / 2;
}

Roots convex_roots(const Profile& profile, const Eigen::Vector2d& p, const Eigen::Vector2d& d) {
  const auto s = [&](double z) {
    return plane_distance(profile, p.x() + z * d.x(), p.y() + z * d.y());
  };
  const double middle = -p.dot(d) / d.squaredNorm();
  const double far = 2 * half_extents(profile).norm() / d.norm();
  double low = middle - far, high = middle + far;
  for (int i = 0; i < 200 && high - low > 1e-12 * far; ++i) {  // least of a convex function
    const double one = low + (high - low) / 3;
    const double two = high - (high - low) / 3;
    (s(one) < s(two) ? high : low) = s(one) < s(two) ? two : one;
  }
  const double least = (low + high) / 2;
  if (!(s(least) < 0)) return {};
  return {{bisect(s, middle - far, least), bisect(s, middle + far, least)}, 2};
}

}  // namespace

Roots line_meetings(const Profile& profile, const Eigen::Vector2d& p, const Eigen::Vector2d& d) {
  return is_circle(profile) ? circle_roots(profile.R2, p, d) : convex_roots(profile, p, d);
}

}  // namespace ridgeline::geometry
