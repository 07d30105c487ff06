#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>

#include "clients/manual/manual.hpp"
#include "clients/ridgeline/commands.hpp"
#include "clients/ridgeline/files.hpp"
#include "core/base/version.hpp"
#include "jobs/memory.hpp"

namespace ridgeline::command {
namespace {

void add_options(CLI::App& app, Options& options) {
  CLI::Option* local =
      app.add_flag("--local", options.local, "Compute here instead of asking the service");
  app.add_option("--library", options.library, "Library file that --local uses")
      ->type_name("FILE")
      ->needs(local);
  app.add_option("--domain", options.domain, "DDS domain of the service")
      ->check(CLI::Range(0, 100))
      ->capture_default_str()
      ->envname("RIDGELINE_DOMAIN");
  app.add_option("--instance", options.instance,
                 "Ask this instance alone (default: the one with the least to do)")
      ->envname("RIDGELINE_INSTANCE");
  app.add_option("--timeout", options.timeout, "Seconds to wait for the answer")
      ->check(CLI::Range(0.001, 1e6));
  app.add_flag("--quiet,-q", options.quiet, "No progress and no messages on standard error");
}

/// Nothing but results goes to standard output.
void set_up_diagnostics(const Options& options) {
  const auto logger = std::make_shared<spdlog::logger>(
      "ridgeline", std::make_shared<spdlog::sinks::stderr_sink_st>());
  logger->set_pattern("ridgeline: %v");
  if (options.quiet) logger->set_level(spdlog::level::off);
  spdlog::set_default_logger(logger);
}

/// Writes the outcome: a result where it was asked for, anything else to standard output.
ExitStatus deliver(const Outcome& outcome, const std::string& output) {
  try {
    const bool is_result =
        outcome.status == ExitStatus::Done || outcome.status == ExitStatus::VerificationFailed;
    if (!outcome.diagnostic.empty()) spdlog::error("{}", outcome.diagnostic);
    write_file(is_result ? output : "", outcome.text);
    return outcome.status;
  } catch (const Error& error) {
    spdlog::error("{}", error.what());
    return ExitStatus::Usage;
  }
}

int run(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is a write error, told as one
  const Interrupt interrupt;
  Options options;
  Selected selected;
  CLI::App app{"Tool paths that chamfer and deburr the edges of cross holes", "ridgeline"};
  app.set_version_flag("--version", "ridgeline " + std::string(version()));
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Lengths in mm, angles in degrees, feeds in mm/min, speeds in rev/min. The result alone goes "
      "to\n"
      "standard output. Exit status: 0 done, 1 refused (the reason is printed as JSON), 2 wrong "
      "usage\n"
      "or unreadable file, 3 no service or no answer in time, 4 verification failed, 130 "
      "interrupted.");
  add_options(app, options);
  add_job_commands(app, selected);
  add_predict_command(app, selected);
  add_library_commands(app, selected);
  add_macro_commands(app, selected);
  add_batch_command(app, selected);
  add_units_commands(app, selected);
  add_status_command(app, selected);
  add_watch_command(app, selected);
  add_serve_command(app, selected);
  manual::add_manual_option(app, {1, "\\fBridgelined\\fR(8), /usr/share/doc/ridgeline"});
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return static_cast<int>(app.exit(error) == 0 ? ExitStatus::Done : ExitStatus::Usage);
  }
  set_up_diagnostics(options);
  const Session session(options, interrupt);
  return static_cast<int>(deliver(attempt([&] { return selected.run(session); }), selected.output));
}

}  // namespace
}  // namespace ridgeline::command

int main(int argc, char** argv) {
  try {
    ridgeline::jobs::keep_freed_memory();
    return ridgeline::command::run(argc, argv);
  } catch (const std::exception& error) {  // no memory, or no thread
    std::fprintf(stderr, "ridgeline: %s\n", error.what());
    return static_cast<int>(ridgeline::command::ExitStatus::Refused);
  }
}
