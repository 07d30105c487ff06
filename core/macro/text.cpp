#include "core/macro/text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace ridgeline::macro {

namespace {

// Length of the valid UTF-8 sequence at `at`; 0: there is none (RFC 3629, table 3-7 of Unicode).
std::size_t sequence_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0U;
  };
  const auto follows = [&](std::size_t i, unsigned low, unsigned high) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1, 0x80, 0xBF) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const unsigned low = first == 0xE0 ? 0xA0 : 0x80;
    const unsigned high = first == 0xED ? 0x9F : 0xBF;
    return follows(1, low, high) && follows(2, 0x80, 0xBF) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const unsigned low = first == 0xF0 ? 0x90 : 0x80;
    const unsigned high = first == 0xF4 ? 0x8F : 0xBF;
    return follows(1, low, high) && follows(2, 0x80, 0xBF) && follows(3, 0x80, 0xBF) ? 4 : 0;
  }
  return 0;
}

}  // namespace

std::string numbered(std::string_view prefix, std::int64_t number) {
  std::string text(prefix);
  text.append(std::to_string(number));
  return text;
}

std::string number_text(double value) {
  std::array<char, 400> digits;  // a double has at most 309 digits before the point
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value + 0.0,
                                          std::chars_format::fixed);
  return std::string(digits.data(), error == std::errc() ? end : digits.data());
}

std::string readable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = sequence_length(text, at);
    if (length == 0) {
      result += '?';
      ++at;
    } else if (length == 1 && static_cast<unsigned char>(text[at]) < 0x20) {
      result += ' ';
      ++at;
    } else {
      result.append(text.substr(at, length));
      at += length;
    }
  }
  return result;
}

std::string printed(double value, int before, int after) {
  std::array<char, 400> digits;  // a double has at most 309 digits before the point
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(),
                                          std::abs(value), std::chars_format::fixed, after);
  const std::string number(digits.data(), error == std::errc() ? end : digits.data());
  const std::size_t width =
      static_cast<std::size_t>(before) + (after > 0 ? static_cast<std::size_t>(after) + 1 : 0);
  const std::string padding(number.size() < width ? width - number.size() : 0, ' ');
  return (value < 0 ? "-" : " ") + padding + number;
}

}  // namespace ridgeline::macro
