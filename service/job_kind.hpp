#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace ridgeline::service {

/// The member "job" of a document, without reading the rest; empty when there is none.
std::string job_kind(std::string_view document);

/// Does a job change the library or the service? Such jobs go by the topic ridgeline/change, so
/// that access control can tell who may.
bool is_change(const nlohmann::json& document);
bool asks_for_change(std::string_view document);

}  // namespace ridgeline::service
