#pragma once

#include <string>
#include <vector>

#include "core/units/program.hpp"

namespace ridgeline::units {

/// A move of the nose centre of a turning tool in the half section.
struct TurningMove {
  enum class Kind { Rapid, Feed } kind = Kind::Feed;
  Segment path;
};

/// Where a turning tool comes from; its body lies on that side of its nose.
enum class Approach { Outer, Inner, Front, Back };

/// One tool of a turned unit at work.
struct TurningStep {
  enum class Kind { Turn, Drill } kind = Kind::Turn;
  ToolRow tool;
  Approach approach = Approach::Outer;
  double allowance = 0;            ///< left on the product by this step [mm]
  std::vector<TurningMove> moves;  ///< turning
  double width = 0;                ///< of a grooving tool; its moves are of the corner at least r
  double drill_diameter = 0;       ///< drilling on the axis, along Z
  double drill_from = 0;           ///< Z where it enters
  double drill_to = 0;             ///< Z of its point
};

struct TurningPaths {
  std::vector<TurningStep> steps;
  std::vector<std::string> notes;  ///< what a tool needs for it, what is not written and why
};

/// Rapids keep this distance from stock and product [mm].
constexpr double turning_clearance = 2;

/// Paths that turn a unit: roughing in steps of the depth of cut, along Z for bars and along X for
/// faces, each pass up to where the nose meets the product and its allowance; then along the
/// product; finishing. Grooves by plunging; a bore from the solid is drilled first. Bars move away
/// from the end of their process. The nose never comes nearer to the product than the allowance.
/// Throws Error{BadInput} for a depth of cut or nose radius that cannot work.
TurningPaths turning_paths(const Program& program, const Unit& unit);

/// Where the nose and the shank behind it have been on the feed moves of a step.
Region swept(const TurningStep& step);

/// What the paths of a process leave of stock and cut of product, by the 2D engine.
struct TurningCheck {
  double gouge = 0;      ///< product swept [mm^3]
  double left = 0;       ///< of the regions of its units, not swept [mm^3]
  double thickness = 0;  ///< of that, where it is thickest along r [mm]
};
TurningCheck check_turning(const Program& program, const Unit& unit, const TurningPaths& paths);

}  // namespace ridgeline::units
