#pragma once

#include <functional>
#include <memory>
#include <span>

#include "part/model.hpp"

namespace ridgeline::part {

/// A closed solid of a STEP file, in millimetres. Copies share the same solid, which never changes.
class Solid {
public:
  struct Shape;  ///< the solid as Open CASCADE holds it
  explicit Solid(std::shared_ptr<const Shape> shape);

  const Model& model() const { return *model_; }

  /// Triangles of some faces, corners counter-clockwise seen from outside; nodes lie on the
  /// surface.
  struct Triangle {
    int face = 0;
    Eigen::Vector3d corners[3];
  };
  std::vector<Triangle> mesh(std::span<const int> faces, double deflection) const;

  /// Is the point inside the solid?
  bool contains(const Eigen::Vector3d& point) const;

  /// A point of an edge, t from 0 at its start to 1 at its end.
  Eigen::Vector3d edge_point(int edge, double t) const;

  /// Integral of f(p, dp) along an edge from its start to its end, by Gauss points.
  using Integrand = std::function<double(const Eigen::Vector3d& p, const Eigen::Vector3d& dp)>;
  double integral(int edge, const Integrand& f) const;

private:
  std::shared_ptr<const Shape> shape_;
  std::shared_ptr<const Model> model_;
};

}  // namespace ridgeline::part
