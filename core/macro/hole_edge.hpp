#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/macro/macro_text.hpp"

namespace ridgeline::macro {

/// The edge of a round hole whose axis is the tool's, in a cylinder: what a controller needs to
/// solve the section method itself (design section 5; document 000, equations 1 to 22). mm; angles
/// in degrees and feeds in mm/min, as in the program. Hole frame: origin where the hole's axis is
/// nearest to the cylinder's, which is parallel to Y at x = -f, z = 0.
struct HoleEdge {
  double R1 = 20;      ///< radius of the bore (inner edge) or of the outside (outer edge)
  double R2 = 5;       ///< radius of the hole
  double f = 0;        ///< eccentric distance
  double width = 0.5;  ///< W of the chamfer
  bool is_outer = false;
  bool is_exit = false;                 ///< the edge on the far side, z < 0
  std::optional<double> section_angle;  ///< default: the bisector
  double ball_radius = 2;               ///< stands in the offset register
  int offset_number = 1;                ///< D register that holds the ball's radius
  int points = 360;                     ///< equal steps once round
  double start_angle = 0;
  bool is_clockwise = false;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the hole frame's origin
  double rotation = 0;                                 ///< of its Y against Y, about Z
  double feed = 300, approach_feed = 1000;
  double z_clear = 30;  ///< height over the hole frame's origin where rapids are free
};

/// Centre of the ball at profile angle phi [deg], hole frame. Throws Error{WidthTooLarge} when the
/// section has no solution there, Error{BadInput} (details().field) for a hole wider than the bore
/// or a width beyond the ball.
Eigen::Vector3d hole_edge_centre(const HoleEdge& edge, double phi);

/// Fewest equal steps whose chords stay within `tolerance` of the curve of ball centres [mm].
int hole_edge_points(const HoleEdge& edge, double tolerance);

/// A self-contained program that solves every point by Newton's method on one unknown and moves
/// through it; the tip is programmed. A macro (G65) with its arguments in the head, checks that
/// alarm, and the ball's radius from the offset register (geometry and wear); or a main program.
struct HoleEdgeProgram {
  enum class Kind { Main, Macro } kind = Kind::Macro;
  ProgramDialect dialect = ProgramDialect::Fanuc;  ///< LinuxCNC: main programs
  int number = 9100;
  std::string work_offset = "G54";  ///< of a main program
};
std::string hole_edge_program(const HoleEdge& edge, const HoleEdgeProgram& options = {});

}  // namespace ridgeline::macro
