#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "clients/ridgeline/interrupt.hpp"
#include "jobs/answer.hpp"

namespace ridgeline::client {
class Client;
}
namespace ridgeline::wire {
struct InstanceStatus;
}

namespace ridgeline::command {

/// Where and how the command line asks: the options before and after every command.
struct Options {
  bool local = false;
  std::string library;  ///< file, with --local; empty: the usual one
  int domain = 0;
  std::string instance;           ///< the only one to ask; empty: any
  std::optional<double> timeout;  ///< [s]
  bool quiet = false;
};

/// Rounded up, so that no positive time becomes none.
std::chrono::milliseconds milliseconds(double seconds);

/// Asks the service over DDS, or computes in this process with the same code. May be used from
/// several threads at once.
class Session {
public:
  Session(const Options& options, const Interrupt& interrupt);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session();

  const Options& options() const { return options_; }
  const Interrupt& interrupt() const { return interrupt_; }

  /// Hears how far a job is; called from the thread that asks.
  using Listener = std::function<void(double fraction, std::string_view stage)>;

  /// Never throws: what goes wrong is the error object. Shows a progress bar.
  jobs::Answer ask(const std::string& job, const std::string& format) const;
  /// The same, told to `listener` instead.
  jobs::Answer ask(const std::string& job, const std::string& format,
                   const Listener& listener) const;

  /// The live instances of the service. Throws Error{NoService}.
  std::vector<wire::InstanceStatus> status() const;

private:
  jobs::Answer compute(const std::string& job, const std::string& format,
                       const Listener& listener) const;
  jobs::Answer send(const std::string& job, const std::string& format,
                    const Listener& listener) const;
  client::Client& client() const;

  const Options& options_;
  const Interrupt& interrupt_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<client::Client> client_;  ///< from the first use on
};

}  // namespace ridgeline::command
