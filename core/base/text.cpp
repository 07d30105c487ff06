#include "core/base/text.hpp"

#include <array>
#include <charconv>

namespace ridgeline {

std::string text(double value, std::string_view unit) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string result(buffer.data(), end);
  if (!unit.empty()) result.append(" ").append(unit);
  return result;
}

}  // namespace ridgeline
