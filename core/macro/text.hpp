#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ridgeline::macro {

/// Prefix and number, e.g. "#100".
std::string numbered(std::string_view prefix, std::int64_t number);

/// The shortest decimal number that reads back as `value`, without exponent: "0.1", "41", "-3.25".
std::string number_text(double value);

/// Text of a program as valid UTF-8: bytes that are not become '?', control characters blanks.
std::string readable(std::string_view text);

/// A number as DPRNT prints it: `before` places before the point, filled with blanks, `after`
/// after.
std::string printed(double value, int before, int after);

}  // namespace ridgeline::macro
