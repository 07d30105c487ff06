#pragma once

#include <chrono>
#include <mutex>
#include <string_view>

namespace ridgeline::command {

/// A line on standard error that shows how far a job is, once it has taken a second; nothing when
/// standard error is no terminal. May be told from any thread.
class ProgressBar {
public:
  enum class Mode { Automatic, Off };
  explicit ProgressBar(Mode mode);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  void show(double fraction, std::string_view stage);

private:
  using Clock = std::chrono::steady_clock;
  std::mutex mutex_;
  bool enabled_;
  bool drawn_ = false;
  Clock::time_point next_;
};

}  // namespace ridgeline::command
