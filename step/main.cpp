// ridgeline-step: reads a STEP file for the service and the command. On standard input a line of
// JSON that says what is wanted, then the file; on standard output the document.
//
// It is a program of its own for two reasons: a file can make Open CASCADE fault, run for ever or
// take all memory, and its libraries cost every start 35 ms.

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <string>

#include "step/reading.hpp"

// Read by the address sanitizer: Open CASCADE turns faults into its exceptions, or the process ends
// by the signal, as it does without the sanitizer. The name is the sanitizer's.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "handle_segv=0:handle_sigbus=0:handle_sigfpe=0";
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace {

using Json = nlohmann::json;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool has_shadow_memory = true;
#elif defined(__has_feature)
constexpr bool has_shadow_memory = __has_feature(address_sanitizer);
#else
constexpr bool has_shadow_memory = false;
#endif

std::string everything(int descriptor) {
  std::string text;
  std::array<char, 65536> buffer;
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;  // the other end is gone: nobody wants it any more
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// Limits of time and memory, no core file, and an end when whoever asked is gone.
void limit(const Json& wish) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const auto seconds = static_cast<rlim_t>(wish.value("seconds", 120.0)) + 1;
  const rlimit time{seconds, seconds};
  setrlimit(RLIMIT_CPU, &time);
  if (has_shadow_memory) return;  // it counts
  const auto bytes = static_cast<rlim_t>(wish.value("gigabytes", 4.0) * 1e9);
  const rlimit memory{bytes, bytes};
  setrlimit(RLIMIT_DATA, &memory);
}

/// Standard output for us alone: what Open CASCADE prints goes to standard error.
int claim_output() {
  const int output = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
  return output;
}

}  // namespace

// What no memory is left for ends it by a signal, which whoever asked names.
int main() {                 // NOLINT(bugprone-exception-escape)
  ::close_range(3, ~0U, 0);  // sockets and files of whoever asked
  const int output = claim_output();
  if (output < 0) return 1;
  const std::string input = everything(STDIN_FILENO);
  const std::size_t line = input.find('\n');
  const Json wish = Json::parse(input.substr(0, line), nullptr, false);
  if (line == std::string::npos || !wish.is_object()) {
    write_all(STDERR_FILENO, "ridgeline-step: reads STEP files for ridgeline and ridgelined\n");
    return 2;
  }
  limit(wish);
  const Json document = ridgeline::step::reading(wish, std::string_view(input).substr(line + 1));
  const std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  ::_exit(write_all(output, text) ? 0 : 1);  // Open CASCADE's destructors have nothing to save
}
