#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/answer.hpp"
#include "service/instance_status.hpp"

struct ridgeline_wire_ChamferJob;

namespace ridgeline::client {

struct Options {
  unsigned domain = 0;
  std::string instance;  ///< ask this one alone; empty: the least loaded
  std::string name;      ///< partition of the replies; empty: $RIDGELINE_CLIENT, or a unique one
  std::chrono::milliseconds discovery{3000};  ///< wait so long for a first instance
  std::chrono::milliseconds absence{10000};   ///< and so long for one when the last is lost
};

/// How far a request is.
struct ProgressReport {
  double fraction = 0;              ///< 0..1
  std::optional<double> remaining;  ///< estimate [s]
  std::string stage;
};

/// How long to wait for an answer, what to hear meanwhile, and when to give it up.
struct Patience {
  std::chrono::milliseconds timeout{60'000};
  std::function<void(const ProgressReport&)> progress;  ///< called from ask()
  std::stop_token stop;                                 ///< cancels the request
};

/// Asks the service over DDS. Every ask ends within its timeout with the answer or with an error
/// object: timeout, no_service, busy, cancelled or what the service refused. A request goes to the
/// least loaded instance and, with the same id, to another when that one is lost. All functions may
/// be called from several threads at once.
class Client {
public:
  /// Throws Error{NoService} when the DDS domain cannot be entered.
  explicit Client(const Options& options = {});
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// A job document, in a format of jobs::answer().
  jobs::Answer ask(std::string_view job, std::string_view format,
                   const Patience& patience = {}) noexcept;
  /// A chamfer job field by field; see idl/ridgeline.idl.
  jobs::Answer ask(const ridgeline_wire_ChamferJob& chamfer, std::string_view format,
                   const Patience& patience = {}) noexcept;
  /// The text comes back as the answer's text: the cost of the way alone.
  jobs::Answer echo(std::string_view text, const Patience& patience = {}) noexcept;

  /// The live instances by name. Waits for the first up to `wait`, and a moment for the others.
  std::vector<wire::InstanceStatus> status(std::chrono::milliseconds wait);

private:
  class Session;
  std::unique_ptr<Session> session_;
};

}  // namespace ridgeline::client
