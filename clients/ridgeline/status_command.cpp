#include <fmt/format.h>

#include <memory>

#include "clients/client.hpp"
#include "clients/ridgeline/subcommand.hpp"

namespace ridgeline::command {
namespace {

using Statuses = std::vector<wire::InstanceStatus>;

jobs::Answer document_of(const Statuses& statuses) {
  jobs::Answer answer;
  answer.document = {{"status", "ok"}, {"instances", nlohmann::json::array()}};
  for (const wire::InstanceStatus& status : statuses) {
    answer.document["instances"].push_back(wire::document(status));
  }
  return answer;
}

std::string table_of(const Statuses& statuses) {
  std::string table = fmt::format("{:<20} {:<10} {:<20} {:>7} {:>9} {:>8} {:>9} {:>10} {:>9}\n",
                                  "instance", "version", "host", "running", "queued", "clients",
                                  "requests", "p99 [ms]", "library");
  for (const wire::InstanceStatus& s : statuses) {
    table += fmt::format(
        "{:<20} {:<10} {:<20} {:>3} of {:<2}{:>3} of {:<4}{:>8} {:>9} {:>10.2f} {:>9}\n", s.name,
        s.version, s.host, s.running, s.workers, s.queued, s.queue_limit, s.clients, s.requests,
        s.latency_p99 * 1e3, s.library_changes);
  }
  return table;
}

Outcome run(const Session& session, const std::string& format) {
  try {
    const Statuses statuses = session.status();
    jobs::Answer answer = document_of(statuses);
    answer.text = table_of(statuses);
    return outcome_of(answer, format);
  } catch (const Error& error) {
    return outcome_of(jobs::refusal(error), "json");
  }
}

}  // namespace

void add_status_command(CLI::App& app, Selected& selected) {
  const auto format = std::make_shared<std::string>("json");
  CLI::App& command = add_bare_subcommand(app, selected, format, "status",
                                          "Instances of the service, their load and library", run);
  command.add_option("--format", *format, "What to print: json, or a table for people")
      ->check(CLI::IsMember({"json", "table"}))
      ->capture_default_str();
  command.footer("Exit status 3 when no instance answers.");
}

}  // namespace ridgeline::command
