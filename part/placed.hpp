#pragma once

#include <optional>
#include <span>

#include "core/geometry/frame.hpp"
#include "part/axis.hpp"
#include "part/solid.hpp"

namespace ridgeline::part {

/// The turning axis of a solid: the heaviest cluster, by area, of coaxial round faces. Its sense is
/// that of the file: the largest component is positive. nullopt when there is no round face.
std::optional<Axis> turning_axis(const Model& model);

/// Work frame of a turned part in file coordinates: Z on the axis, X along the file's X where that
/// is across, the low end of the part at Z = 0.
geometry::Frame turning_frame(const Model& model, const Axis& axis);

/// A solid seen from a frame: all values in its coordinates.
class Placed {
public:
  Placed(Solid solid, const geometry::Frame& frame);

  const Model& model() const { return model_; }
  const geometry::Frame& frame() const { return frame_; }
  std::vector<Solid::Triangle> mesh(std::span<const int> faces, double deflection) const;
  bool contains(const Eigen::Vector3d& point) const;
  Eigen::Vector3d edge_point(int edge, double t) const;
  double integral(int edge, const Solid::Integrand& f) const;

  /// Where edge `edge` crosses the plane Z = z between its points i and i + 1, on the curve itself.
  Eigen::Vector3d crossing(int edge, std::size_t i, double z) const;

  /// Least and greatest p.d of an edge, on the curve itself; d a unit vector.
  struct Extent {
    double low = 0;
    double high = 0;
  };
  Extent extent(int edge, const Eigen::Vector3d& d) const;
  Extent extent_along_z(int edge) const;

private:
  Solid solid_;
  geometry::Frame frame_;
  Model model_;
  /// Every edge belongs to two faces that ask; one thread at a time.
  mutable std::vector<std::optional<Extent>> along_z_;
};

}  // namespace ridgeline::part
