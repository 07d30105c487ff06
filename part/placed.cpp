#include "part/placed.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "part/greatest.hpp"

namespace ridgeline::part {
namespace {

bool has_axis(const Surface& surface) {
  return surface.kind == SurfaceKind::Cylinder || surface.kind == SurfaceKind::Cone ||
         surface.kind == SurfaceKind::Torus;
}

// A surface of revolution about (a, b), Pluecker coordinates of its axis: every normal line (n, m),
// m = p x n, meets it: n.b + m.a = 0. The least eigenvector over all samples.
std::optional<Axis> axis_of_normals(const Model& model) {
  Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Vector3d middle = (model.low + model.high) / 2;
  const double size = std::max((model.high - model.low).norm(), 1e-9);
  int count = 0;
  for (const Face& face : model.faces) {
    if (face.surface.kind != SurfaceKind::Other) continue;
    for (const Sample& sample : face.samples) {
      Eigen::Matrix<double, 6, 1> row;
      row.head<3>() = ((sample.point - middle) / size).cross(sample.normal);
      row.tail<3>() = sample.normal;
      sum += row * row.transpose();
      ++count;
    }
  }
  if (count < 12) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(sum);
  const Eigen::Matrix<double, 6, 1> x = solver.eigenvectors().col(0);
  const Eigen::Vector3d a = x.head<3>();
  const Eigen::Vector3d b = x.tail<3>();
  if (solver.eigenvalues()(0) > 1e-8 * count || a.norm() < 1e-3) return std::nullopt;
  return Axis{middle + size * a.cross(b) / a.squaredNorm(), a.normalized()};
}

Axis with_sense_of_file(Axis axis) {
  int largest = 0;
  axis.direction.cwiseAbs().maxCoeff(&largest);
  if (axis.direction(largest) < 0) axis.direction = -axis.direction;
  return axis;
}

Face moved(const geometry::Frame& frame, Face face) {
  const Eigen::Matrix3d R = frame.axes.transpose();
  Surface& s = face.surface;
  s.origin = geometry::to_local(frame, s.origin);
  s.axis = geometry::direction_to_local(frame, s.axis);
  for (Sample& sample : face.samples) {
    sample.point = geometry::to_local(frame, sample.point);
    sample.normal = geometry::direction_to_local(frame, sample.normal);
  }
  const Eigen::Matrix3d M = face.moment_integral - frame.origin * face.normal_integral.transpose();
  face.moment_integral = R * M * R.transpose();
  face.normal_integral = R * face.normal_integral;
  return face;
}

Edge moved(const geometry::Frame& frame, Edge edge) {
  edge.centre = geometry::to_local(frame, edge.centre);
  edge.axis = geometry::direction_to_local(frame, edge.axis);
  for (Eigen::Vector3d& point : edge.points) point = geometry::to_local(frame, point);
  return edge;
}

Model moved(const geometry::Frame& frame, const Model& model) {
  Model result;
  result.name = model.name;
  result.volume = model.volume;
  result.has_cavity = model.has_cavity;
  for (const Face& face : model.faces) result.faces.push_back(moved(frame, face));
  for (const Edge& edge : model.edges) result.edges.push_back(moved(frame, edge));
  for (const Eigen::Vector3d& vertex : model.vertices) {
    result.vertices.push_back(geometry::to_local(frame, vertex));
  }
  result.low = Eigen::Vector3d::Constant(HUGE_VAL);
  result.high = Eigen::Vector3d::Constant(-HUGE_VAL);
  for (const Edge& edge : result.edges) {
    for (const Eigen::Vector3d& point : edge.points) {
      result.low = result.low.cwiseMin(point);
      result.high = result.high.cwiseMax(point);
    }
  }
  return result;
}

}  // namespace

std::optional<Axis> turning_axis(const Model& model) {
  const Face* best = nullptr;
  double most = 0;
  for (const Face& face : model.faces) {
    if (!has_axis(face.surface)) continue;
    const Axis axis{face.surface.origin, face.surface.axis};
    double weight = 0;
    for (const Face& other : model.faces) {
      if (has_axis(other.surface) &&
          is_same_axis(axis, {other.surface.origin, other.surface.axis})) {
        weight += other.area;
      }
    }
    if (weight <= most * (1 + 1e-12)) continue;
    most = weight;
    best = &face;
  }
  if (best != nullptr) return with_sense_of_file({best->surface.origin, best->surface.axis});
  const std::optional<Axis> found = axis_of_normals(model);
  if (found) return with_sense_of_file(*found);
  return std::nullopt;
}

geometry::Frame turning_frame(const Model& model, const Axis& axis) {
  const Eigen::Vector3d z = axis.direction;
  int largest = 0;
  z.cwiseAbs().maxCoeff(&largest);
  const Eigen::Vector3d across = Eigen::Vector3d::Unit((largest + 1) % 3);
  geometry::Frame frame;
  frame.axes.col(0) = (across - across.dot(z) * z).normalized();
  frame.axes.col(1) = z.cross(Eigen::Vector3d(frame.axes.col(0)));
  frame.axes.col(2) = z;
  frame.origin = axis.point;
  double low = HUGE_VAL;
  for (const Edge& edge : model.edges) {
    for (const Eigen::Vector3d& point : edge.points) {
      low = std::min(low, (point - axis.point).dot(z));
    }
  }
  frame.origin += low * z;
  return frame;
}

Placed::Placed(Solid solid, const geometry::Frame& frame)
    : solid_(std::move(solid)),
      frame_(frame),
      model_(moved(frame, solid_.model())),
      along_z_(model_.edges.size()) {}

std::vector<Solid::Triangle> Placed::mesh(std::span<const int> faces, double deflection) const {
  std::vector<Solid::Triangle> triangles = solid_.mesh(faces, deflection);
  for (Solid::Triangle& triangle : triangles) {
    for (Eigen::Vector3d& corner : triangle.corners) corner = geometry::to_local(frame_, corner);
  }
  return triangles;
}

bool Placed::contains(const Eigen::Vector3d& point) const {
  return solid_.contains(geometry::to_outer(frame_, point));
}

Eigen::Vector3d Placed::edge_point(int edge, double t) const {
  return geometry::to_local(frame_, solid_.edge_point(edge, t));
}

double Placed::integral(int edge, const Solid::Integrand& f) const {
  return solid_.integral(edge, [&](const Eigen::Vector3d& p, const Eigen::Vector3d& dp) {
    return f(geometry::to_local(frame_, p), geometry::direction_to_local(frame_, dp));
  });
}

Eigen::Vector3d Placed::crossing(int edge, std::size_t i, double z) const {
  const Edge& e = model_.edges[static_cast<std::size_t>(edge)];
  const Eigen::Vector3d& p = e.points[i];
  const Eigen::Vector3d& q = e.points[i + 1];
  if (e.kind == CurveKind::Line) return p + (q - p) * ((z - p.z()) / (q.z() - p.z()));
  const double n = static_cast<double>(e.points.size() - 1);
  double low = static_cast<double>(i) / n;
  double high = static_cast<double>(i + 1) / n;
  double at_low = p.z() - z;
  double at_high = q.z() - z;
  Eigen::Vector3d found = p;
  for (int k = 0; k < 60; ++k) {  // regula falsi, bisection every third step
    const double t =
        k % 3 == 2 ? (low + high) / 2 : low + (high - low) * at_low / (at_low - at_high);
    found = edge_point(edge, t);
    const double at = found.z() - z;
    if (std::abs(at) < 1e-11 || high - low < 1e-14) break;
    if ((at < 0) == (at_low < 0)) {
      low = t;
      at_low = at;
    } else {
      high = t;
      at_high = at;
    }
  }
  return found;
}

Placed::Extent Placed::extent(int edge, const Eigen::Vector3d& d) const {
  const Edge& e = model_.edges[static_cast<std::size_t>(edge)];
  Extent found{HUGE_VAL, -HUGE_VAL};
  for (const Eigen::Vector3d& point : e.points) {
    found.low = std::min(found.low, point.dot(d));
    found.high = std::max(found.high, point.dot(d));
  }
  if (e.kind == CurveKind::Line || found.high - found.low < 1e-9) return found;
  const double n = static_cast<double>(e.points.size() - 1);
  for (const double sign : {-1.0, 1.0}) {
    const auto best = std::max_element(
        e.points.begin(), e.points.end(),
        [&](const auto& p, const auto& q) { return sign * p.dot(d) < sign * q.dot(d); });
    const double at = static_cast<double>(best - e.points.begin());
    const double extreme = greatest(std::max(0.0, (at - 1) / n), std::min(1.0, (at + 1) / n),
                                    [&](double t) { return sign * edge_point(edge, t).dot(d); });
    (sign < 0 ? found.low : found.high) = sign * std::max(extreme, sign * best->dot(d));
  }
  return found;
}

Placed::Extent Placed::extent_along_z(int edge) const {
  std::optional<Extent>& known = along_z_[static_cast<std::size_t>(edge)];
  if (!known) known = extent(edge, Eigen::Vector3d::UnitZ());
  return *known;
}

}  // namespace ridgeline::part
