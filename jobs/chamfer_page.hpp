#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "jobs/chamfer_job.hpp"
#include "jobs/check.hpp"

namespace ridgeline::jobs {

/// What a page shows of a chamfer in space: part, ridge line, band, tool, and where to look from.
nlohmann::json chamfer_scene(const ChamferJob& job, const chamfer::Result& result,
                             const verify::Subject& subject);

/// The page of a solved chamfer job: part, ridge line, path, band and tool, with the measured
/// width, the path's error, the clearance and the feed along the ridge line. `document`: the result
/// without its arrays. `rounded`: the motion of the control point as the program says it.
std::string chamfer_page(const ChamferJob& job, const chamfer::Result& result,
                         const path::Motion& rounded, const verify::Subject& subject,
                         const nlohmann::json& document, const Progress& progress);

}  // namespace ridgeline::jobs
