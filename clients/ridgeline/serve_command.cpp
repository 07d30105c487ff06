#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "clients/ridgeline/commands.hpp"
#include "clients/ridgeline/gateway.hpp"

namespace ridgeline::command {
namespace {

Outcome run(const Session& session, int port) {
  Gateway gateway(session);
  port = gateway.bind(port);
  fmt::print("http://127.0.0.1:{}/\n", port);
  std::fflush(stdout);
  gateway.run();
  return {ExitStatus::Interrupted, {}, {}};
}

}  // namespace

void add_serve_command(CLI::App& app, Selected& selected) {
  CLI::App* command = app.add_subcommand("serve", "A page for the browser of this machine");
  const auto port = std::make_shared<int>(8090);
  command->add_option("--port", *port, "TCP port on the loopback; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->footer(
      "Prints the page's address: the library, a job by form or file, its result in the viewer, "
      "and "
      "the\n"
      "live status. It listens on 127.0.0.1 alone, refuses requests of other pages, and asks the "
      "service\n"
      "over DDS like any client. Runs until it is interrupted.");
  command->callback([&selected, port] {
    selected.run = [port](const Session& session) { return run(session, *port); };
  });
}

}  // namespace ridgeline::command
