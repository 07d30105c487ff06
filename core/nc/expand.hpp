#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.hpp"
#include "core/nc/program.hpp"

/// Macro calls in an NC program replaced by the motion that they ask for (document 000, claim 9).
namespace ridgeline::nc {

/// What a letter of a macro call means: a field of the job that answers it, by its name there.
struct BoundLetter {
  char letter = 0;      ///< A to Z but G, L, N, O, P
  std::string meaning;  ///< e.g. "cutting_amount"
};

/// One macro number and its letters.
struct BoundMacro {
  int number = 0;  ///< P of G65
  std::vector<BoundLetter> letters;
};
using Binding = std::vector<BoundMacro>;

/// Macro 9100: W workpiece, H hole, T tool, Q cutting_amount, V width, E edge (1 inner, 2 outer),
/// S side (1 entry, 2 exit), I inner_radius, J outer_radius, K length, R hole radius,
/// U eccentric_distance, A arrangement_angle, B penetration_angle, X Y Z position, C tolerance,
/// D tool radius, F feed, M spindle_speed.
Binding default_binding();

/// A letter of a call with its value.
struct CallArgument {
  char letter = 0;
  std::string meaning;
  double value = 0;        ///< as written: 10 is 10, whatever the control's least increment
  bool has_point = false;  ///< a control may read lengths without a point as 0.001 mm
  std::string text;        ///< as written, with its letter
};

/// Modes that the program has set where the call stands, in the order of its text.
struct Modes {
  std::string units;        ///< "G20", "G21" or "" when it has said neither; likewise:
  std::string positioning;  ///< "G90", "G91"
  std::string plane;        ///< "G17", "G18", "G19"
  std::string motion;       ///< "G0" to "G3"
  std::string feed;         ///< "F300."
};

struct Call {
  int macro = 0;
  int line = 0;      ///< from 1
  std::string text;  ///< from G65 to its last word
  std::vector<CallArgument> arguments;
  Modes modes;
};

/// The program with every G65 call of a bound macro replaced by what `motion` gives for it (blocks
/// without heads and ends, LF line ends: write() with ProgramKind::Inline). All other bytes stay.
/// What stands before the call in its block (a block number) stays before the first line, what
/// follows it (a comment) behind the last; line ends are those of the call's line. Modes that the
/// motion changed are set back in one more block. L repeats the motion.
///
/// Calls in comments and calls of other macros are left alone. Throws Error{BadFile} with the line
/// and the word for a bound call that cannot be answered: a letter without a meaning, twice the
/// same letter, a value that is a variable or an expression, another word in the block; and
/// Error{Unsupported} for an optional block (/), for G66 of a bound macro and L above 100.
std::string expand(std::string_view program, const Binding& binding,
                   const std::function<std::string(const Call&)>& motion,
                   const Progress& progress = {});

}  // namespace ridgeline::nc
