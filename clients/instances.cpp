#include "clients/instances.hpp"

#include <algorithm>
#include <cstring>

namespace ridgeline::client {
namespace {

dds::Entity writer(const dds::Entity& participant, const dds::Entity& publisher, dds::Topic topic) {
  return {dds_create_writer(publisher.get(), dds::create_topic(participant, topic).get(),
                            dds::qos(topic).get(), nullptr),
          "dds_create_writer"};
}

}  // namespace

void Instance::open(Way& way, Channel channel) {
  const std::scoped_lock lock(mutex_);
  if (!publisher_) {
    const dds::Qos qos(dds_create_qos());
    dds::set_partition(qos, dds::instance_partition(name));
    publisher_ = {dds_create_publisher(participant_.get(), qos.get(), nullptr),
                  "dds_create_publisher"};
  }
  if (!cancel_writer_) cancel_writer_ = writer(participant_, publisher_, dds::Topic::Cancel);
  way.writer = writer(participant_, publisher_,
                      channel == Channel::Compute ? dds::Topic::Request : dds::Topic::Change);
}

Instance::Way& Instance::way(Channel channel) {
  return channel == Channel::Compute ? compute_ : change_;
}

bool Instance::is_ready(Channel channel, const dds::Entity& reply_reader) {
  Way& way = this->way(channel);
  const std::scoped_lock lock(way.mutex);
  if (way.is_ready) return true;
  if (!way.writer) open(way, channel);
  const auto there = dds::matched_readers(way.writer);
  const auto back = dds::matched_writers(reply_reader);
  const auto same = [](const dds_guid_t& a, const dds_guid_t& b) {
    return std::memcmp(a.v, b.v, sizeof a.v) == 0;
  };
  way.is_ready = std::ranges::find_first_of(there, back, same) != there.end();
  return way.is_ready;
}

bool Instance::write(Channel channel, const ridgeline_wire_Request& request,
                     std::chrono::milliseconds life) {
  Way& way = this->way(channel);
  const std::scoped_lock lock(way.mutex);
  if (way.life != life) {
    const dds::Qos qos(dds_create_qos());
    dds_qset_lifespan(qos.get(), dds::duration(life));
    dds::check(dds_set_qos(way.writer.get(), qos.get()), "dds_set_qos");
    way.life = life;
  }
  const dds_return_t result = dds_write(way.writer.get(), &request);
  if (result == DDS_RETCODE_TIMEOUT) return false;
  dds::check(result, "dds_write");
  return true;
}

void Instance::cancel(const wire::RequestId& id) {
  const ridgeline_wire_Cancel sample{wire::identity(id)};
  const dds_return_t result = dds_write(cancel_writer_.get(), &sample);
  if (result != DDS_RETCODE_TIMEOUT) dds::check(result, "dds_write");
}

}  // namespace ridgeline::client
