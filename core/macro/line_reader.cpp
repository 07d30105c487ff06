#include "core/macro/line_reader.hpp"

#include <array>
#include <charconv>

namespace ridgeline::macro {

bool LineReader::take_keyword(std::string_view keyword) {
  std::size_t matched = 0;
  while (matched < keyword.size() && peek(matched) == keyword[matched]) ++matched;
  if (matched < 2) return false;
  at_ += matched;
  return true;
}

namespace {

constexpr std::array<double, 16> powers_of_ten = {1,   1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                  1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

}  // namespace

LineReader::Number LineReader::take_number(int digits) {
  const std::uint16_t start_column = column();
  const std::size_t start = at_;
  std::int64_t mantissa = 0;
  int significant = 0, after_point = 0, count = 0;
  Number number;
  for (;; ++at_) {
    const char c = peek();
    if (c == '.') {
      if (number.has_point) raise(AlarmNumber::IllegalPoint, "two in one number", column());
      number.has_point = true;
    } else if (is_digit(c)) {
      ++count;
      if (significant > 0 || c != '0') ++significant;
      if (significant <= 18) mantissa = mantissa * 10 + (c - '0');
      if (number.has_point) ++after_point;
    } else {
      break;
    }
  }
  if (count == 0) {
    raise(number.has_point ? AlarmNumber::IllegalPoint : AlarmNumber::NoDataAfterAddress,
          "a number is expected", start_column);
  }
  if (significant > digits) {
    raise(AlarmNumber::TooManyDigits,
          std::to_string(significant) + " digits, at most " + std::to_string(digits), start_column);
  }
  if (significant <= 15 && after_point <= 15) {  // both exact, so the quotient is rounded once
    number.value =
        static_cast<double>(mantissa) / powers_of_ten[static_cast<std::size_t>(after_point)];
  } else {
    std::from_chars(chars_.data() + start, chars_.data() + at_, number.value);
  }
  return number;
}

}  // namespace ridgeline::macro
