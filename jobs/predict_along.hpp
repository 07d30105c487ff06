#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/cutting/along.hpp"
#include "jobs/kinds.hpp"
#include "jobs/material.hpp"
#include "jobs/reader.hpp"
#include "jobs/tool_dynamics.hpp"

/// Prediction along a path: what all paths (chamfer, program, cycle) share.
namespace ridgeline::jobs {

/// What a path says of tool, material and speed by itself; the job may say it instead.
struct AlongSource {
  tool::Tool tool;
  nlohmann::json dynamics = nullptr;    ///< of the tool; null: not said
  std::optional<std::string> material;  ///< name
  std::string material_at;              ///< JSON pointer of the name
  std::optional<double> rpm;            ///< spindle speed
};

/// A prediction along a path, ready to run.
struct AlongJob {
  cutting::Course course;  ///< the tool axis is the path's to set
  cutting::Compliance compliance;
  double rpm = 0;
  cutting::AlongOptions options;
  std::optional<cutting::CorrectOptions> correct;
  CuttingTool tool;
  Material material;
  std::vector<std::string> warnings;

  double S() const { return rpm / 60; }  ///< [rev/s]
};

/// Reads the members that every path shares:
///
///     "material", "dynamics", "speed_rpm", "method", "N", "nq", "npast", "stock_limit", "options",
///     "uncertainty", "stability": "floquet"|"time_domain"|"none", "stability_every",
///     "correct": true | {"residual", "relative", "max_shifts"}
AlongJob read_along(Object& job, const AlongSource& source, const Definitions& definitions);

/// Stability is tested at so many stations at most unless the job says how often.
inline constexpr int most_tests = 256;
void choose_tests(AlongJob& job, std::size_t stations);

/// Predicts the stations, and corrects them if asked to. Throws Error{NotConverged} where
/// a correction does not converge or would correct a cut that chatters.
struct AlongResult {
  std::vector<cutting::StationError> before;
  std::vector<cutting::StationError> after;  ///< empty unless corrected
  double solve_seconds = 0;
};
AlongResult run_along(AlongJob job, const std::vector<cutting::Station>& stations,
                      const Progress& progress);

/// The stations as they are, and corrected. A job that does not say so tests most_tests of them.
std::vector<cutting::StationError> predicted(AlongJob job,
                                             const std::vector<cutting::Station>& stations,
                                             const Progress& progress);
std::vector<cutting::StationError> corrected(AlongJob job,
                                             const std::vector<cutting::Station>& stations,
                                             const cutting::CorrectOptions& limits,
                                             const Progress& progress);

/// Throws Error{NotConverged} with the first station that chatters: no path takes its error away.
void refuse_chatter(const std::vector<cutting::Station>& stations,
                    const std::vector<cutting::StationError>& errors, double radius);

/// Along a chamfer job.
Answer predict_chamfer(Object& job, const Value& along, const Request& request);

}  // namespace ridgeline::jobs
