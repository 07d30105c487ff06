#pragma once

#include <string>

#include "core/chamfer/job.hpp"
#include "core/geometry/ridge.hpp"

namespace ridgeline::jobs {

/// The part with its symbols in three views (along A1, along the hole's depth, from the side), the
/// ridge line, the tool and its path, and the section at the start of the loop. SVG text; equal
/// input gives equal text.
std::string chamfer_drawing(const chamfer::Job& job, const geometry::Edge& edge,
                            const chamfer::Result& result, const Progress& progress);

}  // namespace ridgeline::jobs
