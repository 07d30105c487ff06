#pragma once

#include <atomic>
#include <stop_token>
#include <thread>

namespace ridgeline::command {

/// Turns SIGINT and SIGTERM into a stop request. Made before any other thread, so that all threads
/// leave the signals to it. A second signal ends the program at once with status 130.
class Interrupt {
public:
  Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  ~Interrupt();

  std::stop_token token() const { return source_.get_token(); }
  bool is_interrupted() const { return source_.stop_requested(); }

private:
  std::stop_source source_;
  std::atomic<bool> done_ = false;
  std::thread waiter_;
};

}  // namespace ridgeline::command
