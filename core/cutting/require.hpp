#pragma once

#include <string>
#include <string_view>

#include "core/base/error.hpp"

namespace ridgeline::cutting {

/// Throws Error{BadInput} unless least <= value <= most; NaN fails. The message names the last part
/// of the field, the value, its unit and the limits; with the greatest double as `most` only the
/// least.
void require_between(std::string_view field, double value, double least, double most,
                     std::string_view unit);

}  // namespace ridgeline::cutting
