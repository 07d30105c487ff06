#include <fmt/format.h>

#include "jobs/text.hpp"
#include "service/library_job.hpp"
#include "service/wire.hpp"

namespace ridgeline::wire {

InstanceStatus instance_status(const ridgeline_wire_Instance& s) {
  InstanceStatus status{.name = s.name,
                        .version = s.version,
                        .host = s.host,
                        .pid = s.pid,
                        .is_stopping = s.state == ridgeline_wire_STATE_STOPPING,
                        .started = s.started,
                        .operations = {},
                        .workers = std::max(s.workers, 1U),
                        .queue_limit = s.queue_limit,
                        .running = s.running,
                        .queued = s.queued,
                        .clients = s.clients,
                        .requests = s.requests,
                        .duplicates = s.duplicates,
                        .undelivered = s.undelivered,
                        .answers = {},
                        .latency_p50 = s.latency_p50,
                        .latency_p99 = s.latency_p99,
                        .latency_max = s.latency_max,
                        .bytes_sent = s.bytes_sent,
                        .memory = s.memory,
                        .library_changes = s.library_changes,
                        .library_digest = s.library_digest,
                        .library_conflicts = s.library_conflicts,
                        .library_damage = s.library_damage,
                        .log_level = s.log_level};
  for (std::uint32_t i = 0; i < s.operations._length; ++i) {
    status.operations.emplace_back(s.operations._buffer[i]);
  }
  for (std::uint32_t i = 0; i < s.answers._length; ++i) {
    status.answers.emplace_back(s.answers._buffer[i].code, s.answers._buffer[i].count);
  }
  return status;
}

void with_sample(const InstanceStatus& status,
                 const std::function<void(const ridgeline_wire_Instance&)>& write) {
  ridgeline_wire_Instance s{};
  copy(status.name, s.name);
  copy(status.version, s.version);
  copy(status.host, s.host);
  s.pid = status.pid;
  s.state = status.is_stopping ? ridgeline_wire_STATE_STOPPING : ridgeline_wire_STATE_READY;
  s.started = status.started;
  std::vector<char*> operations;
  for (const std::string& each : status.operations) operations.push_back(borrowed(each));
  s.operations._length = s.operations._maximum = static_cast<std::uint32_t>(operations.size());
  s.operations._buffer = operations.data();
  s.workers = status.workers;
  s.queue_limit = status.queue_limit;
  s.running = status.running;
  s.queued = status.queued;
  s.clients = status.clients;
  s.requests = status.requests;
  s.duplicates = status.duplicates;
  s.undelivered = status.undelivered;
  std::vector<ridgeline_wire_CodeCount> answers;
  for (const auto& [code, count] : status.answers) answers.push_back({borrowed(code), count});
  s.answers._length = s.answers._maximum = static_cast<std::uint32_t>(answers.size());
  s.answers._buffer = answers.data();
  s.latency_p50 = status.latency_p50;
  s.latency_p99 = status.latency_p99;
  s.latency_max = status.latency_max;
  s.bytes_sent = status.bytes_sent;
  s.memory = status.memory;
  s.library_changes = status.library_changes;
  s.library_digest = status.library_digest;
  s.library_conflicts = status.library_conflicts;
  s.library_damage = borrowed(status.library_damage);
  copy(status.log_level, s.log_level);
  write(s);
}

nlohmann::json document(const InstanceStatus& status) {
  nlohmann::json answers = nlohmann::json::object();
  for (const auto& [code, count] : status.answers) answers[jobs::valid_utf8(code)] = count;
  nlohmann::json library = {{"changes", status.library_changes},
                            {"digest", fmt::format("{:016x}", status.library_digest)},
                            {"conflicts", status.library_conflicts}};
  if (!status.library_damage.empty()) library["damage"] = jobs::valid_utf8(status.library_damage);
  return {{"name", status.name},
          {"version", status.version},
          {"host", jobs::valid_utf8(status.host)},
          {"pid", status.pid},
          {"state", status.is_stopping ? "stopping" : "ready"},
          {"started", service::time_text(status.started)},
          {"operations", status.operations},
          {"workers", status.workers},
          {"queue_limit", status.queue_limit},
          {"running", status.running},
          {"queued", status.queued},
          {"clients", status.clients},
          {"requests", status.requests},
          {"duplicates", status.duplicates},
          {"undelivered", status.undelivered},
          {"answers", answers},
          {"latency_ms",
           {{"p50", status.latency_p50 * 1e3},
            {"p99", status.latency_p99 * 1e3},
            {"max", status.latency_max * 1e3}}},
          {"bytes_sent", status.bytes_sent},
          {"memory", status.memory},
          {"library", library},
          {"log_level", status.log_level}};
}

}  // namespace ridgeline::wire
