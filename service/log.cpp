#include "service/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <array>
#include <chrono>

#include "service/library_job.hpp"

namespace ridgeline::service::log {
namespace {

struct Name {
  std::string_view name;
  Level level;
  spdlog::level::level_enum spdlog;
};
constexpr std::array names{Name{"debug", Level::Debug, spdlog::level::debug},
                           Name{"info", Level::Info, spdlog::level::info},
                           Name{"warning", Level::Warning, spdlog::level::warn},
                           Name{"error", Level::Error, spdlog::level::err},
                           Name{"off", Level::Off, spdlog::level::off}};

const Name& of(Level level) {
  return names.at(static_cast<std::size_t>(level));
}

spdlog::logger& logger() {
  static const auto logger = [] {
    auto made = std::make_shared<spdlog::logger>("ridgelined",
                                                 std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_pattern("%v");
    made->flush_on(spdlog::level::debug);
    return made;
  }();
  return *logger;
}

}  // namespace

bool set_level(std::string_view name) {
  for (const Name& each : names) {
    if (each.name != name) continue;
    logger().set_level(each.spdlog);
    return true;
  }
  return false;
}

std::string level() {
  for (const Name& each : names) {
    if (each.spdlog == logger().level()) return std::string(each.name);
  }
  return "info";
}

bool is_on(Level level) {
  return logger().should_log(of(level).spdlog);
}

void event(Level level, std::string_view name, const nlohmann::ordered_json& fields) {
  if (!is_on(level)) return;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  nlohmann::ordered_json line = {
      {"time", time_text(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count())},
      {"level", of(level).name},
      {"event", name}};
  if (fields.is_object()) line.update(fields);
  logger().log(of(level).spdlog,
               line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace ridgeline::service::log
