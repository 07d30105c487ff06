#include "core/geometry/profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ridgeline::geometry {
namespace {

using std::numbers::pi;

/// Arc lengths where the eight parts after the first half straight begin: corner, top, corner,
/// left, corner, bottom, corner, right; then the whole.
std::array<double, 9> starts(const Profile& profile) {
  const double quarter = pi / 2 * profile.R2;
  const double along = profile.straight_along;
  const double across = profile.straight_across;
  std::array<double, 9> s{};
  s[0] = along / 2;
  for (std::size_t k = 0; k < 4; ++k) {
    s[2 * k + 1] = s[2 * k] + quarter;
    s[2 * k + 2] = s[2 * k + 1] + (k % 2 == 0 ? across : along);
  }
  s[8] = perimeter(profile);
  return s;
}

ProfilePoint arc_point(const Profile& profile, const Eigen::Vector2d& centre, double phi) {
  const Eigen::Vector2d n(std::cos(phi), std::sin(phi));
  return {.p = centre + profile.R2 * n,
          .tangent = {-n.y(), n.x()},
          .normal = n,
          .curvature = 1 / profile.R2};
}

}  // namespace

double perimeter(const Profile& profile) {
  return 2 * (pi * profile.R2 + profile.straight_along + profile.straight_across);
}

ProfilePoint profile_at(const Profile& profile, double u) {
  const double turn = u >= 0 && u < 1 ? u : u - std::floor(u);
  const double a = profile.straight_across / 2;
  const double b = profile.straight_along / 2;
  if (a == 0 && b == 0) return arc_point(profile, Eigen::Vector2d::Zero(), 2 * pi * turn);

  const double s = turn * perimeter(profile);
  const std::array<double, 9> start = starts(profile);
  if (s < start[0] || s >= start[7]) {  // right, through u = 0
    const double y = s < start[0] ? s : s - start[8];
    return {.p = {a + profile.R2, y}, .tangent = {0, 1}, .normal = {1, 0}, .curvature = 0};
  }
  const std::array<Eigen::Vector2d, 4> corners{{{a, b}, {-a, b}, {-a, -b}, {a, -b}}};
  const std::array<Eigen::Vector2d, 4> sides{{{0, 1}, {-1, 0}, {0, -1}, {1, 0}}};  // normals
  for (std::size_t k = 0; k < 4; ++k) {
    if (s < start[2 * k + 1]) {
      const double phi = static_cast<double>(k) * (pi / 2) + (s - start[2 * k]) / profile.R2;
      return arc_point(profile, corners[k], phi);
    }
    if (k < 3 && s < start[2 * k + 2]) {
      const Eigen::Vector2d& n = sides[k];
      const Eigen::Vector2d t(-n.y(), n.x());
      return {.p = corners[k] + profile.R2 * n + (s - start[2 * k + 1]) * t,
              .tangent = t,
              .normal = n,
              .curvature = 0};
    }
  }
  return arc_point(profile, corners[3], 2 * pi);  // rounding: s is the end of the last corner
}

std::vector<double> joints(const Profile& profile) {
  const std::array<double, 9> start = starts(profile);
  std::vector<double> result;
  for (std::size_t k = 0; k < 4; ++k) {
    const bool before = (k % 2 == 0 ? profile.straight_along : profile.straight_across) > 0;
    const bool after = (k % 2 == 0 ? profile.straight_across : profile.straight_along) > 0;
    if (before) result.push_back(start[2 * k] / start[8]);
    if (after) result.push_back(start[2 * k + 1] / start[8]);
  }
  std::ranges::sort(result);
  return result;
}

// The polar angle grows with u, for the profile is convex about the origin: halving of a turn.
double parameter_at(const Profile& profile, double phi) {
  const double turn = phi / (2 * pi) - std::floor(phi / (2 * pi));
  if (profile.straight_along == 0 && profile.straight_across == 0) return turn < 1 ? turn : 0;
  const Eigen::Vector2d ray(std::cos(phi), std::sin(phi));
  const double quarter = std::floor(4 * turn) / 4;  // quarters of phi are quarters of u
  double low = quarter;
  double high = quarter + 0.25;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    const Eigen::Vector2d p = profile_at(profile, middle).p;
    (p.x() * ray.y() - p.y() * ray.x() > 0 ? low : high) = middle;
  }
  return low < 1 ? low : 0;
}

PlaneDistance signed_distance(const Profile& profile, const Eigen::Vector2d& p) {
  const Eigen::Vector2d half(profile.straight_across / 2, profile.straight_along / 2);
  const Eigen::Vector2d core = p.cwiseMax(-half).cwiseMin(half);
  const Eigen::Vector2d out = p - core;  // from the core rectangle to p
  const double r = out.norm();
  PlaneDistance s;
  if (r > 0) {
    s.value = r - profile.R2;
    s.gradient = out / r;
    const Eigen::Vector2d t(-s.gradient.y(), s.gradient.x());
    const bool beside = (p.cwiseAbs().array() < half.array()).any();  // of a straight part: linear
    s.hessian = beside ? Eigen::Matrix2d::Zero() : Eigen::Matrix2d(t * t.transpose() / r);
    return s;
  }
  const Eigen::Vector2d inside = p.cwiseAbs() - half;  // both <= 0: in the core
  const Eigen::Index axis = inside.x() > inside.y() ? 0 : 1;
  s.value = inside[axis] - profile.R2;
  s.gradient = Eigen::Vector2d::Unit(axis) * (p[axis] < 0 ? -1 : 1);
  s.hessian.setZero();
  return s;
}

Eigen::Vector2d half_extents(const Profile& profile) {
  return {profile.straight_across / 2 + profile.R2, profile.straight_along / 2 + profile.R2};
}

}  // namespace ridgeline::geometry
