#pragma once

#include <string>

#include "jobs/chamfer_job.hpp"

namespace ridgeline::jobs {

/// `--format macro`: a self-contained Custom Macro B program that solves the section method on the
/// control, from arguments, with the ball's radius read from the offset register; for dialect
/// linuxcnc, its twin as a main program. Serves round holes square to the axis of a cylinder or of
/// an upright bore, with the tool along Z through the hole. Throws Error{Unsupported} by field for
/// anything else.
std::string chamfer_macro(const ChamferJob& job);

}  // namespace ridgeline::jobs
