#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "core/nc/program.hpp"
#include "jobs/definitions.hpp"
#include "jobs/predict_along.hpp"

/// Prediction along a path through stock that it cuts as it goes: programs and cycles.
namespace ridgeline::jobs {

struct WorkPath {
  std::string_view kind;                                 ///< "program", "cycle"
  path::Motion motion;                                   ///< of the control point
  Eigen::Vector3d tool_axis = Eigen::Vector3d::UnitZ();  ///< tip to spindle
  std::optional<double> rpm;                             ///< spindle speed, if the path says one
  nc::Program program;                                   ///< how the corrected motion is written
  /// Normal of the wanted surface, towards the tool, for a ball centre.
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> normal;
};

/// "tool" of a job along such a path.
ResolvedTool resolve_path_tool(Object& job, const Definitions& definitions);

/// Reads of `along` "stock" {"min", "max", "cell"} | {"origin", "cell", "columns", "heights"},
/// "step", "control_point", and of the job what every path shares.
Answer predict_work(Object& job, Object& along, WorkPath work, const ResolvedTool& tool,
                    const Request& request);

/// Along an NC program: {"job": "program", "program": TEXT, "stock", "normal", ...}.
Answer predict_nc(Object& job, const Value& along, const Request& request);
/// Along a cycle: its job with "stock", ...
Answer predict_cycle(Object& job, const Value& along, const Request& request);

}  // namespace ridgeline::jobs
