// Asks for a chamfer path over Fast DDS, as clients/controller does over Cyclone DDS:
//   fast_client DOMAIN SECONDS WORKPIECE HOLE TOOL WIDTH POINTS
// Prints one line "x y z" in mm for each point of the inner edge's cut. Exit status: 0 done, 1
// refused, 2 usage, 3 no answer in time. Uses the loopback, without a discovery tag, which only
// Cyclone has.

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "ridgelinePubSubTypes.h"

// Read by the address sanitizer: Fast DDS deletes statistics of a reader as a smaller type.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "new_delete_type_mismatch=0";
}

namespace {

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastdds::rtps;
namespace wire = ridgeline::wire;
using Clock = std::chrono::steady_clock;

template <class T>
T* must(T* entity, const char* what) {
  if (entity == nullptr) throw std::runtime_error(std::string("cannot create ") + what);
  return entity;
}

/// The participant with all that is in it.
class Participant {
public:
  explicit Participant(std::uint32_t domain) {
    fast::DomainParticipantQos qos = fast::PARTICIPANT_QOS_DEFAULT;
    const auto loopback = std::make_shared<rtps::UDPv4TransportDescriptor>();
    loopback->interfaceWhiteList.emplace_back("127.0.0.1");
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(loopback);
    auto* factory = fast::DomainParticipantFactory::get_instance();
    participant_ = must(factory->create_participant(domain, qos), "participant");
  }
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;
  ~Participant() {
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  fast::Topic* topic(fast::TopicDataType* type, const char* name) {
    const fast::TypeSupport support(type);
    support.register_type(participant_);
    return must(participant_->create_topic(name, type->getName(), fast::TOPIC_QOS_DEFAULT), name);
  }

  fast::DataReader* reader(fast::Topic* topic, const std::string& partition,
                           fast::DurabilityQosPolicyKind durability) {
    fast::SubscriberQos parent = fast::SUBSCRIBER_QOS_DEFAULT;
    if (!partition.empty()) parent.partition().push_back(partition.c_str());
    fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = durability;
    qos.history().kind = fast::KEEP_ALL_HISTORY_QOS;
    qos.endpoint().history_memory_policy =
        eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return must(
        must(participant_->create_subscriber(parent), "subscriber")->create_datareader(topic, qos),
        "reader");
  }

  fast::DataWriter* writer(fast::Topic* topic, const std::string& partition, double life) {
    fast::PublisherQos parent = fast::PUBLISHER_QOS_DEFAULT;
    parent.partition().push_back(partition.c_str());
    fast::DataWriterQos qos = fast::DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = fast::TRANSIENT_LOCAL_DURABILITY_QOS;  // as the service's reader asks
    qos.history().kind = fast::KEEP_ALL_HISTORY_QOS;
    qos.lifespan().duration = eprosima::fastrtps::Duration_t(static_cast<long double>(life));
    qos.endpoint().history_memory_policy =
        eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return must(
        must(participant_->create_publisher(parent), "publisher")->create_datawriter(topic, qos),
        "writer");
  }

  ::dds::GUID_t guid() const {
    const auto& own = participant_->guid();
    ::dds::GUID_t guid;
    std::copy_n(own.guidPrefix.value, 12, guid.guidPrefix().begin());
    std::copy_n(own.entityId.value, 3, guid.entityId().entityKey().begin());
    guid.entityId().entityKind(own.entityId.value[3]);
    return guid;
  }

private:
  fast::DomainParticipant* participant_ = nullptr;
};

constexpr char hex[] = "0123456789abcdef";

std::string client_name(const ::dds::GUID_t& guid) {
  std::string name;
  for (const std::uint8_t byte : guid.guidPrefix()) {
    name += hex[byte >> 4];
    name += hex[byte & 15];
  }
  return name;
}

/// The tool centres, chunk by chunk.
struct Answer {
  std::uint32_t chunks = 0;
  bool is_complete = false, is_refused = false;
  std::vector<double> centres;

  void take(const wire::Reply& reply) {
    if (reply.status() == wire::STATUS_ERROR) {
      std::fprintf(stderr, "fast_client: %s: %s\n", reply.error().code().c_str(),
                   reply.error().message().c_str());
      is_complete = is_refused = true;
      return;
    }
    for (const wire::Piece& piece : reply.arrays()) {
      if (piece.pointer() != "/centres") continue;
      std::size_t size = 1;
      for (const std::uint32_t each : piece.shape()) size *= each;
      centres.resize(size);
      if (piece.offset() > size || piece.values().size() > size - piece.offset())
        throw std::runtime_error("a piece does not fit into its array");
      std::ranges::copy(piece.values(),
                        centres.begin() + static_cast<std::ptrdiff_t>(piece.offset()));
    }
    is_complete = ++chunks == reply.chunk_count();
  }
};

/// Takes what is there and calls f with each sample.
template <class T, class F>
void take_all(fast::DataReader* reader, F&& f) {
  T sample;
  fast::SampleInfo info;
  while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK)
    if (info.valid_data) f(sample);
}

struct Arguments {
  std::uint32_t domain;
  double seconds;
  wire::ChamferJob job;
};

wire::Request request(const Arguments& arguments, const ::dds::GUID_t& guid) {
  wire::Request request;
  request.header().requestId().writer_guid(guid);
  request.header().requestId().sequence_number().low(1);
  request.client(client_name(guid));
  request.format("json");
  request.timeout(arguments.seconds);
  request.call().chamfer(arguments.job);
  return request;
}

int ask(const Arguments& arguments) {
  const auto end = Clock::now() + std::chrono::duration<double>(arguments.seconds);
  Participant participant(arguments.domain);
  const wire::Request asked = request(arguments, participant.guid());
  fast::DataReader* instances =
      participant.reader(participant.topic(new wire::InstancePubSubType, "ridgeline/instance"), "",
                         fast::TRANSIENT_LOCAL_DURABILITY_QOS);
  fast::DataReader* replies =
      participant.reader(participant.topic(new wire::ReplyPubSubType, "ridgeline/reply"),
                         "c_" + client_name(participant.guid()), fast::VOLATILE_DURABILITY_QOS);
  fast::Topic* topic = participant.topic(new wire::RequestPubSubType, "ridgeline/request");
  fast::DataWriter* writer = nullptr;
  bool is_sent = false;
  Answer answer;
  for (; !answer.is_complete && Clock::now() < end;
       std::this_thread::sleep_for(std::chrono::milliseconds(2))) {
    take_all<wire::Instance>(instances, [&](const wire::Instance& instance) {
      if (writer == nullptr && instance.state() == wire::STATE_READY)
        writer = participant.writer(topic, std::string("i_") + instance.name().c_str(),
                                    arguments.seconds);
    });
    if (writer == nullptr) continue;
    fast::PublicationMatchedStatus there;
    fast::SubscriptionMatchedStatus back;
    writer->get_publication_matched_status(there);
    replies->get_subscription_matched_status(back);
    if (!is_sent && there.current_count > 0 && back.current_count > 0) {
      wire::Request copy = asked;
      if (!writer->write(&copy)) throw std::runtime_error("the request cannot be written");
      is_sent = true;
    }
    take_all<wire::Reply>(replies, [&](const wire::Reply& reply) {
      if (reply.header().relatedRequestId() == asked.header().requestId() && !answer.is_complete)
        answer.take(reply);
    });
  }
  if (!answer.is_complete) {
    std::fprintf(stderr, "fast_client: no answer within %g s\n", arguments.seconds);
    return 3;
  }
  for (std::size_t i = 0; i + 2 < answer.centres.size(); i += 3)
    std::printf("%.17g %.17g %.17g\n", answer.centres[i], answer.centres[i + 1],
                answer.centres[i + 2]);
  return answer.is_refused ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 8) {
    std::fputs("usage: fast_client DOMAIN SECONDS WORKPIECE HOLE TOOL WIDTH POINTS\n", stderr);
    return 2;
  }
  Arguments arguments{static_cast<std::uint32_t>(std::atoi(argv[1])), std::atof(argv[2]), {}};
  arguments.job.workpiece(argv[3]);
  arguments.job.hole(argv[4]);
  arguments.job.tool(argv[5]);
  arguments.job.width(std::atof(argv[6]));
  arguments.job.given(wire::GIVEN_POINTS);
  arguments.job.points(static_cast<std::uint32_t>(std::atoi(argv[7])));
  try {
    return ask(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fast_client: %s\n", error.what());
    return 3;
  }
}
