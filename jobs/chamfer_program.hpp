#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/base/progress.hpp"
#include "jobs/answer.hpp"

namespace ridgeline::jobs {

/// The motion of a chamfer job as blocks to stand within another program, and its certificate.
struct InlineProgram {
  std::string text;
  nlohmann::json report;
};

/// Computes and measures `job`, as the chamfer job does. Throws as that refuses; Unsupported for a
/// dialect or a tilted tool axis that has no such blocks.
InlineProgram inline_program(const nlohmann::json& job, const Definitions& definitions,
                             const Progress& progress);

}  // namespace ridgeline::jobs
