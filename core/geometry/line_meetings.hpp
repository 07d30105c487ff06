#pragma once

#include <Eigen/Core>
#include <array>

#include "core/geometry/profile.hpp"

namespace ridgeline::geometry {

inline constexpr double parallel_sine = 1e-9;  ///< of two directions that count as parallel

/// Where a line meets something: at most two parameters, ascending.
struct Roots {
  std::array<double, 2> z{};
  int count = 0;
};

inline bool is_circle(const Profile& profile) {
  return profile.straight_along == 0 && profile.straight_across == 0;
}

/// Where the line p + z d crosses the profile.
Roots line_meetings(const Profile& profile, const Eigen::Vector2d& p, const Eigen::Vector2d& d);

}  // namespace ridgeline::geometry
