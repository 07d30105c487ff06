#pragma once

#include "core/chamfer/loop.hpp"
#include "jobs/reader.hpp"

/// Limits of documents, with their units: generous for any machine shop, narrow enough that the
/// core computes with its full precision within them.
namespace ridgeline::jobs {

inline constexpr Range coordinate_range = between(-1e6, 1e6, "mm");
inline constexpr Range radius_range = between(1e-3, 1e6, "mm");
inline constexpr Range length_range = between(0, 1e6, "mm");
inline constexpr Range turn_range = between(-360, 360, "degrees");
inline constexpr int max_tool_number = 99'999'999;
inline constexpr std::size_t max_holes = 10'000;
inline constexpr int max_points = chamfer::point_limit;

}  // namespace ridgeline::jobs
