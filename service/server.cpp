#include "service/server.hpp"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <thread>

#include "core/base/version.hpp"
#include "service/log.hpp"

namespace ridgeline::service {
namespace {

using namespace std::chrono_literals;

constexpr auto tick_interval = 100ms;
constexpr auto drain_limit = 10s;
constexpr auto trim_interval = 10s;  // memory that large answers left goes back to the system

std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// Resident memory of this process [bytes].
std::uint64_t memory() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t total = 0, resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

dds::Entity subscriber(const dds::Entity& participant, const std::string& instance) {
  const dds::Qos qos(dds_create_qos());
  dds::set_partition(qos, dds::instance_partition(instance));
  return {dds_create_subscriber(participant.get(), qos.get(), nullptr), "dds_create_subscriber"};
}

/// Alive is who writes: the loop below does, several times in a lease.
dds::Entity announcer(const dds::Entity& participant, const dds::Entity& topic) {
  const dds::Qos qos = dds::qos(dds::Topic::Instance);
  dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, dds::duration(dds::lease));
  return {dds_create_writer(participant.get(), topic.get(), qos.get(), nullptr),
          "dds_create_writer"};
}

dds::Entity reader(dds_entity_t parent, dds_entity_t topic, const dds::Qos& qos,
                   const dds_listener_t* listener = nullptr) {
  return {dds_create_reader(parent, topic, qos.get(), listener), "dds_create_reader"};
}

dds::Entity reader(const dds::Entity& participant, const dds::Entity& parent, dds::Topic topic) {
  return reader(parent.get(), dds::create_topic(participant, topic).get(), dds::qos(topic));
}

}  // namespace

Server::Server(const ServerOptions& options, Library& library)
    : domain_(dds::Domain::open(options.domain)),
      participant_(domain_->participant()),
      instance_(options.instance),
      started_(now()),
      library_(library),
      sharing_(participant_, library),
      dispatch_(library, sharing_, [this] { return status(); }),
      replies_(participant_, instance_),
      work_(
          options.limits,
          [this](const wire::Request& request, Channel channel, const Progress& progress) {
            return dispatch_.answer(request, channel, progress);
          },
          replies_, counters_),
      subscriber_(subscriber(participant_, instance_)),
      instance_topic_(dds::create_topic(participant_, dds::Topic::Instance)),
      announcer_(announcer(participant_, instance_topic_)),
      instance_reader_(
          reader(participant_.get(), instance_topic_.get(), dds::qos(dds::Topic::Instance))),
      client_reader_(dds_create_reader(participant_.get(), DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION,
                                       nullptr, nullptr),
                     "dds_create_reader"),
      cancel_reader_(reader(participant_, subscriber_, dds::Topic::Cancel)),
      stop_(dds_create_guardcondition(participant_.get()), "dds_create_guardcondition"),
      waitset_(dds_create_waitset(participant_.get()), "dds_create_waitset"),
      request_reader_(request_reader(dds::Topic::Request, compute_)),
      change_reader_(request_reader(dds::Topic::Change, change_)) {
  for (const dds::Entity* entity : {&instance_reader_, &client_reader_, &cancel_reader_}) {
    dds::check(dds_set_status_mask(entity->get(), DDS_DATA_AVAILABLE_STATUS),
               "dds_set_status_mask");
    dds::check(dds_waitset_attach(waitset_.get(), entity->get(), 0), "dds_waitset_attach");
  }
  dds::check(dds_waitset_attach(waitset_.get(), stop_.get(), 0), "dds_waitset_attach");
}

Server::~Server() {
  request_reader_ = {};  // no listener runs any more when these are gone
  change_reader_ = {};
}

dds::Entity Server::request_reader(dds::Topic topic, Inlet& inlet) {
  const dds::Listener listener(dds_create_listener(&inlet));
  dds_lset_data_available(listener.get(), &Server::on_requests);
  return reader(subscriber_.get(), dds::create_topic(participant_, topic).get(), dds::qos(topic),
                listener.get());
}

void Server::on_requests(dds_entity_t reader, void* argument) noexcept {
  const auto* inlet = static_cast<const Inlet*>(argument);
  try {
    inlet->server->take_requests(reader, inlet->channel);
  } catch (const std::exception& error) {
    log::event(log::Level::Error, "take", {{"message", error.what()}});
  }
}

void Server::take_requests(dds_entity_t reader, Channel channel) {
  for (;;) {
    const dds::Taken<ridgeline_wire_Request> samples(reader);
    if (samples.empty()) return;
    samples.for_each([&](const ridgeline_wire_Request& sample, const dds_sample_info_t& info) {
      if (!info.valid_data) return;
      wire::Request request = wire::request(sample);
      if (dds::is_name(request.client)) {
        work_.take(std::move(request), channel,
                   std::chrono::nanoseconds(dds_time() - info.source_timestamp));
      } else {
        log::event(log::Level::Warning, "no_client",
                   {{"id", wire::text(request.id)},
                    {"message", "the request does not name a client that could be answered"}});
      }
    });
  }
}

void Server::take_cancels() {
  const dds::Taken<ridgeline_wire_Cancel, 64> samples(cancel_reader_);
  samples.for_each([this](const ridgeline_wire_Cancel& sample, const dds_sample_info_t& info) {
    if (info.valid_data) work_.cancel(wire::request_id(sample.requestId));
  });
}

/// Makes the writers for each client whose reader appears, so that its first reply need not wait.
void Server::take_clients() {
  const dds::Taken<dds_builtintopic_endpoint_t, 64> samples(client_reader_);
  samples.for_each(
      [this](const dds_builtintopic_endpoint_t& endpoint, const dds_sample_info_t& info) {
        if (!info.valid_data || std::string_view(endpoint.topic_name) != "ridgeline/reply") return;
        std::uint32_t count = 0;
        char** partitions = nullptr;
        if (!dds_qget_partition(endpoint.qos, &count, &partitions)) return;
        for (std::uint32_t i = 0; i < count; ++i) {
          const std::string_view partition = partitions[i];
          const std::string client(partition.substr(std::min<std::size_t>(2, partition.size())));
          if (partition.starts_with("c_") && dds::is_name(client)) replies_.open(client);
          dds_free(partitions[i]);
        }
        dds_free(partitions);
      });
}

void Server::look_for_namesake() {
  const dds::Taken<ridgeline_wire_Instance, 64> samples(instance_reader_);
  samples.for_each([this](const ridgeline_wire_Instance& sample, const dds_sample_info_t& info) {
    const bool is_namesake = info.valid_data && info.instance_state == DDS_ALIVE_INSTANCE_STATE &&
                             sample.name == instance_ && sample.started != started_;
    if (is_namesake && sample.started < started_ && stops_ == 0) {
      throw Error(ErrorCode::BadInput, "an instance with the name " + instance_ + " runs on " +
                                           sample.host + " already (process " +
                                           std::to_string(sample.pid) +
                                           "): give each its own --instance");
    }
  });
}

wire::InstanceStatus Server::status() const {
  const Sharing::Summary library = sharing_.summary();
  wire::InstanceStatus status;
  status.name = instance_;
  status.version = version();
  static const std::string host = host_name();
  status.host = host;
  status.pid = getpid();
  status.is_stopping = stops_ > 0;
  status.started = started_;
  status.operations = Dispatch::operations();
  status.workers = work_.workers();
  status.queue_limit = work_.queue_limit();
  status.running = work_.running();
  status.queued = work_.queued();
  status.clients = static_cast<std::uint32_t>(replies_.clients());
  counters_.report(status);
  status.memory = memory();
  status.library_changes = library.changes;
  status.library_digest = library.digest;
  status.library_conflicts = library.conflicts;
  status.library_damage = library_.damage();
  status.log_level = log::level();
  return status;
}

void Server::announce() {
  wire::with_sample(status(), [this](const ridgeline_wire_Instance& sample) {
    dds::check(dds_write(announcer_.get(), &sample), "dds_write");
  });
}

void Server::stop() {
  ++stops_;
  dds_set_guardcondition(stop_.get(), true);
}

void Server::tick() {
  replies_.refresh();
  work_.tick();
  announce();
  if (Clock::now() < next_trim_) return;
  malloc_trim(0);
  next_trim_ = Clock::now() + trim_interval;
}

void Server::run() {
  announce();
  auto next_tick = Clock::now() + tick_interval;
  for (int stops = 0; stops == 0 || !work_.is_idle();) {
    const auto left = std::max<std::chrono::nanoseconds>(next_tick - Clock::now(), 0ns);
    dds::check(dds_waitset_wait(waitset_.get(), nullptr, 0, dds::duration(left)),
               "dds_waitset_wait");
    bool was_told = false;
    dds::check(dds_take_guardcondition(stop_.get(), &was_told), "dds_take_guardcondition");
    take_cancels();
    take_clients();
    look_for_namesake();
    if (stops_ > stops) {
      if (stops == 0) work_.close();
      stops = stops_;
      log::event(log::Level::Info, "stopping", {{"running", work_.running()}});
      if (stops > 1) work_.cancel_all();
      announce();
    }
    if (Clock::now() >= next_tick) {
      tick();
      next_tick = Clock::now() + tick_interval;
    }
  }
  // Announced all the while: an instance that is silent for its lease counts as lost.
  const auto drain_end = Clock::now() + drain_limit;
  bool is_drained = replies_.drain(tick_interval);
  while (!is_drained && Clock::now() < drain_end) {
    announce();
    is_drained = replies_.drain(tick_interval);
  }
  if (!is_drained) {
    log::event(log::Level::Warning, "undelivered",
               {{"message", "clients did not take their answers in time"}});
  }
  wire::with_sample(status(), [this](const ridgeline_wire_Instance& sample) {
    dds::check(dds_writedispose(announcer_.get(), &sample), "dds_writedispose");
  });
}

}  // namespace ridgeline::service
