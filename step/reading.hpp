#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace ridgeline::step {

/// What is found in a STEP file, as the document that the service and the command take:
///
///     {"want": "product", "axis": {"direction", "point"}}   {"product", "placement"}
///     {"want": "stock"}                                     {"shape"}
///     {"want": "mouths"}                                    {"mouths", "low", "high"}
///
/// or {"error": {"code", "message", "value", "limit"}}.
nlohmann::json reading(const nlohmann::json& wish, std::string_view file) noexcept;

}  // namespace ridgeline::step
