#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "clients/session.hpp"

namespace ridgeline::client {
namespace {

using namespace std::chrono_literals;

constexpr auto match_interval = 1ms;   // how often an unmatched way is looked at
constexpr auto busy_interval = 100ms;  // an instance whose queue was full is left alone so long
constexpr auto first_repeat = 5s;      // a request that nothing is heard of is sent again, then
                                       // after twice as long, and so on
constexpr auto cancel_patience = 500ms;

double seconds(std::chrono::milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

bool Client::Session::has_live() const {
  return std::ranges::any_of(instances_, [this](const auto& each) {
    return !each.second->status.is_stopping &&
           (options_.instance.empty() || options_.instance == each.first);
  });
}

/// The ready instance with the least to do for each of its workers.
std::shared_ptr<Instance> Client::Session::least_loaded(Lock& lock, Channel channel) {
  struct Candidate {
    double load;
    std::uint64_t sent;
    std::shared_ptr<Instance> instance;
    bool operator<(const Candidate& other) const {
      return std::tie(load, sent) < std::tie(other.load, other.sent);
    }
  };
  std::vector<Candidate> candidates;
  for (const auto& [name, instance] : instances_) {
    if (!options_.instance.empty() && options_.instance != name) continue;
    if (instance->status.is_stopping || Clock::now() < instance->busy_until) continue;
    const auto told = static_cast<int>(instance->status.running + instance->status.queued);
    candidates.push_back({std::max(told, instance->outstanding) / double(instance->status.workers),
                          instance->sent, instance});
  }
  std::ranges::sort(candidates, std::less<>());
  lock.unlock();
  const auto ready = std::ranges::find_if(candidates, [&](const Candidate& each) {
    return each.instance->is_ready(channel, reply_reader_);
  });
  lock.lock();
  return ready == candidates.end() ? nullptr : ready->instance;
}

void Client::Session::send(Lock& lock, Pending& pending, const std::shared_ptr<Instance>& to,
                           const Call& call, Channel channel, const std::string& format,
                           const Patience& patience) {
  if (pending.instance != to) {
    release(pending);
    pending.instance = to;
    ++to->outstanding;
    ++to->sent;
  }
  pending.heard = Clock::now();
  lock.unlock();
  const wire::Sent sent{pending.id, to->name, name_, format, seconds(patience.timeout)};
  const bool is_written = std::visit(
      [&](const auto& what) {
        if constexpr (std::is_same_v<std::decay_t<decltype(what)>, wire::Call>) {
          return to->write(channel, wire::borrow(sent, what), patience.timeout);
        } else {
          return to->write(channel, wire::borrow(sent, *what), patience.timeout);
        }
      },
      call);
  lock.lock();
  if (is_written) return;
  release(pending);  // it does not even take requests: another, or the same later
  to->busy_until = Clock::now() + busy_interval;
}

void Client::Session::release(Pending& pending) {
  if (pending.instance) --pending.instance->outstanding;
  pending.instance.reset();
}

/// What came, if anything did; a refusal for want of room is kept for the case that no other comes.
std::optional<jobs::Answer> Client::Session::taken(Lock& lock, Pending& pending) {
  if (pending.broken) return jobs::refusal(*pending.broken);
  if (!pending.complete) return {};
  wire::Assembler complete = std::move(*pending.complete);
  pending.complete.reset();
  lock.unlock();
  jobs::Answer answer = complete.finish();
  lock.lock();
  const bool is_busy =
      jobs::is_error(answer) && answer.document["error"].value("code", "") == name(ErrorCode::Busy);
  if (!is_busy) return answer;
  pending.busy = std::move(answer);
  if (pending.instance) pending.instance->busy_until = Clock::now() + busy_interval;
  release(pending);
  return {};
}

Error Client::Session::absent(const Pending& pending) const {
  const std::string whom =
      options_.instance.empty() ? "no instance of the service" : "no instance " + options_.instance;
  const std::string where = " answers in DDS domain " + std::to_string(options_.domain);
  const auto waited = has_seen_any_ ? options_.absence : options_.discovery;
  const std::string lost =
      pending.heard == Clock::time_point{}
          ? ""
          : "; the one that had request " + wire::text(pending.id) + " was lost";
  return {ErrorCode::NoService,
          whom + where + lost,
          {.field = "",
           .value = fmt::format("none for {:.3g} s", seconds(waited)),
           .limit = "at least one",
           .parameter = {},
           .target = {}}};
}

jobs::Answer Client::Session::cancelled(Lock& lock, Pending& pending) {
  if (const auto instance = pending.instance) {
    lock.unlock();
    instance->cancel(pending.id);
    lock.lock();
    pending.changed.wait_for(lock, cancel_patience, [&] {
      return pending.complete || pending.broken || !instance->is_alive;
    });
  }
  return jobs::refusal({ErrorCode::Cancelled, "cancelled by the requester"});
}

jobs::Answer Client::Session::wait(Lock& lock, Pending& pending, const Call& call, Channel channel,
                                   const std::string& format, const Patience& patience) {
  const Clock::time_point begin = Clock::now();
  const Clock::time_point deadline = begin + patience.timeout;
  last_live_ = std::max(last_live_, begin);
  Clock::duration repeat = first_repeat;
  for (;;) {
    if (auto answer = taken(lock, pending)) return *std::move(answer);
    if (auto progress = std::exchange(pending.progress, {}); progress && patience.progress) {
      lock.unlock();
      patience.progress(*progress);
      lock.lock();
      continue;
    }
    const auto now = Clock::now();
    if (patience.stop.stop_requested()) return cancelled(lock, pending);
    if (now >= deadline) break;
    if (has_live()) last_live_ = now;

    if (pending.instance && !pending.instance->is_alive) release(pending);
    const bool is_silent = pending.instance && now - pending.heard > repeat;
    if (is_silent) repeat *= 2;
    if (!pending.instance || is_silent) {
      const auto to = is_silent ? pending.instance : least_loaded(lock, channel);
      if (to) {
        send(lock, pending, to, call, channel, format, patience);
        continue;
      }
      const auto patience_without = has_seen_any_ ? options_.absence : options_.discovery;
      if (!has_live() && now - last_live_ > patience_without) break;  // one may just have come
      pending.changed.wait_until(lock, std::min(deadline, now + match_interval));
    } else {
      pending.changed.wait_until(lock, std::min(deadline, pending.heard + repeat));
    }
  }
  if (pending.busy) return *pending.busy;
  if (!has_live()) return jobs::refusal(absent(pending));
  return jobs::refusal(
      {ErrorCode::Timeout,
       fmt::format("no answer within {:.3g} s{} to request {}", seconds(patience.timeout),
                   pending.instance ? " from instance " + pending.instance->name : "",
                   wire::text(pending.id)),
       {.field = "",
        .value = fmt::format("{:.3g} s", seconds(patience.timeout)),
        .limit = "a timeout longer than the job takes",
        .parameter = {},
        .target = {}}});
}

jobs::Answer Client::Session::ask(const Call& call, Channel channel, const std::string& format,
                                  const Patience& patience) {
  const auto pending = std::make_shared<Pending>();
  const std::stop_callback stop(patience.stop, [this, &pending] {
    const std::scoped_lock lock(mutex_);
    pending->changed.notify_one();
  });
  Lock lock(mutex_);
  ++id_.number;
  pending->id = id_;
  pending_.emplace(pending->id, pending);
  lock.unlock();
  std::optional<jobs::Answer> answer;
  try {
    open();
    lock.lock();
    answer = wait(lock, *pending, call, channel, format, patience);
  } catch (const Error& error) {
    answer = jobs::refusal(error);
  } catch (const dds::Failure& failure) {
    const bool is_forbidden = failure.code() == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY;
    answer = jobs::refusal(
        {is_forbidden ? ErrorCode::Unsupported : ErrorCode::Internal,
         is_forbidden ? "the permissions of this client do not allow it" : failure.what()});
  } catch (const std::exception& error) {
    answer = jobs::refusal({ErrorCode::Internal, error.what()});
  }
  if (!lock.owns_lock()) lock.lock();
  release(*pending);
  pending_.erase(pending->id);
  lock.unlock();  // before `stop` waits for a call of it that waits for the lock
  return *std::move(answer);
}

}  // namespace ridgeline::client
