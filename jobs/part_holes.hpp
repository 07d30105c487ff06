#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "jobs/part.hpp"

namespace ridgeline::jobs {

/// What chamfering asks besides the edge.
struct ChamferWish {
  nlohmann::json tool;   ///< number, name or object
  nlohmann::json width;  ///< [mm]
};

/// The hole edges of a turned part as the library and chamfer jobs take them:
///
///     {"job", "status", "operation": "holes", "workpieces": [definitions], "edges": [{"workpiece",
///      "hole", "edge", "name"}], "unnamed": [{"name", "kind", "why"}], "jobs": [chamfer jobs]}
///
/// One workpiece for each stretch of bore and outside diameter that holds holes; coordinates of the
/// STEP file. "jobs" only with a wish.
nlohmann::json hole_edges(const Part& part, const std::string& name,
                          const std::optional<ChamferWish>& wish);

}  // namespace ridgeline::jobs
