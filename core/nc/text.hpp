#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/nc/program.hpp"

/// Numbers and comments as a control reads them. Used by the writers.
namespace ridgeline::nc {

/// How a control wants its numbers.
enum class NumberStyle {
  Point,  ///< FANUC: always a decimal point, 10. -0.5 0.
  Plain,  ///< LinuxCNC, Siemens: 10 -0.5 0
  Signed  ///< HEIDENHAIN: +10 -0.5 +0
};

/// value / 10^decimals in decimal, without trailing zeros, never with an exponent, never -0.
std::string decimal(std::int64_t value, int decimals, NumberStyle style);

/// Power of ten, decimals in [0, 18].
constexpr std::int64_t power_of_ten(int decimals) {
  std::int64_t power = 1;
  for (int n = 0; n < decimals; ++n) power *= 10;
  return power;
}

/// Text of comments for a control: its characters (others are spelt out or become ?), one line
/// each, wrapped at 60 characters, nothing in it that the control would act on. Without delimiters.
std::vector<std::string> comment_lines(const std::vector<std::string>& comments, Dialect dialect);

/// Blocks one under the other, numbered when a step is given. Numbers above 99999 start again.
class Blocks {
public:
  Blocks(std::string_view prefix, std::optional<int> first, int step)
      : prefix_(prefix), next_(first), first_(first.value_or(0)), step_(step) {}

  /// A line that carries no number (comments, program heads).
  void line(std::string_view text);
  void block(std::string_view text);
  std::string take() { return std::move(text_); }

private:
  std::string text_;
  std::string prefix_;
  std::optional<int> next_;
  int first_;
  int step_;
};

}  // namespace ridgeline::nc
