#pragma once

#include <string>
#include <string_view>

namespace ridgeline {

/// A number for messages: the shortest text that reads back the same, and its unit.
std::string text(double value, std::string_view unit = {});

}  // namespace ridgeline
