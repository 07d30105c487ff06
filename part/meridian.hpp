#pragma once

#include <vector>

#include "core/units/curve.hpp"
#include "part/placed.hpp"

namespace ridgeline::part {

/// What a face that is turned shows in the half section: r(z) between z0 and z1.
struct Meridian {
  units::Curve curve;
  double z0 = 0;
  double z1 = 0;
  int side = 1;  ///< +1: material at smaller r (a shaft), -1: material at greater r (a bore)
  int face = 0;
};

/// A plane across the axis.
struct Shoulder {
  double z = 0;
  double r0 = 0;
  double r1 = 0;
  int face = 0;
};

/// Every face sorted by what it is to turning; the part is placed on the turning axis.
struct TurnedFaces {
  std::vector<Meridian> meridians;
  std::vector<Shoulder> shoulders;
  std::vector<char> is_coaxial;  ///< of every face: cylinder, cone, torus, sphere, revolution
  double round_area = 0;         ///< of the coaxial faces [mm^2]
  double plane_area = 0;         ///< of the shoulders that are round outside [mm^2]
  double area = 0;               ///< of all faces
};
TurnedFaces turned_faces(const Placed& part);

}  // namespace ridgeline::part
