#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jobs/recording.hpp"

namespace ridgeline::schema {

/// A valid document and the definition that it is of, e.g. "chamfer" or "tool".
struct Sample {
  std::string name;
  std::string definition;
  nlohmann::json document;
};

/// Every job and definition of clients/examples and tests/schema/jobs. Paths from the source
/// folder.
std::vector<Sample> samples();

/// Reads all of them as the service does and returns what was asked of them.
/// Throws std::runtime_error for one that is refused.
void record(const std::vector<Sample>& samples, jobs::Recording& recording);

}  // namespace ridgeline::schema
