#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/base/progress.hpp"
#include "core/macro/result.hpp"

namespace ridgeline::jobs {

/// The page of a motion that a macro program or a cycle makes, with its feed and height along the
/// path. `document`: the result without its arrays.
std::string macro_page(const macro::Result& result, std::string_view title,
                       const nlohmann::json& document, const Progress& progress);

}  // namespace ridgeline::jobs
