#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace ridgeline::fuzz {

/// Takes values from the bytes of one input; zeros when they are used up.
class Input {
public:
  Input(const std::uint8_t* bytes, std::size_t size)
      : left_(reinterpret_cast<const char*>(bytes), size) {}

  bool is_empty() const { return left_.empty(); }

  template <class T>
  T number() {
    T value{};
    std::memcpy(&value, left_.data(), std::min(sizeof value, left_.size()));
    left_.remove_prefix(std::min(sizeof value, left_.size()));
    return value;
  }
  /// Up to 255 bytes without a zero, as the wire brings text.
  std::string text() {
    const std::string_view piece = left_.substr(0, number<std::uint8_t>());
    std::string text(piece.substr(0, piece.find('\0')));
    left_.remove_prefix(std::min(piece.size(), left_.size()));
    return text;
  }
  std::string rest() const { return std::string(left_); }

private:
  std::string_view left_;
};

}  // namespace ridgeline::fuzz
