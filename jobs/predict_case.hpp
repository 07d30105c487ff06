#pragma once

#include "core/cutting/predict.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {

/// Reads `case` of interfaces.md: {"tool", "N", "feed_per_tooth", "phi_deg", "coef", "engagement",
/// "modes_x" | "frf_x", ...}. Throws Error{BadInput}.
void read_case(const Value& value, cutting::Engagement& engagement);
/// `options` of interfaces.md; each may be left out.
void read_options(const Value& value, cutting::Engagement& engagement);

/// [[Hz, zeta, N/mm], ...].
cutting::Modes read_mode_rows(const Value& value);
/// [[Hz, re, im], ...] in mm/N, ascending in Hz.
cutting::MeasuredResponse read_measured_response(const Value& value);
/// "pitch_deg", "runout_mm", "offset_mm", "offset_deg", "lag" and "tw_mode" for a cutter whose
/// pitch has as many entries as it has teeth.
void read_teeth(Object& object, cutting::Cutter& cutter);

cutting::Method read_method(Object& object);
std::string_view name(cutting::Method method);
std::string_view name(cutting::Stability stability);

inline constexpr Range speed_range = between(1, 1e6, "rev/min");

}  // namespace ridgeline::jobs
