#include <pthread.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <thread>

#include "clients/manual/manual.hpp"
#include "core/base/version.hpp"
#include "jobs/memory.hpp"
#include "service/log.hpp"
#include "service/server.hpp"

namespace {

using namespace ridgeline;

struct Options {
  std::string library;
  std::string log_level = "info";
  bool is_check = false;
  service::ServerOptions server;
};

std::string default_instance() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  std::string name = std::string(host.data()).substr(0, 50) + '-' + std::to_string(getpid());
  for (char& c : name) {
    if (!dds::is_name(std::string_view(&c, 1))) c = '-';
  }
  return name;
}

void declare(CLI::App& app, Options& options) {
  app.add_option("--library", options.library,
                 "File of the named workpieces, tools, ... (default: ridgeline/library.db in "
                 "$XDG_DATA_HOME or ~/.local/share)")
      ->type_name("FILE");
  app.add_option("--instance", options.server.instance,
                 "Name of this instance on the network (default: host name and process)")
      ->envname("RIDGELINE_INSTANCE")
      ->check([](const std::string& name) {
        return dds::is_name(name) ? std::string()
                                  : "must be 1 to 64 of letters, digits, '_', '-', '.'";
      });
  app.add_option("--domain", options.server.domain, "DDS domain (default 0)")
      ->check(CLI::Range(0U, dds::max_domain))
      ->envname("RIDGELINE_DOMAIN");
  app.add_option("--workers", options.server.limits.workers,
                 "Jobs that are computed at once (default: one for each processor)")
      ->check(CLI::Range(1U, 1024U));
  app.add_option("--queue", options.server.limits.queue,
                 "Requests that may wait before more are refused (default 256)")
      ->check(CLI::Range(1U, 1'000'000U));
  app.add_option_function<std::size_t>(
         "--kept-answers",
         [&options](std::size_t mb) { options.server.limits.answer_bytes = mb << 20; },
         "Memory for answers that are kept for requests that come twice [MB] (default 64)")
      ->check(CLI::Range(1U, 65'536U));
  app.add_option("--log-level", options.log_level, "debug, info, warning, error or off")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}));
  app.add_flag("--check", options.is_check,
               "Check the library and the DDS configuration, say what is wrong, and exit");
  app.footer(
      "DDS is configured by the file that CYCLONEDDS_URI names; without it this machine's\n"
      "loopback alone is used. SIGTERM ends it after what is being computed; a second one\n"
      "cancels that too.");
}

/// What the middleware has to say, as a log line like all others.
void log_dds(void*, const dds_log_data_t* line) {
  std::string message(line->message, line->size);
  while (!message.empty() && message.back() == '\n') message.pop_back();
  service::log::event(service::log::Level::Warning, "dds", {{"message", message}});
}

int check(const Options& options) {
  int status = EXIT_SUCCESS;
  const auto report = [&](const char* what, auto&& look) {
    try {
      const std::string found = look();
      std::cout << what << ": " << found << '\n';
    } catch (const std::exception& error) {
      std::cout << what << ": FAILED: " << error.what() << '\n';
      status = EXIT_FAILURE;
    }
  };
  report("library", [&] {
    const service::Library library(options.library);
    if (!library.damage().empty()) throw Error(ErrorCode::Storage, library.damage());
    return library.file() + ", " + std::to_string(library.list().size()) + " definitions";
  });
  report("dds", [&] {
    const auto domain = dds::Domain::open(options.server.domain);
    const dds::Entity participant = domain->participant();
    const char* uri = std::getenv("CYCLONEDDS_URI");
    return "domain " + std::to_string(domain->id()) + ", " +
           (dds::uses_loopback() ? std::string("built-in loopback configuration") : uri);
  });
  return status;
}

int serve(const Options& options) {
  service::Library library(options.library, options.server.instance);
  if (!library.damage().empty()) {
    service::log::event(service::log::Level::Error, "library_damaged",
                        {{"message", library.damage()}});
  }
  service::Server server(options.server, library);
  service::log::event(service::log::Level::Info, "started",
                      {{"instance", options.server.instance},
                       {"domain", options.server.domain},
                       {"library", library.file()},
                       {"workers", options.server.limits.workers},
                       {"pid", getpid()},
                       {"version", version()}});
  sigset_t signals;
  sigemptyset(&signals);
  for (const int each : {SIGINT, SIGTERM, SIGUSR1}) sigaddset(&signals, each);
  std::thread waiter([&] {
    for (int received = 0; sigwait(&signals, &received) == 0 && received != SIGUSR1;) server.stop();
  });
  const auto end_waiter = [&] {
    pthread_kill(waiter.native_handle(), SIGUSR1);
    waiter.join();
  };
  try {
    server.run();
  } catch (...) {
    end_waiter();
    throw;
  }
  end_waiter();
  service::log::event(service::log::Level::Info, "stopped",
                      {{"instance", options.server.instance}});
  return EXIT_SUCCESS;
}

int run(int argc, char** argv) {
  jobs::keep_freed_memory();
  Options options;
  options.server.instance = default_instance();
  options.server.limits.workers = std::max(2U, std::thread::hardware_concurrency());
  options.library = service::default_library_file().string();
  CLI::App app("Ridgeline's service: computes chamfer paths and keeps the library, over DDS",
               "ridgelined");
  app.set_version_flag("--version", "ridgelined " + std::string(version()));
  declare(app, options);
  manual::add_manual_option(app, {8, "\\fBridgeline\\fR(1), /usr/share/doc/ridgeline"});
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? EXIT_SUCCESS : 2;
  }
  service::log::set_level(options.log_level);
  if (!options.is_check) dds_set_log_sink(&log_dds, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  sigset_t set;
  sigemptyset(&set);
  for (const int each : {SIGINT, SIGTERM, SIGUSR1}) sigaddset(&set, each);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);  // before any thread is started
  try {
    return options.is_check ? check(options) : serve(options);
  } catch (const std::exception& error) {
    service::log::event(service::log::Level::Error, "failed", {{"message", error.what()}});
    return EXIT_FAILURE;
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {  // no memory even for the log
    std::fprintf(stderr, "ridgelined: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
