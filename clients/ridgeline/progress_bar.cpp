#include "clients/ridgeline/progress_bar.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace ridgeline::command {
namespace {

constexpr auto patience = std::chrono::seconds(1);
constexpr auto refresh = std::chrono::milliseconds(100);
constexpr double width = 40;

}  // namespace

ProgressBar::ProgressBar(Mode mode)
    : enabled_(mode == Mode::Automatic && ::isatty(STDERR_FILENO) == 1),
      next_(Clock::now() + patience) {}

ProgressBar::~ProgressBar() {
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
}

void ProgressBar::show(double fraction, std::string_view stage) {
  if (!enabled_) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + refresh;
  drawn_ = true;
  const double part = std::clamp(fraction, 0.0, 1.0);
  fmt::print(stderr, "\r[{:<{}}] {:3.0f} %  {:.30}\x1b[K",
             std::string(static_cast<std::size_t>(part * width), '#'), static_cast<int>(width),
             100 * part, stage);
  std::fflush(stderr);
}

}  // namespace ridgeline::command
