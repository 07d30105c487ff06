#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <type_traits>

#include "clients/ridgeline/commands.hpp"

namespace ridgeline::command {

/// What a command does with its parsed arguments.
template <typename Arguments>
using Run = Outcome (*)(const Session&, const Arguments&);

/// -o, which every command has that prints a result.
inline void add_output(CLI::App& command, Selected& selected) {
  command
      .add_option("-o,--output", selected.output, "File for the result (default: standard output)")
      ->type_name("FILE");
}

/// A subcommand; its options are added by the caller. The arguments are kept until it runs.
template <typename Arguments>
CLI::App& add_bare_subcommand(CLI::App& parent, Selected& selected,
                              const std::shared_ptr<Arguments>& arguments, const char* name,
                              const char* summary, std::type_identity_t<Run<Arguments>> run) {
  CLI::App* command = parent.add_subcommand(name, summary);
  command->callback([&selected, arguments, run] {
    selected.run = [arguments, run](const Session& session) { return run(session, *arguments); };
  });
  return *command;
}

/// The same with its -o.
template <typename Arguments>
CLI::App& add_subcommand(CLI::App& parent, Selected& selected,
                         const std::shared_ptr<Arguments>& arguments, const char* name,
                         const char* summary, std::type_identity_t<Run<Arguments>> run) {
  CLI::App& command = add_bare_subcommand(parent, selected, arguments, name, summary, run);
  add_output(command, selected);
  return command;
}

}  // namespace ridgeline::command
