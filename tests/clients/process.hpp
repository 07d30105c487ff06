#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace ridgeline::tests {

/// What a finished process left.
struct Finished {
  int status = 0;  ///< exit status; 128 + signal when it was killed by one
  std::string out;
  std::string err;

  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// Runs the command line `ridgeline` with standard input from a text; its environment is this
/// process's with HOME and XDG_DATA_HOME in an empty folder.
Finished ridgeline(const std::vector<std::string>& arguments, const std::string& in = {});

/// The same by another copy of the program.
Finished run(const std::string& program, const std::vector<std::string>& arguments,
             const std::string& in = {});

std::string read(const std::string& path);

}  // namespace ridgeline::tests
