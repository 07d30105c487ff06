#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

/// Log lines of the service: one JSON object a line on standard error, with time, level and event.
namespace ridgeline::service::log {

enum class Level { Debug, Info, Warning, Error, Off };

/// "debug", "info", "warning", "error", "off".
bool set_level(std::string_view name);
std::string level();
bool is_on(Level level);

/// Members are written in the order given.
void event(Level level, std::string_view name, const nlohmann::ordered_json& fields = {});

}  // namespace ridgeline::service::log
