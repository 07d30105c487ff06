#pragma once

#include <optional>
#include <string>

#include "clients/ridgeline/interrupt.hpp"
#include "jobs/answer.hpp"

namespace ridgeline::command {

/// Where and how the command line asks: the options before and after every command.
struct Options {
  bool local = false;
  std::string library;  ///< file, with --local; empty: the usual one
  int domain = 0;
  std::optional<double> timeout;  ///< [s]
  bool quiet = false;
};

/// Asks the service over DDS, or computes in this process with the same code.
class Session {
public:
  Session(const Options& options, const Interrupt& interrupt)
      : options_(options), interrupt_(interrupt) {}

  const Options& options() const { return options_; }

  /// Never throws: what goes wrong is the error object.
  jobs::Answer ask(const std::string& job, const std::string& format) const;

private:
  jobs::Answer compute(const std::string& job, const std::string& format) const;

  const Options& options_;
  const Interrupt& interrupt_;
};

}  // namespace ridgeline::command
