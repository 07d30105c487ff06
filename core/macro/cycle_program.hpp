#pragma once

#include <string>

#include "core/macro/cycle.hpp"
#include "core/macro/macro_text.hpp"

namespace ridgeline::macro {

/// How the program of a cycle is written.
struct CycleProgram {
  enum class Kind {
    Main,  ///< parameters are set at its top; ends with M30
    Macro  ///< for G65: parameters are arguments, checked; ends with M99
  };
  Kind kind = Kind::Main;
  ProgramDialect dialect = ProgramDialect::Fanuc;  ///< LinuxCNC: main programs
  int number = 8001;                               ///< O; the contour of the complex families: + 1
  std::string work_offset = "G54";                 ///< of a main program
  int tool = 0;                                    ///< 0: no tool change
  double spindle_speed = 0;                        ///< 0: the spindle is not touched
};

/// A parametric program: the cycle's numbers stand only where they are set (or in the call in the
/// head of a macro). Throws as solve(); Error{BadInput} (field "outline") for a complex family
/// without outline; Error{Unsupported} for a LinuxCNC macro.
std::string cycle_program(const Cycle& cycle, const CycleProgram& options = {});
/// The same of a cycle that is solved already.
std::string cycle_program(const Cycle& cycle, const CycleResult& solved,
                          const CycleProgram& options, const Progress& progress);

}  // namespace ridgeline::macro
