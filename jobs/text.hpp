#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/text.hpp"

namespace ridgeline::jobs {

using ridgeline::text;  // of a number
/// The text with every byte that is not valid UTF-8 replaced by U+FFFD.
std::string valid_utf8(std::string_view text);

bool is_valid_utf8(std::string_view text);

/// At most `length` bytes of valid UTF-8, with "..." in place of what was cut off.
std::string shortened(std::string_view text, std::size_t length = 80);

/// "a, b or c".
std::string alternatives(std::span<const std::string_view> names);

/// The few of `names` most like `wanted`, nearest first (edit distance, letter case ignored).
std::vector<std::string> nearest(std::string_view wanted, std::vector<std::string> names,
                                 std::size_t count = 3);

/// One token of a JSON pointer, escaped (RFC 6901): "a/b" is "a~1b".
std::string pointer_token(std::string_view key);

}  // namespace ridgeline::jobs
