#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "clients/ridgeline/gateway.hpp"
#include "clients/ridgeline/subcommand.hpp"

namespace ridgeline::command {
namespace {

Outcome run(const Session& session, const int& port) {
  Gateway gateway(session);
  fmt::print("http://127.0.0.1:{}/\n", gateway.bind(port));
  std::fflush(stdout);
  gateway.run();
  return {ExitStatus::Interrupted, {}, {}};
}

}  // namespace

void add_serve_command(CLI::App& app, Selected& selected) {
  const auto port = std::make_shared<int>(8090);
  CLI::App& command = add_bare_subcommand(app, selected, port, "serve",
                                          "A page for the browser of this machine", run);
  command.add_option("--port", *port, "TCP port on the loopback; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command.footer(
      "Prints the page's address: the library, a job by form or file, its result in the viewer, "
      "and "
      "the\n"
      "live status. It listens on 127.0.0.1 alone, refuses requests of other pages, and asks the "
      "service\n"
      "over DDS like any client. Runs until it is interrupted.");
}

}  // namespace ridgeline::command
