#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

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

/// A folder of its own for each test, removed with it.
class Folder {
public:
  Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder();
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const;

private:
  std::string path_;
};

std::string read(const std::string& path);

}  // namespace ridgeline::tests
