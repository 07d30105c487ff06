#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "clients/ridgeline/outcome.hpp"
#include "clients/ridgeline/session.hpp"

namespace CLI {
class App;
}

namespace ridgeline::command {

/// What the command line asked for, set by the command that was parsed.
struct Selected {
  std::function<Outcome(const Session&)> run;
  std::string output;  ///< -o; empty: standard output
};

/// chamfer, verify, ...: commands that send one job and print its answer.
void add_job_commands(CLI::App& app, Selected& selected);
/// predict: machining error of an engagement or along a path, and the corrected path.
void add_predict_command(CLI::App& app, Selected& selected);
/// library put, get, list, ...
void add_library_commands(CLI::App& app, Selected& selected);

/// macro run, check and make.
void add_macro_commands(CLI::App& app, Selected& selected);

/// units plan, show, edit, nc: turn-mill programs.
void add_units_commands(CLI::App& app, Selected& selected);
/// A STEP file, by its name.
bool is_part_file(const std::string& path);
/// Stores the workpieces that the hole edges of a part lie on; tells what could not be named.
Outcome import_part(const Session& session, const std::string& path);

/// status: the live instances of the service.
void add_status_command(CLI::App& app, Selected& selected);

/// watch: the same, updated as they work.
void add_watch_command(CLI::App& app, Selected& selected);

/// serve: a page for the browser of this machine.
void add_serve_command(CLI::App& app, Selected& selected);

/// batch: many jobs, over all the instances there are.
void add_batch_command(CLI::App& app, Selected& selected);

/// Reads a file that is to hold one JSON document. Throws Error{BadFile} or Error{BadInput}.
nlohmann::json read_document(const std::string& path);

}  // namespace ridgeline::command
