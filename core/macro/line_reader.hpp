#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/macro/alarm.hpp"

namespace ridgeline::macro {

/// One block's significant characters: upper case, without blanks and comments; each knows its
/// column in the text. Reading past the end gives '\0'.
class LineReader {
public:
  void clear() {
    chars_.clear();
    columns_.clear();
    at_ = 0;
  }
  void add(char c, std::size_t column) {
    chars_.push_back(c);
    columns_.push_back(static_cast<std::uint16_t>(column < 65535 ? column : 65535));
  }

  bool at_end() const { return at_ >= chars_.size(); }
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < chars_.size() ? chars_[at_ + ahead] : '\0';
  }
  char take() { return at_ < chars_.size() ? chars_[at_++] : '\0'; }
  void skip(std::size_t count) { at_ += count; }
  void back() { --at_; }
  bool take_if(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  std::uint16_t column() const {
    if (at_ < columns_.size()) return columns_[at_];
    return columns_.empty() ? std::uint16_t{1} : static_cast<std::uint16_t>(columns_.back() + 1);
  }
  std::string_view rest() const { return std::string_view(chars_).substr(at_); }

  /// Takes a keyword or an abbreviation of it (at least two letters): WHILE, WHI, WH.
  bool take_keyword(std::string_view keyword);

  /// A number literal without sign. `digits`: most digits without leading zeros.
  struct Number {
    double value = 0;
    bool has_point = false;
  };
  Number take_number(int digits);

private:
  std::string chars_;
  std::vector<std::uint16_t> columns_;
  std::size_t at_ = 0;
};

inline bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
inline bool is_letter(char c) {
  return c >= 'A' && c <= 'Z';
}

}  // namespace ridgeline::macro
