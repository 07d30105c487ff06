#pragma once

#include <string>

#include "core/nc/plan.hpp"

/// One writer for the three controls that speak G code, one for Klartext. Used by write().
namespace ridgeline::nc {

std::string write_g_code(const Program& program, const Plan& plan, const Progress& progress);
std::string write_klartext(const Program& program, const Plan& plan, const Progress& progress);

/// Text of the comments at the top: the job's, then what the tool axis asks of the operator.
std::vector<std::string> head_comments(const Program& program);

}  // namespace ridgeline::nc
