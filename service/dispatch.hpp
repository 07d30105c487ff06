#pragma once

#include <functional>
#include <string>
#include <vector>

#include "service/library.hpp"
#include "service/sharing.hpp"
#include "service/work.hpp"

namespace ridgeline::service {

/// Gives each request to what answers it: the library, the service itself, or the jobs.
class Dispatch {
public:
  using Status = std::function<wire::InstanceStatus()>;
  Dispatch(Library& library, Sharing& sharing, Status status)
      : library_(library), sharing_(sharing), status_(std::move(status)) {}

  Work::Ran answer(const wire::Request& request, Channel channel, const Progress& progress);

  /// The kinds of job that are answered.
  static std::vector<std::string> operations();

private:
  jobs::Answer answer_library_job(const wire::Request& request, Channel channel);
  jobs::Answer answer_service_job(const wire::Request& request, Channel channel);

  Library& library_;
  Sharing& sharing_;
  Status status_;
};

}  // namespace ridgeline::service
