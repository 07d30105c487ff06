#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "core/base/progress.hpp"
#include "jobs/answer.hpp"
#include "service/counters.hpp"
#include "service/replies.hpp"

namespace ridgeline::service {

/// The topic that a request came by: what changes the library or the service comes by its own, so
/// that access control can tell who may.
enum class Channel { Compute, Change };

/// Requests from their arrival to their answer: a queue with a turn for each client, threads that
/// compute, and what is known of each request, so that one that comes twice is computed once.
class Work {
public:
  struct Limits {
    unsigned workers = 2;
    std::size_t queue = 256;              ///< requests that wait
    std::size_t queue_bytes = 256 << 20;  ///< of their texts
    std::size_t answer_bytes = 64 << 20;  ///< kept to answer duplicates
    std::size_t answers = 4096;
  };
  /// An answer, and what the log calls the request.
  struct Ran {
    jobs::Answer answer;
    std::string operation;
  };
  using Run = std::function<Ran(const wire::Request&, Channel, const Progress&)>;

  /// `run` answers one request; called from the workers.
  Work(const Limits& limits, Run run, Replies& replies, Counters& counters);
  ~Work();
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  /// Takes a request, known or new; `age`: how long it has been under way. Called from a listener.
  void take(wire::Request request, Channel channel, std::chrono::nanoseconds age);
  /// Also of a request that has not come yet.
  void cancel(const wire::RequestId& id);
  /// Ends what nobody waits for any more, publishes progress. Call it ten times a second.
  void tick();
  /// Refuses what has not begun and all that comes. Returns at once.
  void close();
  void cancel_all();
  bool is_idle() const;

  std::uint32_t running() const;
  std::uint32_t queued() const;
  std::uint32_t workers() const { return limits_.workers; }
  std::uint32_t queue_limit() const { return static_cast<std::uint32_t>(limits_.queue); }

private:
  enum class State { Queued, Running, Answered };
  enum class End { None, Cancelled, Expired, Abandoned };
  struct Task;
  using TaskPointer = std::shared_ptr<Task>;

  void work();
  TaskPointer next();
  void compute(const TaskPointer& task);
  Ran run(const Task& task, const Progress& progress) const noexcept;
  static Error reason_of(End end);
  void end(const TaskPointer& task, End reason);
  void refuse(const wire::Request& request, const Error& error);
  void remember(const TaskPointer& task);
  Outgoing outgoing(const TaskPointer& task);
  void log_answer(const Task& task, Delivery delivery);
  void publish_progress(Task& task, Clock::time_point now);

  Limits limits_;
  Run run_;
  Replies& replies_;
  Counters& counters_;

  mutable std::mutex mutex_;  ///< all that follows, and the tasks
  std::condition_variable wake_;
  std::unordered_map<wire::RequestId, TaskPointer, wire::RequestIdHash> known_;
  std::map<std::string, std::deque<TaskPointer>> waiting_;  ///< by client
  std::deque<std::string> turns_;                           ///< clients with waiting requests
  std::deque<TaskPointer> answered_;                        ///< oldest first
  std::deque<wire::RequestId> cancelled_;                   ///< came before their request
  std::vector<TaskPointer> running_;
  std::size_t queued_ = 0, queued_bytes_ = 0, answered_bytes_ = 0;
  std::atomic<std::uint64_t> answer_number_ = 0;
  bool is_closed_ = false;
  bool is_stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace ridgeline::service
