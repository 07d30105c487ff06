#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/macro/result.hpp"
#include "jobs/answer.hpp"

namespace ridgeline::jobs {

/// The moves of a macro run as a table at `pointer`; the member of `document` there becomes the
/// description of its columns. See Array.
Array macro_moves_array(std::string pointer, const macro::Result& result, nlohmann::json& document,
                        const Progress& progress);

/// The motion seen from above and from the side, as SVG text.
std::string macro_drawing(const macro::Result& result, std::string_view title,
                          const Progress& progress);

}  // namespace ridgeline::jobs
