#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/nc/program.hpp"

/// The tilted work plane in each control's own numbers. Used by writers and readers.
namespace ridgeline::nc {

/// FANUC G68.2 I J K: Euler angles, Rz(I) Rx(J) Rz(K) [0.001 degree].
inline constexpr int euler_decimals = 3;
std::array<std::int64_t, 3> euler_angles(const Eigen::Matrix3d& plane);
Eigen::Matrix3d plane_of_euler(const std::array<double, 3>& degrees);

/// Siemens CYCLE800 mode 57: Rx(A) Ry(B) Rz(C) [0.0001 degree], C = 0.
inline constexpr int swivel_decimals = 4;
std::array<std::int64_t, 3> swivel_angles(const Eigen::Vector3d& axis);
Eigen::Matrix3d plane_of_swivel(const std::array<double, 3>& degrees);

/// HEIDENHAIN PLANE VECTOR: B is the X axis, N the tool axis [1e-7].
inline constexpr int vector_decimals = 7;
struct PlaneVectors {
  std::array<std::int64_t, 3> base{}, normal{};
};
PlaneVectors plane_vectors(const Eigen::Matrix3d& plane);
Eigen::Matrix3d plane_of_vectors(const Eigen::Vector3d& base, const Eigen::Vector3d& normal);

}  // namespace ridgeline::nc
