#include "clients/client.hpp"

#include <fmt/format.h>

#include "clients/session.hpp"
#include "service/job_kind.hpp"

namespace ridgeline::client {

Client::Client(const Options& options) {
  try {
    session_ = std::make_unique<Session>(options);
  } catch (const dds::Failure& failure) {
    throw Error(ErrorCode::NoService, "cannot enter DDS domain " + std::to_string(options.domain) +
                                          ": " + failure.what());
  }
}

Client::~Client() = default;

jobs::Answer Client::ask(std::string_view job, std::string_view format,
                         const Patience& patience) noexcept {
  if (job.size() > dds::max_request_bytes) {
    return jobs::refusal({ErrorCode::BadInput,
                          fmt::format("the job is {} bytes long", job.size()),
                          {.field = "",
                           .value = fmt::format("{} bytes", job.size()),
                           .limit = fmt::format("{} bytes", dds::max_request_bytes),
                           .parameter = {},
                           .target = {}}});
  }
  const std::string text(job);
  if (text.find('\0') != text.npos) {
    return jobs::refusal({ErrorCode::BadInput, "the job holds a zero byte: it is not JSON"});
  }
  const Channel channel = service::asks_for_change(job) ? Channel::Change : Channel::Compute;
  return session_->ask(wire::Call{wire::CallKind::Job, text.c_str()}, channel, std::string(format),
                       patience);
}

jobs::Answer Client::ask(const ridgeline_wire_ChamferJob& chamfer, std::string_view format,
                         const Patience& patience) noexcept {
  return session_->ask(&chamfer, Channel::Compute, std::string(format), patience);
}

jobs::Answer Client::echo(std::string_view text, const Patience& patience) noexcept {
  const std::string copy(text);
  return session_->ask(wire::Call{wire::CallKind::Echo, copy.c_str()}, Channel::Compute, "json",
                       patience);
}

std::vector<wire::InstanceStatus> Client::status(std::chrono::milliseconds wait) {
  return session_->status(wait);
}

}  // namespace ridgeline::client
