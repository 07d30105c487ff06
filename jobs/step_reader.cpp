#include "jobs/step_reader.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <utility>

#include "core/base/error.hpp"

namespace ridgeline::jobs {
namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorCode::BadFile, "the part file cannot be read: " + why,
              {.field = "/product_step"});
}

[[noreturn]] void fail(const std::string& call, int number) {
  throw Error(ErrorCode::Internal, call + ": " + std::strerror(number));
}

/// Beside the running program, where it is installed or where it is built.
std::string reader_program() {
  namespace fs = std::filesystem;
  constexpr int most_levels = 3;  // a bench in tests/bench/units is that deep in a build folder
  std::error_code failure;
  const fs::path own = fs::read_symlink("/proc/self/exe", failure).parent_path();
  fs::path folder = own;
  for (int level = 0; level <= most_levels; ++level, folder = folder.parent_path()) {
    fs::path program = folder / "libexec/ridgeline/ridgeline-step";
    if (fs::exists(program, failure)) return program;
  }
  throw Error(ErrorCode::Storage,
              "STEP files are read by the program ridgeline-step, which is not installed: "
              "libexec/ridgeline/ridgeline-step is in no folder above " +
                  own.string());
}

/// A file descriptor with its owner.
class Descriptor {
public:
  explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
  Descriptor(Descriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  void close() {
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  }
  int get() const { return descriptor_; }

private:
  int descriptor_;
};

/// The reader's standard input: in memory, so that nobody waits for the other to read or write.
Descriptor input_of(const Json& wish, std::string_view step) {
  Descriptor file(::memfd_create("step", MFD_CLOEXEC));
  if (file.get() < 0) fail("memfd_create", errno);
  const auto write_all = [&](std::string_view text) {
    while (!text.empty()) {
      const ssize_t count = ::write(file.get(), text.data(), text.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail("write", errno);
      text.remove_prefix(static_cast<std::size_t>(count));
    }
  };
  write_all(wish.dump() + "\n");
  write_all(step);
  if (::lseek(file.get(), 0, SEEK_SET) != 0) fail("lseek", errno);
  return file;
}

/// How the reader starts: input and output in place, no signal of ours, in a group of its own so
/// that Ctrl-C asks us only.
class SpawnSettings {
public:
  SpawnSettings(const Descriptor& input, const Descriptor& output) {
    check(posix_spawn_file_actions_init(&actions_));
    check(posix_spawnattr_init(&attributes_));
    check(posix_spawn_file_actions_adddup2(&actions_, input.get(), STDIN_FILENO));
    check(posix_spawn_file_actions_adddup2(&actions_, output.get(), STDOUT_FILENO));
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    check(posix_spawnattr_setsigmask(&attributes_, &none));
    check(posix_spawnattr_setsigdefault(&attributes_, &all));
    check(posix_spawnattr_setpgroup(&attributes_, 0));
    check(posix_spawnattr_setflags(
        &attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP));
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  pid_t start(const std::string& program) const {
    std::string name = program;
    const std::array<char*, 2> arguments{name.data(), nullptr};
    pid_t pid = -1;
    const int failed =
        ::posix_spawn(&pid, program.c_str(), &actions_, &attributes_, arguments.data(), environ);
    if (failed != 0) fail("the reader of STEP files does not start: " + program, failed);
    return pid;
  }

private:
  static void check(int failed) {
    if (failed != 0) fail("posix_spawn", failed);
  }
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

/// A running reader and the pipe from it; neither outlives this.
class Reader {
public:
  Reader(const Json& wish, std::string_view step) {
    const Descriptor input = input_of(wish, step);
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe", errno);
    output_ = ends[0];
    Descriptor written(ends[1]);
    try {
      pid_ = SpawnSettings(input, written).start(reader_program());
    } catch (...) {
      ::close(output_);
      throw;
    }
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() {
    ::close(output_);
    if (!is_waited_for_) {
      ::kill(pid_, SIGKILL);
      wait();
    }
  }

  /// Appends what has come; false at the end of the pipe.
  bool read(std::string& text, int milliseconds) const {
    pollfd wanted{.fd = output_, .events = POLLIN, .revents = 0};
    if (::poll(&wanted, 1, milliseconds) <= 0) return true;
    std::array<char, 65536> buffer;
    const ssize_t count = ::read(output_, buffer.data(), buffer.size());
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
  pid_t pid_ = -1;
  int output_ = -1;
  bool is_waited_for_ = false;
};

void check_end(int status, const ReaderLimits& limits) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    refuse("it takes longer than " + std::to_string(static_cast<int>(limits.seconds)) + " s");
  }
  if (WIFSIGNALED(status)) {
    refuse("the translator failed on it (signal " + std::to_string(WTERMSIG(status)) + ")");
  }
  if (WEXITSTATUS(status) != 0) {
    throw Error(ErrorCode::Internal, "the reader of STEP files ended with status " +
                                         std::to_string(WEXITSTATUS(status)));
  }
}

}  // namespace

Json read_step_file(Json wish, std::string_view step, const Progress& progress,
                    const ReaderLimits& limits) {
  const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                                   std::chrono::duration<double>(limits.seconds));
  wish["seconds"] = limits.seconds;
  wish["gigabytes"] = limits.gigabytes;
  Reader reader(wish, step);
  std::string text;
  while (reader.read(text, 50)) {
    progress.at(0, "reading the part");
    if (Clock::now() > end) {
      refuse("it takes longer than " + std::to_string(static_cast<int>(limits.seconds)) + " s");
    }
  }
  check_end(reader.wait(), limits);
  Json document = Json::parse(text, nullptr, false);
  if (!document.is_object()) {
    throw Error(ErrorCode::Internal, "the reader of STEP files answered no document");
  }
  return document;
}

}  // namespace ridgeline::jobs
