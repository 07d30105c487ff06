#pragma once

#include <optional>
#include <string>
#include <vector>

/// Turn-mill programs as values, and their text for lathes with a C axis. Lengths mm; X is a radius
/// here and a diameter in the text.
namespace ridgeline::nc {

struct LatheMove {
  enum class Kind { Rapid, Line, Arc } kind = Kind::Line;
  double x = 0;  ///< radius
  double z = 0;
  double radius = 0;          ///< arcs, at most a quarter turn
  bool is_clockwise = false;  ///< arcs, as G2 means it in G18: seen against +Y
  std::optional<double> y;    ///< milling and drilling beside the axis
  double feed = 0;            ///< lines and arcs: mm a revolution when turning, else mm/min
};

/// One drilled hole: along Z, or along X towards the axis.
struct LatheHole {
  bool is_radial = false;
  double x = 0;  ///< radius where it begins (radial) or of its place
  double z = 0;  ///< where it begins (axial) or its place
  double y = 0;
  double c = 0;      ///< degrees
  double end = 0;    ///< Z of the point, or radius of it
  double peck = 0;   ///< depth of a peck
  double clear = 2;  ///< distance in front of the work
};

/// A work plane that a swivelling head turns to: the spindle stands at c, the plane's X and Z are
/// the machine's turned about Y by `angle` from Z towards X. Within it X is a radius.
struct LathePlane {
  double c = 0;      ///< degrees
  double angle = 0;  ///< degrees, above 0 and below 90, a multiple of 0.001
  double y = 0;      ///< its origin, at X 0
  double z = 0;
  double level = 0;  ///< Z in the plane at which the tool moves clear of everything
};

/// One tool at work.
struct LatheStep {
  int tool = 1;
  std::string comment;
  enum class Mode { Turning, Milling } mode = Mode::Turning;  ///< spindle or driven tool turns
  bool is_constant_surface = true;  ///< turning; else at revolutions per minute
  double speed = 0;                 ///< m/min, or rev/min
  double feed = 0;                  ///< of holes: mm a revolution (turning) or mm/min
  std::optional<double> c;          ///< degrees at which the spindle stands while milling
  std::optional<LathePlane> plane;  ///< moves and holes along Z are in it; FANUC alone
  std::vector<LatheMove> moves;
  std::vector<LatheHole> holes;
};

struct LatheProgram {
  int number = 1;
  std::string title;
  std::vector<std::string> comments;
  double safe_x = 100;  ///< radius clear of everything
  double safe_z = 100;
  double top_speed = 3000;  ///< rev/min
  std::vector<LatheStep> steps;
};

enum class LatheControl { Fanuc, LinuxCnc };

/// The text of a program. FANUC: lathe G-code system A (G50, G96/G97, G98/G99), drilling cycles G83
/// and G87, driven tools with M13 and the C axis. LinuxCNC: lathe mode with G7, G95/G94, the same
/// motion, drilling along Z by G83 in G17, along X by plain moves. Coordinates to 3 decimals,
/// diameters to 3. A step in a tilted plane: G68.2 and G53.1, G69.1 after it, B0. Throws
/// Error{BadInput} for a number that is no program number, Error{Unsupported} for a tilted plane on
/// LinuxCNC.
std::string lathe_text(const LatheProgram& program, LatheControl control);

}  // namespace ridgeline::nc
