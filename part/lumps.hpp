#pragma once

#include <vector>

#include "core/units/region.hpp"
#include "part/meridian.hpp"

namespace ridgeline::part {

/// What is cut out of the envelope in one piece: the faces of the product that bound it.
struct Lump {
  std::vector<int> faces;
  double volume = 0;        ///< inside the envelope [mm^3]
  bool is_measured = true;  ///< false: its mouth does not lie on the envelope, volume unknown
};

/// The envelope E = S revolved, and where it is.
class Envelope {
public:
  explicit Envelope(units::Region shadow) : shadow_(std::move(shadow)) {}
  const units::Region& shadow() const { return shadow_; }
  /// Is the point inside by more than `margin`?
  bool is_inside(const Eigen::Vector3d& p, double margin) const;
  /// From p on along d, at most `far`: how far to where E ends.
  double distance_to_end(const Eigen::Vector3d& p, const Eigen::Vector3d& d, double far) const;

private:
  units::Region shadow_;
};

/// Faces that are not part of E, grouped where they meet inside E. Volumes by the divergence
/// theorem over faces and mouths, exact: V = - sum of face fluxes + closed integral of r^2/2 theta
/// dz.
std::vector<Lump> lumps_of(const Placed& part, const TurnedFaces& turned, const Envelope& envelope);

}  // namespace ridgeline::part
