#include "clients/ridgeline/outcome.hpp"

#include <optional>

namespace ridgeline::command {
namespace {

ExitStatus status_of_error(ErrorCode code) {
  switch (code) {
    case ErrorCode::NoService:
    case ErrorCode::Timeout:
    case ErrorCode::Busy: return ExitStatus::NoService;
    case ErrorCode::Cancelled: return ExitStatus::Interrupted;
    case ErrorCode::BadFile:
    case ErrorCode::Storage: return ExitStatus::Usage;
    default: return ExitStatus::Refused;
  }
}

}  // namespace

Outcome outcome_of(const jobs::Answer& answer, const std::string& format) {
  Outcome outcome;
  const std::string status = answer.document.value("status", "");
  if (jobs::is_error(answer)) {
    const nlohmann::json& error = answer.document.at("error");
    outcome.status =
        status_of_error(error_code(error.value("code", "")).value_or(ErrorCode::Internal));
    outcome.text = jobs::to_json(answer);
    outcome.diagnostic = error.value("message", "");
    return outcome;
  }
  if (status == "failed") {
    outcome.status = ExitStatus::VerificationFailed;
    outcome.diagnostic = "verification failed";
  }
  if (status == "alarm") {
    outcome.status = ExitStatus::Refused;
    outcome.diagnostic = "the program stopped with an alarm";
  }
  outcome.text = format == "json" ? jobs::to_json(answer) : answer.text;
  return outcome;
}

Outcome unusable(const Error& error) {
  return {ExitStatus::Usage, jobs::to_json(jobs::refusal(error)), error.what()};
}

Outcome attempt(const std::function<Outcome()>& run) {
  try {
    return run();
  } catch (const Error& error) {
    return unusable(error);
  } catch (const std::exception& error) {
    return outcome_of(jobs::refusal(Error(ErrorCode::Internal, error.what())), "json");
  }
}

}  // namespace ridgeline::command
