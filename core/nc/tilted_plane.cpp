#include "core/nc/tilted_plane.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/angle.hpp"
#include "core/nc/plan.hpp"
#include "core/nc/text.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::nc {
namespace {

constexpr double least_turn = 1e-7;  ///< of J [rad]; below, I and K are about the same axis

Eigen::Matrix3d rotation(double degrees, int axis) {
  return Eigen::AngleAxisd(radians(degrees), Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}

std::int64_t in_units(double value, int decimals) {
  return std::llround(value * static_cast<double>(power_of_ten(decimals)));
}

std::array<double, 3> as_numbers(const std::array<std::int64_t, 3>& units, int decimals) {
  const auto scale = static_cast<double>(power_of_ten(decimals));
  return {static_cast<double>(units[0]) / scale, static_cast<double>(units[1]) / scale,
          static_cast<double>(units[2]) / scale};
}

Eigen::Vector3d as_vector(const std::array<std::int64_t, 3>& units, int decimals) {
  const auto [x, y, z] = as_numbers(units, decimals);
  return {x, y, z};
}

}  // namespace

std::array<std::int64_t, 3> euler_angles(const Eigen::Matrix3d& R) {
  // Rz(I) Rx(J) Rz(K): third column (sin I sin J, -cos I sin J, cos J), third row likewise in K.
  const double sin_J = std::hypot(R(0, 2), R(1, 2));
  const double J = std::atan2(sin_J, R(2, 2));
  const bool regular = sin_J > least_turn;
  const double I = regular ? std::atan2(R(0, 2), -R(1, 2)) : std::atan2(R(1, 0), R(0, 0));
  const double K = regular ? std::atan2(R(2, 0), R(2, 1)) : 0;
  return {in_units(degrees(I), euler_decimals), in_units(degrees(J), euler_decimals),
          in_units(degrees(K), euler_decimals)};
}

Eigen::Matrix3d plane_of_euler(const std::array<double, 3>& d) {
  return rotation(d[0], 2) * rotation(d[1], 0) * rotation(d[2], 2);
}

std::array<std::int64_t, 3> swivel_angles(const Eigen::Vector3d& axis) {
  const double B = std::asin(std::clamp(axis.x(), -1.0, 1.0));
  const double A = std::atan2(-axis.y(), axis.z());
  return {in_units(degrees(A), swivel_decimals), in_units(degrees(B), swivel_decimals), 0};
}

Eigen::Matrix3d plane_of_swivel(const std::array<double, 3>& d) {
  return rotation(d[0], 0) * rotation(d[1], 1) * rotation(d[2], 2);
}

PlaneVectors plane_vectors(const Eigen::Matrix3d& plane) {
  PlaneVectors vectors;
  for (int n = 0; n < 3; ++n) {
    const auto at = static_cast<std::size_t>(n);
    vectors.base[at] = in_units(plane(n, 0), vector_decimals);
    vectors.normal[at] = in_units(plane(n, 2), vector_decimals);
  }
  return vectors;
}

Eigen::Matrix3d plane_of_vectors(const Eigen::Vector3d& base, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d z = normal.normalized();
  const Eigen::Vector3d x = (base - base.dot(z) * z).normalized();
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), z;
  return axes;
}

bool is_tilted(const Program& program) {
  return !path::machine_axis(program.tool_axis.normalized());
}

bool in_work_plane(const Program& program) {
  return is_tilted(program) && program.tilted == TiltedOutput::WorkPlane;
}

bool follows_tool(const Program& program) {
  return is_tilted(program) && program.tilted == TiltedOutput::WorkFrame;
}

int length_axis(const Program& program) {
  int n = 2;
  if (!is_tilted(program)) program.tool_axis.cwiseAbs().maxCoeff(&n);
  return n;
}

Eigen::Matrix3d plane_axes(const Program& program) {
  if (!in_work_plane(program)) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d axis = program.tool_axis.normalized();
  if (program.dialect == Dialect::Siemens) {
    return plane_of_swivel(as_numbers(swivel_angles(axis), swivel_decimals));
  }
  if (program.dialect == Dialect::Heidenhain) {
    const PlaneVectors vectors = plane_vectors(path::tilted_axes(axis));
    return plane_of_vectors(as_vector(vectors.base, vector_decimals),
                            as_vector(vectors.normal, vector_decimals));
  }
  return plane_of_euler(as_numbers(euler_angles(path::tilted_axes(axis)), euler_decimals));
}

}  // namespace ridgeline::nc
