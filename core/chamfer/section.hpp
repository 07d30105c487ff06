#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "core/geometry/ridge.hpp"

namespace ridgeline::chamfer {

/// delta = pi/2 - theta/2: equal burr-forming angle on both faces; document 000 [0108].
struct Bisector {};
/// One angle for the whole edge, 0 < delta <= pi/2 [rad].
struct ConstantAngle {
  double delta = 0;
};
/// delta over phi [rad], the polar angle of P about A2 in the hole frame; periodic in 2 pi, linear
/// between entries, ascending in phi within one turn.
struct AngleTable {
  struct Entry {
    double phi = 0;
    double delta = 0;
  };
  std::vector<Entry> entries;
};
using SectionAngle = std::variant<Bisector, ConstantAngle, AngleTable>;

enum class Method { Swept, Section };

/// What the chamfer shall be. Lengths in mm.
struct Chamfer {
  double W = 0;  ///< width: distance G1 to G2
  double D = 0;  ///< cutting radius of the ball
  SectionAngle section_angle = Bisector{};
  Method method = Method::Swept;
};

/// Solution at one target point, hole frame. [E 11]..[E 22].
struct SectionPoint {
  geometry::RidgePoint ridge;
  double delta = 0;    ///< section angle used [rad]
  Eigen::Vector3d G1;  ///< chamfer border on the body surface SS
  Eigen::Vector3d G2;  ///< chamfer border on the hole wall SW
  Eigen::Vector3d C;   ///< tool centre
};

/// An edge and a chamfer made ready for many points. Refers to both: they must outlive it.
struct Section {
  const geometry::Edge* edge = nullptr;
  const Chamfer* chamfer = nullptr;
  geometry::RidgeLine ridge;
  double CM = 0;                        ///< from C to the middle of G1 and G2 [E 16]
  double sin_delta = 0, cos_delta = 0;  ///< of a constant section angle
  /// u in [0, 1), ascending, where the borders may have corners: joints of the profile, entries of
  /// an angle table.
  std::vector<double> corners = {};
  /// Corners and, for the swept method, where else the borders bend anew (wall_breaks()).
  std::vector<double> breaks = {};
};

/// Throws Error: BadInput (W, D or an angle out of range), WidthTooLarge (W >= 2 D).
Section section(const geometry::Edge& edge, const Chamfer& chamfer);

/// Section method [E 11]..[E 22]. Throws Error{WidthTooLarge} with u and P.
SectionPoint section_at(const Section& section, double u);
SectionPoint section_at(const geometry::Edge& edge, const Chamfer& chamfer, double u);

/// Swept method (design: section 5): the same borders, the centre that really cuts them. Throws
/// Error{SweptNotReached} with u and P.
SectionPoint swept_at(const Section& section, double u);
SectionPoint swept_at(const geometry::Edge& edge, const Chamfer& chamfer, double u);

}  // namespace ridgeline::chamfer
