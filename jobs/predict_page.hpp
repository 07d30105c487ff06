#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/cutting/predict.hpp"
#include "jobs/predict_path.hpp"

/// The pages of predictions. `document`: the result without its arrays.
namespace ridgeline::jobs {

/// Force, deflection and the loops' errors over a revolution. n: unit, contact point -> centre.
std::string engagement_page(const cutting::Prediction& prediction, const Eigen::Vector3d& n,
                            const nlohmann::json& document);

/// Error and stability against the speed.
std::string sweep_page(const nlohmann::json& document);

/// The depth at which the cut begins to chatter against the speed; NaN: none.
std::string lobes_page(const std::vector<double>& speeds, const std::vector<double>& limits,
                       const nlohmann::json& document);

/// Error, force, deflection and their kin along a path, and the path in space coloured by them.
/// `scene`: what stands beside it (part, tool, box, ...).
std::string path_page(const AlongJob& job, const PredictedPath& path,
                      const nlohmann::json& document, const nlohmann::json& scene);

}  // namespace ridgeline::jobs
