#pragma once

#include <nlohmann/json.hpp>

#include "core/units/contour.hpp"
#include "jobs/reader.hpp"

/// Half sections between documents and values. A point is [x, z], x as radius; a row is
///
///     {"pattern": "line", "start": [x, z], "end": [x, z]}
///     {"pattern": "arc", "start": .., "end": .., "radius": R, "sense": "cw" | "ccw", "centre": ..}
///
/// with the sense as seen with Z to the right and X up. The centre may be left out: then the arc is
/// the shorter one.
namespace ridgeline::jobs {

inline constexpr Range section_range = between(-1e5, 1e5, "mm");
inline constexpr Range section_radius_range = between(0, 1e5, "mm");
inline constexpr Range section_volume_range = between(0, 1e15, "mm3");
inline constexpr std::size_t max_rows = 5000;  ///< of one shape; its booleans grow with the square

nlohmann::json point_document(const units::Point& point);
units::Point read_point(const Value& value);

nlohmann::json rows_document(const std::vector<units::Segment>& rows);
/// 1 to max_rows rows.
std::vector<units::Segment> read_rows(const Value& value);

/// A region as the list of its closed contours; holes run clockwise.
nlohmann::json region_document(const units::Region& region);
/// May be empty: []. Rows of a contour that do not meet are joined by lines.
units::Region read_region(const Value& value);

}  // namespace ridgeline::jobs
