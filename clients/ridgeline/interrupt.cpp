#include "clients/ridgeline/interrupt.hpp"

#include <pthread.h>
#include <unistd.h>

#include <csignal>

#include "clients/ridgeline/outcome.hpp"

namespace ridgeline::command {
namespace {

sigset_t interrupting_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

Interrupt::Interrupt() {
  const sigset_t set = interrupting_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  waiter_ = std::thread([this, set] {
    for (;;) {
      int received = 0;
      sigwait(&set, &received);
      if (done_) return;
      if (source_.stop_requested()) ::_exit(static_cast<int>(ExitStatus::Interrupted));
      source_.request_stop();
    }
  });
}

Interrupt::~Interrupt() {
  done_ = true;
  // Blocked in every thread: only wakes sigwait. NOLINTNEXTLINE(bugprone-bad-signal-to-kill-thread)
  pthread_kill(waiter_.native_handle(), SIGTERM);
  waiter_.join();
}

}  // namespace ridgeline::command
