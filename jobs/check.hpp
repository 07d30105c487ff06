#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/error.hpp"
#include "core/verify/measure.hpp"
#include "jobs/chamfer_job.hpp"

/// The measured program against what the job asks: the certificate of a result and the verdict of
/// a verification.
namespace ridgeline::jobs {

/// What a motion of the job's control point is measured against. `tool_axis`: resolved, tip to
/// spindle.
verify::Subject subject_of(const ChamferJob& job, const Eigen::Vector3d& tool_axis);

/// What the measured program does not keep; the first of them in order of danger: collisions
/// (NeckCollision, HolderCollision), gouges (ToolTooLarge), rapids closer than the clearance and
/// widths beyond width_limit() (VerificationFailed).
std::vector<Error> failures(const ChamferJob& job, const verify::Subject& subject,
                            const verify::Report& report);

/// The measured part of "report" of interfaces.md.
nlohmann::json report_document(const verify::Report& report);

/// What the tool's description leaves unchecked.
std::vector<std::string> unchecked(const verify::Report& report);

}  // namespace ridgeline::jobs
