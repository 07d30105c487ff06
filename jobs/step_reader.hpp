#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/progress.hpp"

namespace ridgeline::jobs {

/// What reading a file may take before it is stopped.
struct ReaderLimits {
  double seconds = 120;
  double gigabytes = 4;
};

/// Hands a STEP file to the program ridgeline-step and returns the document that it answers:
/// whatever a file makes a translator do (fault, endless loop, all memory), this process goes on,
/// and only that program links Open CASCADE. `wish`: {"want": ...} of step/reading.hpp. The program
/// is looked for as libexec/ridgeline/ridgeline-step in the folders above the running program's.
/// Throws Error{BadFile} when the reader died or took too much, Error{Storage} when there is none,
/// Error{Cancelled} within 100 ms of a stop.
nlohmann::json read_step_file(nlohmann::json wish, std::string_view step, const Progress& progress,
                              const ReaderLimits& limits = {});

}  // namespace ridgeline::jobs
