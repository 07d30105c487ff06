#pragma once

#include <map>
#include <string>

#include "core/macro/interpreter.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {

/// A macro job: the program, the programs that it may call, and the control.
struct MacroJob {
  enum class Operation { Run, Check } operation = Operation::Run;
  std::string program;
  std::map<int, std::string> programs;                ///< by O number
  std::map<std::string, std::string> named_programs;  ///< by <NAME>, upper case
  macro::Options options;                             ///< without library; see library_of
  int decimals = 4;                                   ///< of expanded G code
};

/// Reads {"job": "macro", ...} of interfaces.md. Throws Error{BadInput} by field.
MacroJob read_macro_job(Object& job);

/// Looks programs up in job.programs, which outlives it.
std::function<std::optional<std::string>(int)> library_of(const MacroJob& job);
std::function<std::optional<std::string>(const std::string&)> named_library_of(const MacroJob& job);

}  // namespace ridgeline::jobs
