#include "core/macro/cycle_program.hpp"

#include <algorithm>
#include <cmath>

#include "core/macro/cycle_section.hpp"
#include "core/macro/listing.hpp"
#include "core/macro/outline_motion.hpp"
#include "core/macro/program_body.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

namespace {

std::string title_of(const Cycle& cycle) {
  std::string title;
  switch (cycle.family) {
    case Family::Taper: title = "TAPER"; break;
    case Family::CornerR: title = "CORNER R"; break;
    case Family::BottomR: title = "BOTTOM R"; break;
    case Family::HalfConvex: return "HALF ROUND CONVEX " + std::to_string(cycle.method);
    case Family::HalfConcave: return "HALF ROUND CONCAVE " + std::to_string(cycle.method);
    case Family::RTaperR: title = "R TAPER R"; break;
    case Family::ComplexSide: return "SLOPE ALONG AN OUTLINE";
    case Family::ComplexCornerR: return "CORNER R ALONG AN OUTLINE";
    case Family::HelicalSide: return "WALL OF A CYLINDER, HELICAL IN-FEED";
    case Family::HelicalCornerR: return "CORNER R OF A CYLINDER, HELICAL IN-FEED";
    case Family::Rotation: return "POINTS TURNED ABOUT AN AXIS";
    case Family::Series: return "SINE, COSINE AND TANGENT BY SERIES";
  }
  const char* edges[] = {" STRAIGHT ", " CIRCLE ", " ARC "};
  return title + edges[static_cast<std::size_t>(cycle.edge)] + std::to_string(cycle.method);
}

void write_start(const CycleProgram& options, MacroText& text) {
  text.line(text.is_fanuc() ? "G90 G17 G40 G80" : "G90 G17 G21 G40 G80");
  if (options.tool > 0) {
    text.line(numbered("T", options.tool) + " M06");
    text.line(numbered("G43 H", options.tool));
  }
  if (options.spindle_speed > 0) {
    text.line("S" + number_text(std::round(options.spindle_speed)) + " M03");
  }
  if (!options.work_offset.empty()) text.line(options.work_offset);
}

void write_parameters(const std::vector<Argument>& arguments, MacroText& text) {
  for (const Argument& argument : arguments) {
    text.assign(argument.variable, macro_number(argument.value), argument.meaning);
  }
}

// The head of a macro: every argument, and a call that can be copied.
void write_call(const std::vector<Argument>& arguments, const CycleProgram& options,
                MacroText& text) {
  std::string call = numbered("CALL: G65 P", options.number);
  for (const Argument& argument : arguments) {
    call += std::string(" ") + argument.letter + macro_number(argument.value);
    text.comment(std::string(1, argument.letter) + numbered(" #", argument.variable) + " " +
                 argument.meaning);
  }
  text.comment(call);
  for (const Argument& argument : arguments) {
    if (argument.is_needed) continue;
    text.if_then(numbered("#", argument.variable) + " EQ #0", argument.variable,
                 argument.letter == 'E'   ? "3000"
                 : argument.letter == 'M' ? "1"
                                          : "0");
  }
}

bool is_complex(const Cycle& cycle) {
  return cycle.family == Family::ComplexSide || cycle.family == Family::ComplexCornerR;
}

}  // namespace

std::string cycle_program(const Cycle& cycle, const CycleProgram& options) {
  return cycle_program(cycle, solve(cycle), options, {});  // what cannot be cut is refused
}

std::string cycle_program(const Cycle& cycle, const CycleResult& solved,
                          const CycleProgram& options, const Progress& progress) {
  if (is_complex(cycle) && !cycle.outline) {
    ErrorDetails details;
    details.field = "outline";
    throw Error(ErrorCode::BadInput, "outline must be given for a program", details);
  }
  const bool is_macro = options.kind == CycleProgram::Kind::Macro;
  if (is_macro && options.dialect == ProgramDialect::LinuxCnc) {
    throw Error(ErrorCode::Unsupported, "the LinuxCNC twin is a main program");
  }
  if (is_complex(cycle) && options.dialect == ProgramDialect::LinuxCnc) {
    return nc_text(solved.motion, {.decimals = 6, .is_linuxcnc = true}, progress);
  }

  MacroText text(options.dialect);
  text.line("%");
  if (text.is_fanuc()) {
    text.line(numbered("O", options.number) + "(" + title_of(cycle) + ")");
  } else {
    text.comment(title_of(cycle));
  }
  const std::vector<Argument> arguments = arguments_of(cycle);
  if (is_macro) {
    write_call(arguments, options, text);
  } else {
    write_parameters(arguments, text);
  }
  write_checks(cycle, text);
  if (!is_macro && cycle.family != Family::Series) write_start(options, text);
  if (is_complex(cycle)) {
    write_complex(cycle, text, options.number + 1);
  } else {
    write_body(cycle, text);
  }
  text.line(!text.is_fanuc() ? "M2" : is_macro ? "M99" : "M30");
  if (is_complex(cycle)) {
    text.line(numbered("O", options.number + 1) + "(CONTOUR)");
    write_contour(cycle, text);
    text.line("M99");
  }
  text.line("%");
  return text.text();
}

}  // namespace ridgeline::macro
