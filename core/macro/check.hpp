#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/macro/profile.hpp"

namespace ridgeline::macro {

enum class Severity { Error, Warning };

/// A likely mistake, found without running the program.
struct Finding {
  std::string rule;  ///< e.g. "real_equality", "missing_end", "unreachable", "look_ahead"
  Severity severity = Severity::Warning;
  std::string message;
  int program = 0;  ///< O number
  int line = 0;
  int column = 0;
};

/// Reads every program of a text and reports, in order of lines:
/// - format (error): a block that raises an alarm when it is reached; missing_end: WHILE, DO and
///   END that do not pair;
/// - goto_target, goto_into_loop (error): jumps that cannot be made; double_label (warning);
/// - real_equality (warning): EQ or NE between computed reals;
/// - adds_up (warning): a loop counter that grows by a fraction, so that its last pass depends on
///   rounding;
/// - unreachable (warning): blocks that no way leads to;
/// - look_ahead (warning): reads that a control does ahead of the motion;
/// - never_assigned (warning): locals of a main program that nothing assigns;
/// - missing_program (warning): a call of a program that neither the text nor the library has.
std::vector<Finding> check(std::string text, const Profile& profile,
                           const std::function<bool(int number)>& has_program = {});

}  // namespace ridgeline::macro
