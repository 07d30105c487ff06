#include "part/recognise.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace ridgeline::part {
namespace {

constexpr double same_surface = 1e-4;  // [mm]; design 1.3, "B-splines that convert within 1e-4"
constexpr double same_normal = 1e-4;   // [rad]

Eigen::Vector3d middle(std::span<const Sample> samples) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Sample& sample : samples) sum += sample.point;
  return sum / static_cast<double>(samples.size());
}

bool fits_plane(std::span<const Sample> samples, Surface& found) {
  found.kind = SurfaceKind::Plane;
  found.axis = samples.front().normal;
  found.origin = middle(samples);
  for (const Sample& sample : samples) {
    if (sample.normal.cross(found.axis).norm() > same_normal) return false;
    if (std::abs((sample.point - found.origin).dot(found.axis)) > same_surface) return false;
  }
  return true;
}

// Sphere: p - R n = c for all samples, least squares in (c, R).
bool fits_sphere(std::span<const Sample> samples, Surface& found) {
  Eigen::MatrixXd A(3 * static_cast<Eigen::Index>(samples.size()), 4);
  Eigen::VectorXd b(A.rows());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto row = 3 * static_cast<Eigen::Index>(i);
    A.block<3, 3>(row, 0) = Eigen::Matrix3d::Identity();
    A.block<3, 1>(row, 3) = samples[i].normal;
    b.segment<3>(row) = samples[i].point;
  }
  const Eigen::Vector4d x = A.colPivHouseholderQr().solve(b);
  if ((A * x - b).lpNorm<Eigen::Infinity>() > same_surface) return false;
  found.kind = SurfaceKind::Sphere;
  found.origin = x.head<3>();
  found.radius = std::abs(x(3));
  return found.radius > same_surface;
}

// Cylinder: all normals across the axis; in the plane across it p - R n = c.
bool fits_cylinder(std::span<const Sample> samples, Surface& found) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Sample& sample : samples) spread += sample.normal * sample.normal.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  const Eigen::Vector3d a = solver.eigenvectors().col(0);
  for (const Sample& sample : samples) {
    if (std::abs(sample.normal.dot(a)) > same_normal) return false;
  }
  const Eigen::Vector3d x = solver.eigenvectors().col(1);
  const Eigen::Vector3d y = a.cross(x);
  Eigen::MatrixXd A(2 * static_cast<Eigen::Index>(samples.size()), 3);
  Eigen::VectorXd b(A.rows());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto row = 2 * static_cast<Eigen::Index>(i);
    A.row(row) << 1, 0, samples[i].normal.dot(x);
    A.row(row + 1) << 0, 1, samples[i].normal.dot(y);
    b(row) = samples[i].point.dot(x);
    b(row + 1) = samples[i].point.dot(y);
  }
  const Eigen::Vector3d c = A.colPivHouseholderQr().solve(b);
  if ((A * c - b).lpNorm<Eigen::Infinity>() > same_surface) return false;
  found.kind = SurfaceKind::Cylinder;
  found.axis = a;
  found.origin = c(0) * x + c(1) * y + middle(samples).dot(a) * a;
  found.radius = std::abs(c(2));
  return found.radius > same_surface;
}

// Cone: all tangent planes pass its apex, n.(apex - p) = 0; all normals make one angle with its
// axis, n.(a / sin) = 1.
bool fits_cone(std::span<const Sample> samples, Surface& found) {
  Eigen::MatrixXd N(static_cast<Eigen::Index>(samples.size()), 3);
  Eigen::VectorXd b(N.rows());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    N.row(static_cast<Eigen::Index>(i)) = samples[i].normal.transpose();
    b(static_cast<Eigen::Index>(i)) = samples[i].normal.dot(samples[i].point);
  }
  const auto solver = N.colPivHouseholderQr();
  const Eigen::Vector3d apex = solver.solve(b);
  if ((N * apex - b).lpNorm<Eigen::Infinity>() > same_surface) return false;
  const Eigen::Vector3d way = solver.solve(Eigen::VectorXd::Ones(N.rows()));
  if ((N * way - Eigen::VectorXd::Ones(N.rows())).lpNorm<Eigen::Infinity>() > same_normal) {
    return false;
  }
  found.kind = SurfaceKind::Cone;
  found.axis = way.normalized();
  const double along = (middle(samples) - apex).dot(found.axis);
  if (along < 0) found.axis = -found.axis;
  found.half_angle = std::asin(std::min(1.0, 1 / way.norm()));
  found.origin = apex + std::abs(along) * found.axis;
  found.radius = std::abs(along) * std::tan(found.half_angle);
  return found.half_angle > 1e-3 && found.half_angle < 1.57;
}

}  // namespace

std::optional<Surface> recognised(std::span<const Sample> samples) {
  if (samples.size() < 9) return std::nullopt;
  Surface found;
  if (fits_plane(samples, found)) return found;
  if (fits_sphere(samples, found)) return found;
  if (fits_cylinder(samples, found)) return found;
  if (fits_cone(samples, found)) return found;
  return std::nullopt;
}

}  // namespace ridgeline::part
