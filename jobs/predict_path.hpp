#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/predict_along.hpp"

namespace ridgeline::jobs {

/// A predicted path with what its kind knows beyond the stations.
struct PredictedPath {
  std::string_view kind;                  ///< "chamfer", "program", "cycle"
  std::vector<Eigen::Vector3d> position;  ///< control point of the program at each station
  std::vector<cutting::Station> stations;
  AlongResult result;
  std::vector<cutting::StationError> finish;  ///< of a spring pass corrected: the pass before it
  std::vector<std::size_t> entries;           ///< stations that the tool comes to without cutting
  bool is_closed = false;                     ///< the last station goes over into the first
  std::vector<double> parameter;              ///< of a chamfer: profile parameter
  std::vector<double> width, width_after;     ///< of a chamfer: predicted [mm]
  double wanted_width = 0;                    ///< of a chamfer
};

/// Result document with its arrays.
Answer path_answer(const AlongJob& job, const PredictedPath& path);
std::string path_csv(const PredictedPath& path);
std::string path_drawing(const AlongJob& job, const PredictedPath& path);

}  // namespace ridgeline::jobs
