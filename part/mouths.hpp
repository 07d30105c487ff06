#pragma once

#include <string>
#include <vector>

#include "part/placed.hpp"

namespace ridgeline::part {

/// The mouth of a hole in a round wall, in file coordinates. Design units.md, section 4.
struct Mouth {
  enum class Kind { Round, Slot, RoundedRectangle, Rectangle, Countersunk, EqualDiameters, Mixed };
  Kind kind = Kind::Mixed;
  Axis wall;                                        ///< of the round wall that it opens in
  double wall_radius = 0;                           ///< R1 [mm]
  bool is_bore = false;                             ///< the wall is a bore; else an outside
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< on the hole's axis, nearest to the wall's
  Eigen::Vector3d out = Eigen::Vector3d::UnitX();  ///< along its axis, from the wall's to the mouth
  double radius = 0;                               ///< of the hole, or of its corners [mm]
  double length = 0;                               ///< over all, along the longer side; 0: round
  double width = 0;
  double skew = 0;          ///< of the longer side against the wall's axis, square to `out` [rad]
  double angle = 0;         ///< between both axes [rad], at most pi / 2
  double eccentricity = 0;  ///< distance of both axes [mm]
  std::string why;          ///< of Mixed and others that no definition describes
};

/// Every closed chain of sharp convex edges round a hole in a round wall.
std::vector<Mouth> mouths_of(const Model& model);

std::string name(Mouth::Kind kind);

}  // namespace ridgeline::part
