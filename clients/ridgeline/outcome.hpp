#pragma once

#include <functional>
#include <string>

#include "core/base/error.hpp"
#include "jobs/answer.hpp"

namespace ridgeline::command {

/// Exit status of the command line: a contract with scripts.
enum class ExitStatus {
  Done = 0,
  Refused = 1,             ///< the job was refused: the JSON error is printed
  Usage = 2,               ///< wrong arguments, or a file that cannot be read or written
  NoService = 3,           ///< no service, or no answer in time
  VerificationFailed = 4,  ///< the program does not keep what the job asks
  Interrupted = 130,
};

/// What a command leaves behind: text for standard output or for its file.
struct Outcome {
  ExitStatus status = ExitStatus::Done;
  std::string text;
  std::string diagnostic;  ///< one line for standard error; empty: none
};

/// The outcome of an answer, in the format that was asked for.
Outcome outcome_of(const jobs::Answer& answer, const std::string& format);

/// The outcome of a file that cannot be used, or of text in it that is not JSON.
Outcome unusable(const Error& error);

/// Runs what may throw: an Error of its own files is unusable(), anything else an internal error.
Outcome attempt(const std::function<Outcome()>& run);

}  // namespace ridgeline::command
