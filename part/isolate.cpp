#include "part/isolate.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <mutex>

#include "core/base/error.hpp"

namespace ridgeline::part {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int done = 0;
constexpr int out_of_memory = 3;
constexpr int failed = 4;

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorCode::BadFile, "the part file cannot be read: " + why,
              {.field = "/product_step"});
}

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;  // the other end is gone: nobody wants it any more
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// The child's own limits and signals: what the parent caught is not its business.
void prepare(const Limits& limits) {
  for (const int signal : {SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGILL})
    std::signal(signal, SIG_DFL);
  std::signal(SIGPIPE, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const auto seconds = static_cast<rlim_t>(limits.seconds) + 1;
  const rlimit time{seconds, seconds};
  setrlimit(RLIMIT_CPU, &time);
#if !defined(__SANITIZE_ADDRESS__)  // its shadow memory counts
  const auto bytes = static_cast<rlim_t>(limits.gigabytes * 1e9);
  const rlimit memory{bytes, bytes};
  setrlimit(RLIMIT_DATA, &memory);
#endif
}

[[noreturn]] void run_child(const std::function<std::string()>& task, int descriptor,
                            const Limits& limits) {
  prepare(limits);
  int status = failed;
  try {
    write_all(descriptor, task());
    status = done;
  } catch (const std::bad_alloc&) {
    status = out_of_memory;
  } catch (const std::exception& error) {
    write_all(descriptor, error.what());
  } catch (...) {  // Open CASCADE's own failures are no std::exception
    write_all(descriptor, "a failure without a message");
  }
  ::_exit(status);  // no destructors of the parent's resources
}

/// A running child and the pipe from it; neither outlives this.
class Child {
public:
  Child(const std::function<std::string()>& task, const Limits& limits) {
    static std::mutex one_at_a_time;  // no other child may inherit the writing end
    const std::scoped_lock lock(one_at_a_time);
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe");
    pid_ = ::fork();
    if (pid_ == 0) run_child(task, ends[1], limits);
    ::close(ends[1]);
    descriptor_ = ends[0];
    if (pid_ < 0) {
      ::close(descriptor_);
      fail("fork");
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    ::close(descriptor_);
    if (!is_waited_for_) {
      ::kill(pid_, SIGKILL);
      wait();
    }
  }

  /// Appends what has come; false at the end of the pipe.
  bool read(std::string& text, int milliseconds) const {
    pollfd wanted{.fd = descriptor_, .events = POLLIN, .revents = 0};
    if (::poll(&wanted, 1, milliseconds) <= 0) return true;
    std::array<char, 65536> buffer;
    const ssize_t count = ::read(descriptor_, buffer.data(), buffer.size());
    if (count < 0) return errno == EINTR;
    text.append(buffer.data(), static_cast<std::size_t>(count));
    return count > 0;
  }

  int wait() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    is_waited_for_ = true;
    return status;
  }

private:
  [[noreturn]] static void fail(const char* call) {
    throw Error(ErrorCode::Internal, std::string(call) + ": " + std::strerror(errno));
  }

  pid_t pid_ = -1;
  int descriptor_ = -1;
  bool is_waited_for_ = false;
};

}  // namespace

std::string isolated(const std::function<std::string()>& task, const Progress& progress,
                     const Limits& limits) {
  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(limits.seconds));
  Child child(task, limits);
  std::string text;
  while (child.read(text, 50)) {
    progress.at(0, "reading the part");
    if (Clock::now() > end)
      refuse("it takes longer than " + std::to_string(static_cast<int>(limits.seconds)) + " s");
  }
  const int status = child.wait();
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    refuse("it takes longer than " + std::to_string(static_cast<int>(limits.seconds)) + " s");
  if (WIFSIGNALED(status))
    refuse("the translator failed on it (signal " + std::to_string(WTERMSIG(status)) + ")");
  if (WEXITSTATUS(status) == out_of_memory)
    refuse("it needs more than " + std::to_string(static_cast<int>(limits.gigabytes)) + " GB");
  if (WEXITSTATUS(status) != done) refuse(text);
  return text;
}

}  // namespace ridgeline::part
