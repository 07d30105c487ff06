#pragma once

#include <string>
#include <vector>

#include "core/cutting/compliance.hpp"
#include "core/cutting/cutter.hpp"
#include "core/tool/tool.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {

/// A tool ready to cut: its edges and how it gives way at the ball centre.
struct CuttingTool {
  cutting::Cutter cutter;
  cutting::Compliance compliance;
  bool is_estimate = false;  ///< the compliance comes from geometry, nobody measured it
  std::string source;        ///< where the compliance comes from
  std::vector<std::string> warnings;
};

/// Checks "dynamics" of a tool definition, an object of, all optional:
///
///     "modes" | "modes_x", "modes_y"      [[Hz, zeta, N/mm], ...] at the ball centre
///     "frf" | "frf_x", "frf_y"            [[Hz, re, im], ...] in mm/N; modes are fitted to it
///     "beam"                              {"modulus", "density", "damping", "holder_stiffness",
///                                          "modes"}
///     "pitch_deg", "runout_mm", "offset_mm", "offset_deg", "lag", "tw_mode", "source"
///
/// Without any of the first three the tool's own geometry is taken as a beam of cemented carbide.
void check_dynamics(const Value& value, const tool::Tool& tool);

/// `dynamics`: of the tool's definition or of the job; null: a beam from its geometry. `pointer`:
/// where the tool stands. `elements` per tooth and quarter turn of the ball. Throws
/// Error{BadInput}.
CuttingTool cutting_tool(const tool::Tool& tool, const Value& dynamics, int elements);

/// The compliance as a result reports it.
nlohmann::json document_of(const CuttingTool& tool);

}  // namespace ridgeline::jobs
