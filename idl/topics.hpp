#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "idl/dds.hpp"
#include "ridgeline.h"

namespace ridgeline::dds {

/// The topics of docs/dds.md, and what both ends must agree on: name, type, QoS, partition.
enum class Topic { Request, Change, Reply, Progress, Cancel, Instance, Definition };

Entity create_topic(const Entity& participant, Topic topic);

/// The QoS of the topic's readers and writers; each end adds what is its own.
Qos qos(Topic topic);

void set_partition(const Qos& qos, const std::string& partition);

/// Where the requests of an instance and the replies of a client go.
std::string instance_partition(std::string_view instance);
std::string client_partition(std::string_view client);

/// Names of instances and clients: 1 to 64 of letters, digits, '_', '-' and '.', as they become
/// partitions, where other characters are patterns.
bool is_name(std::string_view name);

/// GUIDs of the participants whose readers a writer reaches now, and the other way round.
std::vector<dds_guid_t> matched_readers(const Entity& writer);
std::vector<dds_guid_t> matched_writers(const Entity& reader);

/// How long a silent instance counts as alive.
inline constexpr std::chrono::milliseconds lease{1000};
/// Chunks of a reply that a client holds before the service must wait for it.
inline constexpr int reply_samples = 64;
/// Requests that a writer repeats to an instance which comes back.
inline constexpr int request_samples = 64;
/// Largest text of one request [bytes].
inline constexpr std::size_t max_request_bytes = 64'000'000;

inline dds_duration_t duration(std::chrono::nanoseconds time) {
  return time.count();
}

}  // namespace ridgeline::dds
