#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <map>
#include <memory>

#include "clients/client.hpp"
#include "clients/ridgeline/subcommand.hpp"

namespace ridgeline::command {
namespace {

using Clock = std::chrono::steady_clock;
using wire::InstanceStatus;

struct Arguments {
  double interval = 1;  ///< [s]
  bool is_once = false;
};

/// Requests a second of each instance, from one look to the next.
class Rates {
public:
  std::optional<double> rate(const InstanceStatus& s, Clock::time_point now) {
    Seen& seen = seen_[s.name];
    const bool is_same_run = seen.started == s.started && s.requests >= seen.requests;
    const double seconds = std::chrono::duration<double>(now - seen.at).count();
    std::optional<double> rate;
    if (is_same_run) rate = static_cast<double>(s.requests - seen.requests) / seconds;
    seen = {s.started, s.requests, now};
    return rate;
  }

private:
  struct Seen {
    std::int64_t started = 0;
    std::uint64_t requests = 0;
    Clock::time_point at;
  };
  std::map<std::string, Seen> seen_;
};

std::string rate_text(const std::optional<double>& rate) {
  return rate ? fmt::format("{:.1f}", *rate) : std::string("-");
}

std::uint64_t refused(const InstanceStatus& s) {
  std::uint64_t count = 0;
  for (const auto& [code, answers] : s.answers) count += code == "ok" ? 0 : answers;
  return count;
}

constexpr double per_megabyte = 1e-6;
constexpr double per_millisecond = 1e3;

/// How much of the workers is in use, e.g. "[##--]".
std::string load_bar(const InstanceStatus& s) {
  constexpr std::uint32_t longest = 16;
  const std::uint32_t cells = std::clamp(s.workers, 1U, longest);
  const std::uint32_t full = std::min(s.running * cells / std::max(s.workers, 1U), cells);
  return "[" + std::string(full, '#') + std::string(cells - full, '-') + "]";
}

std::string table_row(const InstanceStatus& s, const std::optional<double>& rate) {
  return fmt::format(
      "{:<20.20} {:>3} of {:<3} {:>4} of {:<5} {:>10} {:>8} {:>7} {:>8.2f} {:>8.2f} "
      "{:>7.0f} {:>8}  {}{}\n",
      s.name, s.running, s.workers, s.queued, s.queue_limit, s.requests, rate_text(rate),
      refused(s), s.latency_p50 * per_millisecond, s.latency_p99 * per_millisecond,
      static_cast<double>(s.memory) * per_megabyte, s.library_changes, load_bar(s),
      s.is_stopping ? " stopping" : "");
}

std::string table_head() {
  return fmt::format("{:<20} {:^10} {:^13} {:>10} {:>8} {:>7} {:>8} {:>8} {:>7} {:>8}  load\n",
                     "instance", "running", "queued", "requests", "per s", "refused", "p50 [ms]",
                     "p99 [ms]", "MB", "library");
}

std::string line_of(const InstanceStatus& s, const std::optional<double>& rate) {
  const auto now =
      std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format(
      "{:%Y-%m-%dT%H:%M:%SZ} instance={} running={}/{} queued={}/{} clients={} requests={} "
      "per_second={} refused={} p50_ms={:.2f} p99_ms={:.2f} memory_mb={:.0f} library={}\n",
      fmt::gmtime(std::chrono::system_clock::to_time_t(now)), s.name, s.running, s.workers,
      s.queued, s.queue_limit, s.clients, s.requests, rate_text(rate), refused(s),
      s.latency_p50 * per_millisecond, s.latency_p99 * per_millisecond,
      static_cast<double>(s.memory) * per_megabyte, s.library_changes);
}

/// Draws over what it drew before where the output is a terminal, else adds lines.
class Screen {
public:
  explicit Screen(bool is_in_place) : is_in_place_(is_in_place) {}

  void show(const std::vector<InstanceStatus>& statuses) {
    const Clock::time_point now = Clock::now();
    std::string text = is_in_place_ ? table_head() : std::string();
    for (const InstanceStatus& status : statuses) {
      const std::optional<double> rate = rates_.rate(status, now);
      text += is_in_place_ ? table_row(status, rate) : line_of(status, rate);
    }
    put(text);
  }
  void show(const std::string& message) { put(message + "\n"); }

  /// A closed pipe: nobody looks any more.
  bool is_closed() const { return std::ferror(stdout) != 0; }

private:
  void put(const std::string& text) {
    if (is_in_place_ && drawn_ > 0) fmt::print("\x1b[{}A\x1b[J", drawn_);
    fmt::print("{}", text);
    std::fflush(stdout);
    drawn_ = std::ranges::count(text, '\n');
  }

  bool is_in_place_;
  std::ptrdiff_t drawn_ = 0;
  Rates rates_;
};

void wait(const std::stop_token& stop, double seconds) {
  std::mutex mutex;
  std::condition_variable_any never;
  std::unique_lock lock(mutex);  // cppcheck-suppress localMutex; only because a wait takes one
  never.wait_for(lock, stop, std::chrono::duration<double>(seconds), [] { return false; });
}

Outcome run(const Session& session, const Arguments& arguments) {
  Screen screen(!arguments.is_once && ::isatty(STDOUT_FILENO) == 1);
  while (!session.interrupt().is_interrupted() && !screen.is_closed()) {
    try {
      screen.show(session.status());
    } catch (const Error& error) {
      if (arguments.is_once) return outcome_of(jobs::refusal(error), "json");
      screen.show(error.what());
    }
    if (arguments.is_once) return {};
    wait(session.interrupt().token(), arguments.interval);
  }
  return {
      session.interrupt().is_interrupted() ? ExitStatus::Interrupted : ExitStatus::Usage, {}, {}};
}

}  // namespace

void add_watch_command(CLI::App& app, Selected& selected) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command = add_bare_subcommand(app, selected, arguments, "watch",
                                          "Instances of the service, updated as they work", run);
  command.add_flag("--once", arguments->is_once, "One line for each instance, and end");
  command.add_option("--interval", arguments->interval, "Seconds from one look to the next")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command.footer(
      "On a terminal a table that is drawn in place, elsewhere one line for each instance and "
      "look.\n"
      "Runs until it is interrupted; with --once exit status 3 when no instance answers.");
}

}  // namespace ridgeline::command
