#include "service/dispatch.hpp"

#include "jobs/parse.hpp"
#include "jobs/reader.hpp"
#include "service/job_kind.hpp"
#include "service/library_job.hpp"
#include "service/log.hpp"

namespace ridgeline::service {
namespace {

using Json = nlohmann::json;

void require_json(const std::string& kind, const std::string& format) {
  if (format != "json") {
    jobs::refuse({.code = ErrorCode::Unsupported,
                  .field = "",
                  .value = format,
                  .limit = "json",
                  .message = "a " + kind + " job has no format \"" + format + "\": ask for json"});
  }
}

void require_change(Channel channel) {
  if (channel != Channel::Change) {
    throw Error(ErrorCode::Unsupported,
                "what changes the library or the service is taken on the topic ridgeline/change");
  }
}

enum class Operation { Status, LogLevel };
constexpr jobs::Choices<Operation, 2> operation_names{
    {{"status", Operation::Status}, {"log_level", Operation::LogLevel}}};

}  // namespace

std::vector<std::string> Dispatch::operations() {
  std::vector<std::string> names = jobs::job_names();
  names.insert(names.end(), {"library", "service"});
  return names;
}

jobs::Answer Dispatch::answer_library_job(const wire::Request& request, Channel channel) {
  require_json("library", request.format);
  const Json document = jobs::parse(request.text);
  if (!is_change(document)) return answer_library(document, library_);
  require_change(channel);
  jobs::Answer answer = answer_library(document, library_, wire::text(request.id));
  sharing_.publish();
  return answer;
}

jobs::Answer Dispatch::answer_service_job(const wire::Request& request, Channel channel) {
  require_json("service", request.format);
  const Json document = jobs::parse(request.text);
  jobs::Object job{jobs::Value(document)};
  job.has("job");
  const jobs::Value operation = job.required("operation");
  Json result = {{"job", "service"}, {"status", "ok"}, {"operation", operation.json()}};
  switch (operation.choice(operation_names)) {
    case Operation::Status:
      job.finish();
      result["instance"] = wire::document(status_());
      break;
    case Operation::LogLevel: {
      const jobs::Value level = job.required("level");
      job.finish();
      require_change(channel);
      if (!log::set_level(level.string())) level.refuse("debug, info, warning, error or off");
      result["level"] = level.json();
      break;
    }
  }
  return {result, {}, {}};
}

Work::Ran Dispatch::answer(const wire::Request& request, Channel channel,
                           const Progress& progress) {
  if (request.unusable) return {jobs::refusal(*request.unusable), {}};
  if (request.kind == wire::CallKind::Echo) {
    return {{{{"job", "echo"}, {"status", "ok"}}, {}, request.text}, "echo"};
  }
  const std::string kind = job_kind(request.text);
  try {
    if (kind == "library") return {answer_library_job(request, channel), kind};
    if (kind == "service") return {answer_service_job(request, channel), kind};
  } catch (const Error& error) {
    return {jobs::refusal(error), kind};
  }
  return {jobs::answer(request.text, request.format, library_, progress), kind};
}

}  // namespace ridgeline::service
