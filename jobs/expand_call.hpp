#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/nc/expand.hpp"
#include "jobs/answer.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {

/// What a bound macro stands for: which letters it has, and the chamfer job that they complete.
struct BoundCall {
  /// Definitions by letter and number: 'W', "1" -> "tube-40".
  std::map<char, std::map<std::string, std::string>> names;
  nlohmann::json job = nlohmann::json::object();  ///< members that a call need not give
};

/// A binding file.
struct CallBinding {
  nc::Binding letters;
  std::map<int, BoundCall> calls;  ///< by macro number
};

/// Reads {"macros": [{"number", "letters": {"Q": "cutting_amount", ...}, "names": {"W": {"1":
/// "tube-40"}}, "job": {...}}]}; nullopt: nc::default_binding(). Throws Error{BadInput} by field.
CallBinding read_binding(const std::optional<Value>& value);

/// The chamfer job that a call asks for. Throws Error{BadInput} for a letter that has no such
/// value.
nlohmann::json job_of(const nc::Call& call, const BoundCall& bound, const Definitions& definitions);

}  // namespace ridgeline::jobs
