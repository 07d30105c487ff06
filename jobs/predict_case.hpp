#pragma once

#include "core/cutting/predict.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {

/// Reads `case` of interfaces.md: {"tool", "N", "feed_per_tooth", "phi_deg", "coef", "engagement",
/// "modes_x" | "frf_x", ...}. Throws Error{BadInput}.
void read_case(const Value& value, cutting::Engagement& engagement);
/// `options` of interfaces.md; each may be left out.
void read_options(const Value& value, cutting::Engagement& engagement);

cutting::Method read_method(Object& object);
std::string_view name(cutting::Method method);
std::string_view name(cutting::Stability stability);

inline constexpr Range speed_range = between(1, 1e6, "rev/min");

}  // namespace ridgeline::jobs
