#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ridgeline::bench {

struct LargeJob {
  std::string name;
  nlohmann::json document;
  std::string format = "json";
};

/// Jobs of each kind that take seconds, or whose answers have millions of numbers.
std::vector<LargeJob> large_jobs();

}  // namespace ridgeline::bench
