#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.hpp"
#include "core/path/motion.hpp"

namespace ridgeline::nc {

enum class Dialect { Fanuc, Siemens, Heidenhain, LinuxCnc };
enum class Positioning { Absolute, Incremental };
/// Inline: comments and motion alone, to stand within another program of FANUC or LinuxCNC, which
/// has the tool, its length, the work offset, spindle and coolant.
enum class ProgramKind { Main, Subprogram, Inline };
enum class Coolant { None, Flood, Mist };

/// What a tool axis that is not a machine axis gives: the control's tilted work plane, or
/// coordinates of the work frame for a control that follows the tool itself.
enum class TiltedOutput { WorkPlane, WorkFrame };

/// An NC program as values: what a writer turns into text. mm, rad, mm/s.
struct Program {
  int number = 1;
  Dialect dialect = Dialect::Fanuc;
  Positioning positioning = Positioning::Absolute;
  ProgramKind kind = ProgramKind::Main;
  int decimals = 4;                 ///< of coordinates, 1 to 6
  std::string work_offset = "G54";  ///< empty: the one that is active
  int tool_number = 0;              ///< 0: no tool call
  int length_offset = 0;            ///< H; 0: the tool number (none without a tool call)
  double spindle_speed = 0;         ///< [rev/min]; 0: the spindle is not touched
  bool spindle_clockwise = true;
  Coolant coolant = Coolant::None;
  std::optional<int> block_number_step;  ///< absent: no block numbers (HEIDENHAIN: always by 1)
  std::vector<std::string> comments;     ///< the job's parameters, echoed at the top
  Eigen::Vector3d tool_axis = Eigen::Vector3d::UnitZ();  ///< tip to spindle, work frame
  TiltedOutput tilted = TiltedOutput::WorkPlane;
  path::Motion motion;  ///< of the control point, work frame
};

/// The program text, LF line ends. Throws Error{BadInput} or Error{Unsupported}.
std::string write(const Program& program, const Progress& progress = {});

/// The motion as the text of write() says it: every coordinate rounded to the decimals, incremental
/// remainders carried, moves that print nothing left out. What a control would run, and what verify
/// measures.
path::Motion rounded(const Program& program, const Progress& progress = {});

/// The axes of the coordinates that write() prints, as columns in the work frame. Identity for a
/// machine axis and for TiltedOutput::WorkFrame. The tilted work plane keeps the origin of the work
/// offset; its Z is the tool axis and its Y is perpendicular to the work frame's X, so that its
/// axes are Rx(A) Ry(B); exactly the ones that the printed angles or vectors define. Arcs of
/// a motion with a tilted plane refer to these axes.
Eigen::Matrix3d plane_axes(const Program& program);

}  // namespace ridgeline::nc
