#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace ridgeline::wire {

/// An instance as it announced itself.
struct InstanceStatus {
  std::string name;
  std::string version;
  std::string host;
  int pid = 0;
  bool is_stopping = false;
  std::int64_t started = 0;  ///< [ns since 1970]
  std::vector<std::string> operations;
  std::uint32_t workers = 1;
  std::uint32_t queue_limit = 0;
  std::uint32_t running = 0;
  std::uint32_t queued = 0;
  std::uint32_t clients = 0;
  std::uint64_t requests = 0;
  std::uint64_t duplicates = 0;
  std::uint64_t undelivered = 0;
  std::vector<std::pair<std::string, std::uint64_t>> answers;  ///< by code, "ok" first
  double latency_p50 = 0;                                      ///< taken to sent [s]
  double latency_p99 = 0;
  double latency_max = 0;
  std::uint64_t bytes_sent = 0;
  std::uint64_t memory = 0;  ///< resident [bytes]
  std::uint64_t library_changes = 0;
  std::uint64_t library_digest = 0;
  std::uint64_t library_conflicts = 0;
  std::string library_damage;
  std::string log_level;
};

/// The status as `ridgeline status --format json` prints it.
nlohmann::json document(const InstanceStatus& status);

}  // namespace ridgeline::wire
