#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include "core/path/motion.hpp"

namespace ridgeline::nc {

enum class Dialect { Fanuc, Siemens, Heidenhain, LinuxCnc };
enum class Positioning { Absolute, Incremental };
enum class ProgramKind { Main, Subprogram };

/// An NC program as values: what a writer turns into text. mm, rad, mm/s.
struct Program {
  int number = 1;
  Dialect dialect = Dialect::Fanuc;
  Positioning positioning = Positioning::Absolute;
  ProgramKind kind = ProgramKind::Main;
  int decimals = 4;
  std::string work_offset = "G54";
  int tool_number = 0;
  int length_offset = 0;     ///< H
  double spindle_speed = 0;  ///< [rev/min]
  bool spindle_clockwise = true;
  std::optional<int> block_number_step;  ///< absent: no block numbers
  std::vector<std::string> comments;     ///< the job's parameters, echoed at the top
  std::optional<Eigen::Vector3d>
      tilted_axis;      ///< tool axis of a tilted work plane; absent: a machine axis
  path::Motion motion;  ///< of the control point, work frame
};

/// The program text, LF line ends.
std::string write(const Program& program);

/// The motion as the text of write() says it: every coordinate rounded to the decimals, incremental
/// remainders carried. What a control would run, and what verify measures.
path::Motion rounded(const Program& program);

}  // namespace ridgeline::nc
