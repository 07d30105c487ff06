#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "core/base/progress.hpp"
#include "core/macro/profile.hpp"
#include "core/macro/result.hpp"
#include "core/macro/value.hpp"

namespace ridgeline::macro {

/// What stops a program that does not stop by itself (alarms 9001 to 9003).
struct Limits {
  std::uint64_t steps = 100'000'000;  ///< blocks executed
  double seconds = 30;                ///< of computing
  std::size_t moves = 3'000'000;      ///< moves, and events, recorded
  std::size_t trace = 200'000;        ///< trace steps kept
  std::size_t kept = 10'000;          ///< of moves and events, when one of these limits was reached
};

struct Options {
  Profile profile;
  /// Variables before the run, in order of their numbers: locals of the main program, commons,
  /// system variables (offsets, work offsets, inputs).
  std::map<int, Value> set;
  /// Text of a program that the main text does not hold; it may hold others too.
  std::function<std::optional<std::string>(int number)> library;
  /// The same of a program <NAME>, in upper case without blanks.
  std::function<std::optional<std::string>(const std::string& name)> named_library;
  std::optional<int> program;  ///< O number to run; default: the first of the text
  bool block_skip = false;     ///< leave out blocks that begin with /
  bool trace = false;
  Limits limits;
};

/// Runs an NC program with macro statements on a simulated control that starts at machine zero.
/// Alarms are part of the result. Throws Error{BadInput} for a variable of `set` that does not
/// exist or a `program` that the text does not hold, Error{Cancelled}.
Result run(std::string text, const Options& options = {}, const Progress& progress = {});

}  // namespace ridgeline::macro
