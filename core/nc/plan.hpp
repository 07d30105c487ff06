#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/nc/program.hpp"

/// The motion of a program in whole units of its last decimal: what the writers print and what
/// rounded() turns back into a motion, so that both say the same. Used by the writers.
namespace ridgeline::nc {

/// A point in units of 10^-decimals mm, in the axes of plane_axes().
using Grid = std::array<std::int64_t, 3>;

struct ArcStep {
  path::ArcPlane plane = path::ArcPlane::XY;
  path::ArcSense sense = path::ArcSense::CounterClockwise;
  Grid centre{};  ///< in units of 10^-centre_decimals; the third component is the start's
  /// HEIDENHAIN has helices in polar coordinates only: the signed turn [1e-4 degree].
  std::optional<std::int64_t> polar;
};

struct Step {
  path::MoveKind kind = path::MoveKind::Cut;
  bool rapid = false;
  Grid to{};
  Eigen::Vector3d end;    ///< where the control really ends [mm]: `to`, but for a polar helix
  std::int64_t feed = 0;  ///< [0.001 mm/min]
  std::optional<ArcStep> arc;
};

struct Plan {
  Eigen::Matrix3d axes;  ///< plane_axes()
  Grid start{};
  std::vector<Step> steps;
};

/// Largest difference of the radii at the two ends of a written arc [mm]: half of the tightest
/// limit that a control has by default (Siemens MD21000 0.01; FANUC parameter 3410 and LinuxCNC
/// 0.02 and more).
inline constexpr double end_radius_tolerance = 0.005;

/// Decimals of I J K and CC: with fewer than three the radii of many arcs could not agree.
constexpr int centre_decimals(const Program& program) {
  return program.decimals < 3 ? 3 : program.decimals;
}

/// Checks the program and rounds its motion. Throws Error{BadInput} or Error{Unsupported}.
Plan plan(const Program& program, const Progress& progress = {});

/// End of a turn about a centre in the plane (HEIDENHAIN CP), at the start's radius, rounded to
/// 1e-9 mm. `turn` in 1e-9 degree, signed; `height` is the third coordinate of the end.
Eigen::Vector3d polar_end(const Eigen::Vector3d& from, const Eigen::Vector3d& centre,
                          path::ArcPlane plane, std::int64_t turn, double height);

/// Index of the machine axis that the tool lies along in the printed coordinates: 0 X, 1 Y, 2 Z; 2
/// for any other axis.
int length_axis(const Program& program);

/// The tool axis is none of the machine's.
bool is_tilted(const Program& program);
/// A tilted tool in a tilted work plane: the program turns the plane.
bool in_work_plane(const Program& program);
/// A tilted tool in the work frame: the control follows its tip.
bool follows_tool(const Program& program);

}  // namespace ridgeline::nc
