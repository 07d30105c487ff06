#pragma once

#include "core/nc/program.hpp"

namespace ridgeline::nc {

inline constexpr double largest_coordinate = 99'999;  ///< [mm]: five digits before the point
inline constexpr double largest_feed = 999'999;       ///< [mm/min]

/// Everything of the program but its motion. Throws Error{BadInput} with the field of the job's
/// "output", or Error{Unsupported} for what the dialect does not have.
void validate(const Program& program);

/// The work offset as a control selects it.
struct WorkOffset {
  std::string words;  ///< "G54", "G54.1 P7", "G505"; HEIDENHAIN: the number of the datum
};
/// Throws Error{BadInput} when the dialect has no such offset.
WorkOffset work_offset(const Program& program);

}  // namespace ridgeline::nc
