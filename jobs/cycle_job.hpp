#pragma once

#include <nlohmann/json.hpp>

#include "core/macro/cycle.hpp"
#include "jobs/answer.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {

/// Reads "family", "method" and "params" of a cycle job. Throws Error{BadInput} by field.
macro::Cycle read_cycle(Object& job);

/// "points" and the other numbers of a solved cycle, as tests/oracle/cycles has them.
nlohmann::json cycle_document(const macro::Cycle& cycle, const macro::CycleResult& result,
                              const Progress& progress);

}  // namespace ridgeline::jobs
