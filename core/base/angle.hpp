#pragma once

#include <numbers>

namespace ridgeline {

/// Degrees exist at the boundary only (JSON, IDL, NC); the core computes in radians.
constexpr double radians(double degrees) {
  return degrees * (std::numbers::pi / 180);
}
constexpr double degrees(double radians) {
  return radians * (180 / std::numbers::pi);
}

}  // namespace ridgeline
