#include "clients/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace ridgeline::client {
namespace {

using namespace std::chrono_literals;

constexpr auto bury_interval = 1s;  // lost instances are cleared away so often
constexpr auto retry_interval = 1ms;
constexpr auto settle = 300ms;  // other instances announce themselves within that

std::string unique_name(const dds::Entity& participant) {
  dds_guid_t guid;
  dds::check(dds_get_guid(participant.get(), &guid), "dds_get_guid");
  std::string name;
  for (int i = 0; i < 12; ++i) name += fmt::format("{:02x}", guid.v[i]);
  return name;
}

/// Options, the environment, or what is unique.
std::string name_of(const Options& options, const dds::Entity& participant) {
  const char* variable = std::getenv("RIDGELINE_CLIENT");
  std::string name = options.name;
  if (name.empty() && variable != nullptr) name = variable;
  if (name.empty()) return unique_name(participant);
  if (dds::is_name(name)) return name;
  throw Error(ErrorCode::BadInput,
              "\"" + name + "\" is no client name: 1 to 64 of letters, digits, '_', '-', '.'");
}

dds::Entity subscriber(const dds::Entity& participant, const std::string& client) {
  const dds::Qos qos(dds_create_qos());
  dds::set_partition(qos, dds::client_partition(client));
  return {dds_create_subscriber(participant.get(), qos.get(), nullptr), "dds_create_subscriber"};
}

}  // namespace

Client::Session::Session(const Options& options)
    : options_(options),
      domain_(dds::Domain::open(options.domain)),
      participant_(domain_->participant()),
      name_(name_of(options, participant_)),
      last_live_(Clock::now()),
      instance_reader_(
          dds_create_reader(participant_.get(),
                            dds::create_topic(participant_, dds::Topic::Instance).get(),
                            dds::qos(dds::Topic::Instance).get(), nullptr),
          "dds_create_reader"),
      stop_(dds_create_guardcondition(participant_.get()), "dds_create_guardcondition"),
      waitset_(dds_create_waitset(participant_.get()), "dds_create_waitset") {
  dds::check(dds_set_status_mask(instance_reader_.get(), DDS_DATA_AVAILABLE_STATUS),
             "dds_set_status_mask");
  dds::check(dds_waitset_attach(waitset_.get(), instance_reader_.get(), 0), "dds_waitset_attach");
  dds::check(dds_waitset_attach(waitset_.get(), stop_.get(), 0), "dds_waitset_attach");
  dds_guid_t guid;
  dds::check(dds_get_guid(participant_.get(), &guid), "dds_get_guid");
  std::copy_n(guid.v, sizeof guid.v, id_.writer.begin());
  watcher_ = std::thread([this] { watch(); });
}

Client::Session::~Session() {
  dds_set_guardcondition(stop_.get(), true);
  watcher_.join();
  progress_reader_ = {};  // no listener runs any more when these are gone
  reply_reader_ = {};
}

/// Makes what replies come by, when it is first needed.
void Client::Session::open() {
  std::call_once(opened_, [this] {
    subscriber_ = subscriber(participant_, name_);
    reply_reader_ = reader(dds::Topic::Reply, &Session::on_replies);
    progress_reader_ = reader(dds::Topic::Progress, &Session::on_progress);
  });
}

dds::Entity Client::Session::reader(dds::Topic topic, dds_on_data_available_fn on_data) {
  const dds::Qos qos = dds::qos(topic);
  if (topic == dds::Topic::Reply)
    dds_qset_resource_limits(qos.get(), dds::reply_samples, DDS_LENGTH_UNLIMITED,
                             dds::reply_samples);
  const dds::Listener listener(dds_create_listener(this));
  dds_lset_data_available(listener.get(), on_data);
  return {dds_create_reader(subscriber_.get(), dds::create_topic(participant_, topic).get(),
                            qos.get(), listener.get()),
          "dds_create_reader"};
}

void Client::Session::on_replies(dds_entity_t reader, void* argument) noexcept {
  auto* session = static_cast<Session*>(argument);
  try {
    for (;;) {
      const dds::Taken<ridgeline_wire_Reply> samples(reader);
      if (samples.empty()) return;
      const std::scoped_lock lock(session->mutex_);
      samples.for_each([&](const ridgeline_wire_Reply& sample, const dds_sample_info_t& info) {
        if (info.valid_data) session->take_reply(sample, info);
      });
    }
  } catch (const std::exception&) {
    // The reader is being closed, or no memory: whoever waits hears nothing and names the timeout.
  }
}

void Client::Session::take_reply(const ridgeline_wire_Reply& sample,
                                 const dds_sample_info_t& info) {
  const auto found = pending_.find(wire::request_id(sample.header.relatedRequestId));
  if (found == pending_.end()) return;  // answered already, or of another client of our name
  Pending& pending = *found->second;
  pending.heard = Clock::now();
  if (pending.complete) return;
  const auto key = std::pair(info.publication_handle, sample.answer);
  try {
    if (!pending.answers[key].add(sample)) return;
    pending.complete = std::move(pending.answers[key]);
    pending.answers.clear();
  } catch (const Error& error) {
    pending.broken = error;
  }
  pending.changed.notify_one();
}

void Client::Session::on_progress(dds_entity_t reader, void* argument) noexcept {
  auto* session = static_cast<Session*>(argument);
  try {
    const dds::Taken<ridgeline_wire_Progress> samples(reader);
    const std::scoped_lock lock(session->mutex_);
    samples.for_each([&](const ridgeline_wire_Progress& sample, const dds_sample_info_t& info) {
      if (!info.valid_data) return;
      const auto found = session->pending_.find(wire::request_id(sample.requestId));
      if (found == session->pending_.end()) return;
      found->second->heard = Clock::now();
      found->second->progress = {
          sample.fraction, sample.remaining < 0 ? std::nullopt : std::optional(sample.remaining),
          sample.stage};
      found->second->changed.notify_one();
    });
  } catch (const std::exception&) {
    // As above; progress is for show.
  }
}

void Client::Session::take_instances() {
  const dds::Taken<ridgeline_wire_Instance, 64> samples(instance_reader_);
  samples.for_each([this](const ridgeline_wire_Instance& sample, const dds_sample_info_t& info) {
    const bool is_alive = info.instance_state == DDS_ALIVE_INSTANCE_STATE;
    if (is_alive && !info.valid_data) return;
    {
      const std::scoped_lock lock(mutex_);
      if (const auto found = instances_.find(sample.name); found != instances_.end()) {
        Instance& known = *found->second;
        if (is_alive && known.status.started == sample.started) {
          known.status = wire::instance_status(sample);
          return;
        }
        known.is_alive = false;  // gone, or another run under the same name
        gone_.push_back(std::move(found->second));
        instances_.erase(found);
      }
    }
    if (!is_alive) return;
    auto made = std::make_shared<Instance>(participant_, wire::instance_status(sample));
    const std::scoped_lock lock(mutex_);
    has_seen_any_ = true;
    instances_[made->status.name] = std::move(made);
  });
}

/// Deletes the entities of lost instances. Not under the mutex, which listeners wait for.
void Client::Session::bury() {
  std::vector<std::shared_ptr<Instance>> dead;
  const std::scoped_lock lock(mutex_);
  const auto unused = std::ranges::partition(
      gone_, [](const std::shared_ptr<Instance>& each) { return each.use_count() > 1; });
  dead.assign(unused.begin(), unused.end());
  gone_.erase(unused.begin(), unused.end());
}

void Client::Session::notify_all() {
  const std::scoped_lock lock(mutex_);
  found_.notify_all();
  for (const auto& [id, pending] : pending_) pending->changed.notify_one();
}

void Client::Session::watch() {
  for (;;) {
    try {
      dds::check(dds_waitset_wait(waitset_.get(), nullptr, 0, dds::duration(bury_interval)),
                 "dds_waitset_wait");
      bool is_stopped = false;
      dds::check(dds_read_guardcondition(stop_.get(), &is_stopped), "dds_read_guardcondition");
      if (is_stopped) return;
      take_instances();
      bury();
    } catch (const std::exception&) {
      std::this_thread::sleep_for(retry_interval);  // no resources: the next announcement comes
    }
    notify_all();
  }
}

std::vector<wire::InstanceStatus> Client::Session::status(std::chrono::milliseconds wait) {
  const auto end = Clock::now() + wait;
  Lock lock(mutex_);
  found_.wait_until(lock, end, [this] {
    return options_.instance.empty() ? !instances_.empty() : instances_.contains(options_.instance);
  });
  lock.unlock();
  std::this_thread::sleep_until(std::min<Clock::time_point>(end, Clock::now() + settle));
  lock.lock();
  std::vector<wire::InstanceStatus> result;
  for (const auto& [name, instance] : instances_)
    if (options_.instance.empty() || options_.instance == name) result.push_back(instance->status);
  return result;
}

}  // namespace ridgeline::client
