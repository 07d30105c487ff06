#include "service/replies.hpp"

#include <algorithm>

#include "service/log.hpp"

namespace ridgeline::service {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t max_clients = 4096;
constexpr auto idle_limit = 5s;       // a partition without a reader is closed after that
constexpr auto retry_interval = 1ms;  // a client that cannot take more is asked again after that

}  // namespace

/// One client's partition.
struct Replies::Link {
  Link(const dds::Entity& participant, const dds::Entity& reply_topic,
       const dds::Entity& progress_topic, const std::string& client) {
    const dds::Qos partition(dds_create_qos());
    dds::set_partition(partition, dds::client_partition(client));
    publisher = {dds_create_publisher(participant.get(), partition.get(), nullptr),
                 "dds_create_publisher"};
    replies = {dds_create_writer(publisher.get(), reply_topic.get(),
                                 dds::qos(dds::Topic::Reply).get(), nullptr),
               "dds_create_writer"};
    progress = {dds_create_writer(publisher.get(), progress_topic.get(),
                                  dds::qos(dds::Topic::Progress).get(), nullptr),
                "dds_create_writer"};
    last_use = Clock::now();
  }

  bool has(const wire::Participant& participant) const {
    return std::ranges::find(participants, participant) != participants.end();
  }

  void refresh() {
    participants.clear();
    for (const dds_guid_t& guid : dds::matched_readers(replies)) {
      participants.push_back(wire::participant_of(guid.v));
    }
    if (!participants.empty() || !queue.empty()) last_use = Clock::now();
  }

  std::mutex mutex;  ///< all that follows
  dds::Entity publisher, replies, progress;
  std::vector<wire::Participant> participants;  ///< whose readers were matched at the last look
  std::deque<Outgoing> queue;
  Clock::time_point last_use;
  bool is_closed = false;  ///< no longer in the map: ask for the client's link again
};

Replies::Replies(const dds::Entity& participant, std::string instance)
    : participant_(participant),
      instance_(std::move(instance)),
      reply_topic_(dds::create_topic(participant, dds::Topic::Reply)),
      progress_topic_(dds::create_topic(participant, dds::Topic::Progress)),
      sender_([this] { run(); }) {}

Replies::~Replies() {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  sender_.join();
}

std::shared_ptr<Replies::Link> Replies::find(const std::string& client) const {
  const std::scoped_lock lock(mutex_);
  const auto found = links_.find(client);
  return found == links_.end() ? nullptr : found->second;
}

std::shared_ptr<Replies::Link> Replies::link(const std::string& client) {
  const std::scoped_lock lock(mutex_);
  std::shared_ptr<Link>& link = links_[client];
  if (!link) {
    try {
      if (links_.size() > max_clients) throw dds::Failure("clients", DDS_RETCODE_OUT_OF_RESOURCES);
      link = std::make_shared<Link>(participant_, reply_topic_, progress_topic_, client);
    } catch (...) {
      links_.erase(client);
      throw;
    }
  }
  return link;
}

void Replies::open(const std::string& client) {
  link(client);
}

Replies::Step Replies::advance(Link& link, Outgoing& outgoing) {
  const wire::Participant participant = wire::participant_of(outgoing.id);
  if (!link.has(participant)) link.refresh();
  if (!link.has(participant)) return Clock::now() < outgoing.give_up ? Step::Waits : Step::GaveUp;
  dds_return_t result = DDS_RETCODE_OK;
  outgoing.chunks->with_sample(
      outgoing.next_chunk, outgoing.id, instance_,
      [&](const ridgeline_wire_Reply& sample) { result = dds_write(link.replies.get(), &sample); });
  if (result == DDS_RETCODE_TIMEOUT) return Step::Waits;
  dds::check(result, "dds_write");
  link.last_use = Clock::now();
  return ++outgoing.next_chunk == outgoing.chunks->count() ? Step::Finished : Step::Advanced;
}

void Replies::notify() {
  { const std::scoped_lock lock(mutex_); }  // the sender is not between looking and waiting
  wake_.notify_all();
}

/// Queues the answer, or with `at_once` sends it when nothing is before it.
void Replies::hand_over(Outgoing outgoing, bool at_once) {
  std::optional<Delivery> delivery;
  try {
    for (;;) {
      const std::shared_ptr<Link> to = link(outgoing.client);
      const std::scoped_lock lock(to->mutex);
      if (to->is_closed) continue;
      if (at_once && to->queue.empty() && outgoing.chunks->count() == 1 &&
          advance(*to, outgoing) == Step::Finished) {
        delivery = Delivery::Sent;
      } else {
        to->queue.push_back(outgoing);
      }
      break;
    }
  } catch (const std::exception& error) {
    log::event(log::Level::Error, "send",
               {{"id", wire::text(outgoing.id)}, {"message", error.what()}});
    delivery = Delivery::Undelivered;
  }
  if (delivery) outgoing.done(*delivery);
}

void Replies::send(Outgoing outgoing) {
  hand_over(std::move(outgoing), true);
  notify();
}

void Replies::post(Outgoing outgoing) {
  {
    const std::scoped_lock lock(mutex_);
    inbox_.push_back(std::move(outgoing));
  }
  wake_.notify_all();
}

/// One step for each answer of a client. Did any advance?
bool Replies::turn(Link& link) {
  std::vector<std::pair<Outgoing, Delivery>> over;
  bool has_advanced = false;
  {
    const std::scoped_lock lock(link.mutex);
    for (std::size_t left = link.queue.size(); left > 0; --left) {
      Outgoing outgoing = std::move(link.queue.front());
      link.queue.pop_front();
      Step step = Step::GaveUp;
      try {
        step = advance(link, outgoing);
      } catch (const std::exception& error) {
        log::event(log::Level::Error, "send",
                   {{"id", wire::text(outgoing.id)}, {"message", error.what()}});
      }
      has_advanced = has_advanced || step != Step::Waits;
      if (step == Step::Waits || step == Step::Advanced) {
        link.queue.push_back(std::move(outgoing));
      } else {
        over.emplace_back(std::move(outgoing),
                          step == Step::Finished ? Delivery::Sent : Delivery::Undelivered);
      }
    }
  }
  for (auto& [outgoing, delivery] : over) outgoing.done(delivery);
  return has_advanced;
}

bool Replies::turn_all() {
  std::vector<std::shared_ptr<Link>> links;
  std::deque<Outgoing> inbox;
  {
    const std::scoped_lock lock(mutex_);
    for (const auto& [client, link] : links_) links.push_back(link);
    inbox.swap(inbox_);
  }
  bool has_advanced = !inbox.empty();
  for (Outgoing& outgoing : inbox) hand_over(std::move(outgoing), false);
  for (const std::shared_ptr<Link>& link : links) has_advanced = turn(*link) || has_advanced;
  return has_advanced;
}

void Replies::run() {
  const auto is_idle = [this] {
    for (const auto& [client, link] : links_) {
      const std::scoped_lock lock(link->mutex);
      if (!link->queue.empty()) return false;
    }
    return inbox_.empty();
  };
  for (;;) {
    if (turn_all()) continue;
    std::unique_lock lock(mutex_);
    if (stopping_) return;
    if (is_idle()) {
      wake_.wait(lock);
    } else {
      wake_.wait_for(lock, retry_interval);
    }
  }
}

void Replies::progress(const std::string& client, const ridgeline_wire_Progress& progress) {
  const std::shared_ptr<Link> to = find(client);
  if (!to) return;  // nobody who could read it
  const dds_return_t result = dds_write(to->progress.get(), &progress);
  if (result != DDS_RETCODE_TIMEOUT) dds::check(result, "dds_write");
}

bool Replies::reaches(const std::string& client, const wire::Participant& participant) const {
  const std::shared_ptr<Link> to = find(client);
  if (!to) return false;
  const std::scoped_lock lock(to->mutex);
  return to->has(participant);
}

void Replies::refresh() {
  std::vector<std::pair<std::string, std::shared_ptr<Link>>> links;
  {
    const std::scoped_lock lock(mutex_);
    links.assign(links_.begin(), links_.end());
  }
  for (const auto& [client, link] : links) {
    const std::scoped_lock order(mutex_, link->mutex);
    link->refresh();
    if (!link->queue.empty() || Clock::now() - link->last_use < idle_limit) continue;
    link->is_closed = true;
    links_.erase(client);
  }
}

bool Replies::drain(std::chrono::milliseconds limit) {
  const auto end = Clock::now() + limit;
  std::vector<std::shared_ptr<Link>> links;
  for (;;) {
    {
      const std::scoped_lock lock(mutex_);
      links.clear();
      bool is_empty = inbox_.empty();
      for (const auto& [client, link] : links_) {
        const std::scoped_lock order(link->mutex);
        is_empty = is_empty && link->queue.empty();
        links.push_back(link);
      }
      if (is_empty) break;
    }
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(retry_interval);
  }
  for (const std::shared_ptr<Link>& link : links) {
    const auto left = std::max<std::chrono::nanoseconds>(end - Clock::now(), 0ns);
    if (dds_wait_for_acks(link->replies.get(), dds::duration(left)) != DDS_RETCODE_OK) return false;
  }
  return true;
}

std::size_t Replies::clients() const {
  const std::scoped_lock lock(mutex_);
  return links_.size();
}

}  // namespace ridgeline::service
