#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/chamfer/job.hpp"
#include "core/nc/program.hpp"
#include "jobs/definitions.hpp"

namespace ridgeline::jobs {

/// A chamfer job as values, with its definitions resolved.
struct ChamferJob {
  chamfer::Job job;
  nc::Program program;                    ///< all but the motion and the tool axis
  std::optional<int> workpiece_revision;  ///< absent: inline
  std::optional<int> tool_revision;
  std::optional<std::string> material;     ///< of the workpiece: names a cutting-coefficient set
  nlohmann::json tool_dynamics = nullptr;  ///< of the tool; null: not said
  std::vector<std::string> warnings;
};

/// Reads {"job": "chamfer", ...} of interfaces.md. Throws Error{BadInput} by field,
/// UnknownWorkpiece, UnknownHole, UnknownTool, InconsistentEccentricity.
ChamferJob read_chamfer_job(const Value& value, const Definitions& definitions);

/// Largest accepted difference between a measured width and the asked one [mm]. A path that stays
/// within the tolerance may change the width by the projection of the tolerance on the two
/// surfaces, sqrt(2) of it on a square edge; the decimals of the program bound it from below.
double width_limit(const ChamferJob& job);

/// The names of the job's choices in documents.
std::string_view name(geometry::EdgeKind edge);
std::string_view name(geometry::Side side);
std::string_view name(chamfer::Method method);
std::string_view name(chamfer::Direction direction);

}  // namespace ridgeline::jobs
