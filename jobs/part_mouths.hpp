#pragma once

#include <nlohmann/json.hpp>

#include "jobs/part_holes.hpp"
#include "part/mouths.hpp"

namespace ridgeline::jobs {

/// {"mouths": [...], "low": [x, y, z], "high": [x, y, z]}: every mouth of a hole in a round wall,
/// with its parameters in file coordinates, angles in degrees.
nlohmann::json mouths_document(const part::Model& model);

/// The answer of hole_edges() for a part that is not turned: each bore is one of a block as large
/// as the part; only edges in bores.
nlohmann::json block_edges(const nlohmann::json& mouths, const std::string& name,
                           const std::optional<ChamferWish>& wish);

/// A chamfer job for an edge.
nlohmann::json chamfer_job(const std::string& workpiece, const std::string& hole, const char* edge,
                           const ChamferWish& wish);

}  // namespace ridgeline::jobs
