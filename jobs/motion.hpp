#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/path/motion.hpp"
#include "jobs/answer.hpp"

namespace ridgeline::jobs {

/// Points as an array of the shape {n, 3}.
Array points_array(std::string pointer, const std::vector<Eigen::Vector3d>& points,
                   const Progress& progress = {});

/// The moves of a motion as a table at `pointer`, feeds in mm/min (0: rapid); see Array. The member
/// of `document` at the pointer becomes the description of its columns.
Array moves_array(std::string pointer, const path::Motion& motion, nlohmann::json& document,
                  const Progress& progress = {});

}  // namespace ridgeline::jobs
