#pragma once

#include <gtest/gtest.h>

#include <sys/types.h>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "clients/client.hpp"
#include "tests/support/temporary_folder.hpp"

namespace ridgeline {

using namespace std::chrono_literals;

/// Times as long as in the release that work may take: in a build for the sanitizers, or what
/// RIDGELINE_SLOWNESS says (scripts/valgrind).
extern const int slowness;

/// A program started by a test, killed with it at the latest.
class Process {
public:
  /// Standard error goes to `log`.
  Process(const std::vector<std::string>& command, const std::filesystem::path& log);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  void signal(int number) const;
  /// Exit status, or 128 + the signal that ended it; -1: still running after slowness * `limit`.
  int wait(std::chrono::milliseconds limit);
  pid_t pid() const { return pid_; }

private:
  pid_t pid_ = -1;
  int status_ = -1;
};

/// A test with a DDS domain and discovery tag that no other test has.
class Loopback : public testing::Test {
protected:
  Loopback();

  std::vector<std::string> daemon_command(const std::string& name,
                                          std::vector<std::string> more = {}) const;
  /// Starts ridgelined as instance `name` with a library of its own, kept over restarts.
  std::unique_ptr<Process> start(const std::string& name, std::vector<std::string> more = {});
  client::Options options() const;
  /// The log lines of an instance with that event.
  std::vector<nlohmann::json> events(const std::string& name, const std::string& event) const;
  /// Waits until a condition holds, slowness * `limit` at most.
  template <class F>
  bool eventually(F&& condition, std::chrono::milliseconds limit = 10s) {
    for (const auto end = std::chrono::steady_clock::now() + slowness * limit;;) {
      if (condition()) return true;
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(5ms);
    }
  }

  unsigned domain_ = 0;
  TemporaryFolder folder_;
};

/// Jobs that several tests ask for.
inline constexpr char put_tube[] = R"({"job": "library", "operation": "put", "definition":
  {"kind": "workpiece", "name": "tube-40", "shape": "thick_walled_cylinder", "inner_radius": 20,
   "outer_radius": 30, "length": 100,
   "holes": [{"name": "H1", "shape": "circle", "radius": 5}]}})";
inline constexpr char list[] = R"({"job": "library", "operation": "list"})";

/// "ok", or the error's code.
std::string code(const jobs::Answer& answer);

}  // namespace ridgeline
