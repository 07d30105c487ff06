#pragma once

#include <string>

namespace ridgeline::macro {

/// Throws Error{BadInput} that names a field, its value and the limit that it must keep.
[[noreturn]] void refuse(const std::string& field, double value, const std::string& limit);

}  // namespace ridgeline::macro
