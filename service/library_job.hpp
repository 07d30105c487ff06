#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "jobs/answer.hpp"
#include "service/library.hpp"

namespace ridgeline::service {

/// Answers a job {"job": "library", "operation": "put" | "get" | "list" | "remove" | "import" |
/// "export" | "history", ...} of docs/dds.md: the same in the service and with --local. `request`
/// is the id under which a change is remembered, so that asking twice changes once.
jobs::Answer answer_library(const nlohmann::json& document, Library& library,
                            std::string_view request = {}) noexcept;

/// Nanoseconds since 1970 as ISO 8601 in UTC with milliseconds.
std::string time_text(std::int64_t nanoseconds);

}  // namespace ridgeline::service
