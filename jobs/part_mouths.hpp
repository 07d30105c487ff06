#pragma once

#include <nlohmann/json.hpp>

#include "jobs/part_holes.hpp"

namespace ridgeline::jobs {

/// The answer of hole_edges() for the mouths (part.hpp) of a part that is not turned: each bore is
/// one of a block as large as the part; only edges in bores.
nlohmann::json block_edges(const nlohmann::json& mouths, const std::string& name,
                           const std::optional<ChamferWish>& wish);

/// A chamfer job for an edge.
nlohmann::json chamfer_job(const std::string& workpiece, const std::string& hole, const char* edge,
                           const ChamferWish& wish);

}  // namespace ridgeline::jobs
