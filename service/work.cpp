#include "service/work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "jobs/text.hpp"
#include "service/log.hpp"

namespace ridgeline::service {
namespace {

using namespace std::chrono_literals;

constexpr auto reach_limit = 3s;  // a client may be unreachable for that long
constexpr auto progress_interval = 250ms;
constexpr std::size_t max_cancelled = 1024;

double seconds(Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

/// One request that is known. Under the mutex of Work, but for what `progress_mutex` guards.
struct Work::Task {
  wire::Request request;  ///< its text is given up with the answer, the rest never changes
  Channel channel = Channel::Compute;
  State state = State::Queued;
  End end = End::None;
  Clock::time_point taken, started, answered, deadline, last_reached, last_progress;
  std::stop_source stop;
  std::shared_ptr<const wire::Chunks> chunks;
  std::string operation;

  std::mutex progress_mutex;
  double fraction = 0;
  std::string stage;
};

Work::Work(const Limits& limits, Run run, Replies& replies, Counters& counters)
    : limits_(limits), run_(std::move(run)), replies_(replies), counters_(counters) {
  for (unsigned i = 0; i < limits_.workers; ++i) threads_.emplace_back([this] { work(); });
}

Work::~Work() {
  {
    const std::scoped_lock lock(mutex_);
    is_stopping_ = true;
    for (const TaskPointer& task : running_) task->stop.request_stop();
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Work::take(wire::Request request, Channel channel, std::chrono::nanoseconds age) {
  counters_.taken();
  const std::scoped_lock lock(mutex_);
  if (const auto found = known_.find(request.id); found != known_.end()) {
    counters_.duplicate();
    const TaskPointer& task = found->second;
    log::event(log::Level::Debug, "duplicate", {{"id", wire::text(request.id)}});
    if (task->state == State::Answered) replies_.post(outgoing(task));
    return;
  }
  if (const auto found = std::ranges::find(cancelled_, request.id); found != cancelled_.end()) {
    cancelled_.erase(found);
    return refuse(request, {ErrorCode::Cancelled, "cancelled by the requester"});
  }
  const auto timeout = std::chrono::duration<double>(request.unusable ? 1 : request.timeout);
  if (age > timeout) {
    return refuse(
        request,
        {ErrorCode::Timeout,
         fmt::format("the request was sent {:.3g} s ago and its client waits {:.3g} s; if it was "
                     "not, the clocks of the two machines differ",
                     std::chrono::duration<double>(age).count(), timeout.count())});
  }
  if (is_closed_) return refuse(request, {ErrorCode::Busy, "the instance is stopping"});
  if (queued_ >= limits_.queue || queued_bytes_ + request.text.size() > limits_.queue_bytes) {
    return refuse(
        request,
        {ErrorCode::Busy,
         fmt::format("{} requests wait already", queued_),
         {.field = "",
          .value = std::to_string(queued_),
          .limit = fmt::format("{} requests, {} bytes", limits_.queue, limits_.queue_bytes),
          .parameter = {},
          .target = {}}});
  }

  auto task = std::make_shared<Task>();
  task->channel = channel;
  task->taken = task->last_reached = Clock::now();
  task->deadline = task->taken + std::chrono::duration_cast<Clock::duration>(timeout);
  task->request = std::move(request);
  known_.emplace(task->request.id, task);
  ++queued_;
  queued_bytes_ += task->request.text.size();
  std::deque<TaskPointer>& queue = waiting_[task->request.client];
  if (queue.empty()) turns_.push_back(task->request.client);
  queue.push_back(std::move(task));
  wake_.notify_one();
}

/// Answers without computing. The refusal is not remembered: asked again, it may be otherwise.
void Work::refuse(const wire::Request& request, const Error& error) {
  auto task = std::make_shared<Task>();
  task->taken = task->started = task->answered = Clock::now();
  task->request.id = request.id;
  task->request.client = request.client;
  task->request.format = request.format;
  task->chunks = std::make_shared<wire::Chunks>(jobs::refusal(error), ++answer_number_);
  replies_.post(outgoing(task));
}

Outgoing Work::outgoing(const TaskPointer& task) {
  return {.id = task->request.id,
          .client = task->request.client,
          .chunks = task->chunks,
          .give_up = Clock::now() + reach_limit,
          .done = [this, task](Delivery delivery) { log_answer(*task, delivery); }};
}

Work::TaskPointer Work::next() {
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [this] { return is_stopping_ || !turns_.empty(); });
  if (is_stopping_) return {};
  const std::string client = std::move(turns_.front());
  turns_.pop_front();
  const auto queue = waiting_.find(client);
  TaskPointer task = std::move(queue->second.front());
  queue->second.pop_front();
  if (queue->second.empty()) {
    waiting_.erase(queue);
  } else {
    turns_.push_back(client);
  }
  --queued_;
  queued_bytes_ -= task->request.text.size();
  task->state = State::Running;
  task->started = task->last_progress = Clock::now();
  running_.push_back(task);
  return task;
}

void Work::work() {
  while (const TaskPointer task = next()) compute(task);
}

Work::Ran Work::run(const Task& task, const Progress& progress) const noexcept {
  try {
    return run_(task.request, task.channel, progress);
  } catch (const Error& error) {
    return {jobs::refusal(error), {}};
  } catch (const std::exception& error) {
    return {jobs::refusal({ErrorCode::Internal, error.what()}), {}};
  }
}

void Work::compute(const TaskPointer& task) {
  const Progress progress{.report =
                              [&task](double fraction, std::string_view stage) {
                                const std::scoped_lock lock(task->progress_mutex);
                                task->fraction = fraction;
                                task->stage = stage;
                              },
                          .stop = task->stop.get_token()};
  Ran ran = run(*task, progress);
  // Nobody waits for it any more: no answer is packed. A change that was made is told all the same.
  if (task->stop.stop_requested() && task->channel != Channel::Change) {
    const Error why = [&] {
      const std::scoped_lock lock(mutex_);
      return reason_of(task->end);
    }();
    ran.answer = jobs::refusal(why);
  }
  const auto chunks = [&]() -> std::shared_ptr<const wire::Chunks> {
    const std::uint64_t number = ++answer_number_;
    try {
      return std::make_shared<wire::Chunks>(std::move(ran.answer), number);
    } catch (const std::exception& error) {  // no memory for so large an answer
      return std::make_shared<wire::Chunks>(jobs::refusal({ErrorCode::Internal, error.what()}),
                                            number);
    }
  }();
  {
    const std::scoped_lock lock(mutex_);
    std::erase(running_, task);
    task->answered = Clock::now();
    task->state = State::Answered;
    task->chunks = chunks;
    task->operation = std::move(ran.operation);
    std::string().swap(task->request.text);  // `= {}` would keep its memory
    remember(task);
  }
  replies_.send(outgoing(task));
}

/// Keeps the answer for duplicates, within the limits.
void Work::remember(const TaskPointer& task) {
  if (task->end != End::None) {  // asked again, it is computed again
    known_.erase(task->request.id);
    return;
  }
  answered_.push_back(task);
  answered_bytes_ += task->chunks->bytes();
  while (answered_bytes_ > limits_.answer_bytes || answered_.size() > limits_.answers) {
    known_.erase(answered_.front()->request.id);
    answered_bytes_ -= answered_.front()->chunks->bytes();
    answered_.pop_front();
  }
}

void Work::cancel(const wire::RequestId& id) {
  const std::scoped_lock lock(mutex_);
  const auto found = known_.find(id);
  if (found == known_.end()) {
    cancelled_.push_back(id);
    if (cancelled_.size() > max_cancelled) cancelled_.pop_front();
  } else if (found->second->state != State::Answered) {
    end(TaskPointer(found->second), End::Cancelled);
  }
}

Error Work::reason_of(End end) {
  return end == End::Expired
             ? Error(ErrorCode::Timeout, "the time that the client set was over before the answer")
             : Error(ErrorCode::Cancelled, "cancelled by the requester");
}

/// A waiting task is answered at once, a running one when it sees the stop. The mutex is held.
void Work::end(const TaskPointer& task, End reason) {
  task->end = reason;
  task->stop.request_stop();
  if (task->state != State::Queued) return;
  const auto queue = waiting_.find(task->request.client);
  std::erase(queue->second, task);
  if (queue->second.empty()) {
    std::erase(turns_, queue->first);
    waiting_.erase(queue);
  }
  --queued_;
  queued_bytes_ -= task->request.text.size();
  known_.erase(task->request.id);
  refuse(task->request, reason_of(reason));
}

void Work::publish_progress(Task& task, Clock::time_point now) {
  if (now - task.last_progress < progress_interval) return;
  task.last_progress = now;
  ridgeline_wire_Progress sample{};
  sample.requestId = wire::identity(task.request.id);
  {
    const std::scoped_lock lock(task.progress_mutex);
    sample.fraction = task.fraction;
    wire::copy(jobs::shortened(task.stage, sizeof sample.stage - 1), sample.stage);
  }
  const double elapsed = seconds(now - task.started);
  sample.remaining =
      sample.fraction > 0.01 ? elapsed * (1 - sample.fraction) / sample.fraction : -1;
  replies_.progress(task.request.client, sample);
}

void Work::tick() {
  const auto now = Clock::now();
  std::vector<TaskPointer> tasks, running;
  {
    const std::scoped_lock lock(mutex_);
    tasks = running = running_;
    for (const auto& [client, queue] : waiting_) {
      tasks.insert(tasks.end(), queue.begin(), queue.end());
    }
  }
  for (const TaskPointer& task : tasks) {  // what these read never changes while they are known
    if (replies_.reaches(task->request.client, wire::participant_of(task->request.id))) {
      task->last_reached = now;
    }
  }
  for (const TaskPointer& task : running) publish_progress(*task, now);
  const std::scoped_lock lock(mutex_);
  for (const TaskPointer& task : tasks) {
    if (task->end != End::None || task->state == State::Answered) continue;
    if (now > task->deadline) {
      end(task, End::Expired);
    } else if (now - task->last_reached > reach_limit) {
      end(task, End::Abandoned);
    }
  }
}

void Work::close() {
  const std::scoped_lock lock(mutex_);
  is_closed_ = true;
  for (auto& [client, queue] : waiting_) {
    for (const TaskPointer& task : queue) {
      known_.erase(task->request.id);
      refuse(task->request, {ErrorCode::Busy, "the instance is stopping"});
    }
  }
  waiting_.clear();
  turns_.clear();
  queued_ = queued_bytes_ = 0;
}

void Work::cancel_all() {
  const std::scoped_lock lock(mutex_);
  for (const TaskPointer& task : std::vector(running_)) end(task, End::Cancelled);
}

bool Work::is_idle() const {
  const std::scoped_lock lock(mutex_);
  return running_.empty() && queued_ == 0;
}

std::uint32_t Work::running() const {
  const std::scoped_lock lock(mutex_);
  return static_cast<std::uint32_t>(running_.size());
}

std::uint32_t Work::queued() const {
  const std::scoped_lock lock(mutex_);
  return static_cast<std::uint32_t>(queued_);
}

void Work::log_answer(const Task& task, Delivery delivery) {
  const auto now = Clock::now();
  if (delivery == Delivery::Undelivered) counters_.undelivered();
  counters_.answered(task.chunks->code(), seconds(now - task.taken), task.chunks->bytes());
  if (!log::is_on(log::Level::Info)) return;
  const auto milliseconds = [](Clock::duration duration) {
    return std::round(seconds(duration) * 1e6) / 1e3;
  };
  log::event(log::Level::Info, "request",
             {{"id", wire::text(task.request.id)},
              {"client", task.request.client},
              {"operation", task.operation},
              {"format", task.request.format},
              {"code", task.chunks->code()},
              {"delivery", delivery == Delivery::Sent ? "sent" : "undelivered"},
              {"queue_ms", milliseconds(task.started - task.taken)},
              {"compute_ms", milliseconds(task.answered - task.started)},
              {"send_ms", milliseconds(now - task.answered)},
              {"bytes", task.chunks->bytes()},
              {"chunks", task.chunks->count()}});
}

}  // namespace ridgeline::service
