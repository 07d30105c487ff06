#include "idl/topics.hpp"

#include <algorithm>

namespace ridgeline::dds {
namespace {

using namespace std::chrono_literals;

void reliable(const Qos& qos, std::chrono::nanoseconds blocking) {
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, duration(blocking));
}

void keep_all(const Qos& qos) {
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
}

/// The writer gives its last `depth` samples of each key to readers that come later.
void repeated(const Qos& qos, int depth) {
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, depth, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  dds_qset_writer_data_lifecycle(qos.get(), false);  // what was said holds when the writer goes
}

struct Kind {
  const dds_topic_descriptor_t* type;
  const char* name;
};

Kind kind(Topic topic) {
  switch (topic) {
    case Topic::Request: return {&ridgeline_wire_Request_desc, "ridgeline/request"};
    case Topic::Change: return {&ridgeline_wire_Request_desc, "ridgeline/change"};
    case Topic::Reply: return {&ridgeline_wire_Reply_desc, "ridgeline/reply"};
    case Topic::Progress: return {&ridgeline_wire_Progress_desc, "ridgeline/progress"};
    case Topic::Cancel: return {&ridgeline_wire_Cancel_desc, "ridgeline/cancel"};
    case Topic::Instance: return {&ridgeline_wire_Instance_desc, "ridgeline/instance"};
    case Topic::Definition: return {&ridgeline_wire_Definition_desc, "ridgeline/library"};
  }
  throw Failure("topic", DDS_RETCODE_BAD_PARAMETER);
}

/// The ends that an entity is matched with, by the two functions of the C API for its kind.
template <class List, class Look>
std::vector<dds_guid_t> matched(dds_entity_t entity, List list, Look look) {
  std::vector<dds_instance_handle_t> handles(16);
  for (;;) {
    const dds_return_t count = check(list(entity, handles.data(), handles.size()), "matched");
    const bool is_all = static_cast<std::size_t>(count) <= handles.size();
    handles.resize(static_cast<std::size_t>(count));
    if (is_all) break;
  }
  std::vector<dds_guid_t> participants;
  for (const dds_instance_handle_t handle : handles) {
    const Endpoint endpoint(look(entity, handle));
    if (endpoint) participants.push_back(endpoint->participant_key);  // otherwise just gone
  }
  return participants;
}

}  // namespace

std::vector<dds_guid_t> matched_readers(const Entity& writer) {
  return matched(writer.get(), dds_get_matched_subscriptions, dds_get_matched_subscription_data);
}

std::vector<dds_guid_t> matched_writers(const Entity& reader) {
  return matched(reader.get(), dds_get_matched_publications, dds_get_matched_publication_data);
}

Qos qos(Topic topic) {
  Qos qos(dds_create_qos());
  switch (topic) {
    case Topic::Request:
    case Topic::Change:  // the writer sets the life span to the time that its client waits
      reliable(qos, 2s);
      keep_all(qos);
      repeated(qos, request_samples);
      break;
    case Topic::Cancel:
      reliable(qos, 1s);
      keep_all(qos);
      repeated(qos, request_samples);
      dds_qset_lifespan(qos.get(), duration(10s));
      break;
    case Topic::Reply:  // no blocking: the sender turns to another client instead
      reliable(qos, 0s);
      keep_all(qos);
      break;
    case Topic::Progress:
      dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
      dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 16);
      break;
    case Topic::Instance:
      reliable(qos, 1s);
      dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
      repeated(qos, 1);
      break;
    case Topic::Definition:
      reliable(qos, 5s);
      dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
      repeated(qos, 1);
      break;
  }
  return qos;
}

Entity create_topic(const Entity& participant, Topic topic) {
  const Kind k = kind(topic);
  return {dds_create_topic(participant.get(), k.type, k.name, nullptr, nullptr),
          "dds_create_topic"};
}

void set_partition(const Qos& qos, const std::string& partition) {
  const char* names[] = {partition.c_str()};
  dds_qset_partition(qos.get(), 1, names);
}

std::string instance_partition(std::string_view instance) {
  return "i_" + std::string(instance);
}

std::string client_partition(std::string_view client) {
  return "c_" + std::string(client);
}

bool is_name(std::string_view name) {
  const auto is_allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  };
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), is_allowed);
}

}  // namespace ridgeline::dds
