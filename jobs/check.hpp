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

/// One thing that a measured program does not keep.
struct Failure {
  Error error;
  std::optional<std::size_t> move;  ///< index of the move where it is worst
};

/// What the measured program does not keep, in order of danger: collisions (NeckCollision,
/// HolderCollision), gouges (ToolTooLarge), rapids that touch and widths beyond width_limit()
/// (VerificationFailed).
std::vector<Failure> failures(const ChamferJob& job, const verify::Subject& subject,
                              const verify::Report& report);

/// Is it the width that is not kept?
bool is_width(const Failure& failure);

/// The measured part of "report" of interfaces.md.
nlohmann::json report_document(const verify::Report& report);

/// What the tool's description leaves unchecked.
std::vector<std::string> unchecked(const verify::Report& report);

}  // namespace ridgeline::jobs
