#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/progress.hpp"
#include "jobs/answer.hpp"

namespace ridgeline::jobs {

/// One job on its way to its answer: the parsed document and what it may use.
struct Request {
  const nlohmann::json& document;
  std::string_view format;  ///< one of those that answer.cpp lists for the kind
  const Definitions& definitions;
  const Progress& progress;
};

// One function per kind of job, in the file of its name: Answer chamfer(const Request&) is in
// chamfer.cpp. It reads the document with reader.hpp, throws Error (answer() makes the error
// object) and returns the result with its bulk numbers as arrays. A new kind is one declaration
// here, one line in the table of answer.cpp and one in CMakeLists.txt.

Answer chamfer(const Request& request);
Answer cycle(const Request& request);
Answer expand(const Request& request);
Answer macro_program(const Request& request);
Answer predict(const Request& request);
Answer units_program(const Request& request);
Answer verify(const Request& request);

}  // namespace ridgeline::jobs
