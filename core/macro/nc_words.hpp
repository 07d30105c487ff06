#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/macro/program.hpp"
#include "core/macro/variables.hpp"

namespace ridgeline::macro {

/// The words of one NC block with their values. A word whose variable is vacant is not there.
struct NcWords {
  static constexpr int max_codes = 16;
  std::uint64_t present = 0;  ///< bit of a slot
  std::uint64_t scaled = 0;   ///< written without decimal point, as increments
  std::array<double, 28> value;
  std::array<std::uint16_t, 28> column;
  std::array<int, max_codes> g;  ///< G codes in tenths
  std::array<std::uint16_t, max_codes> g_column;
  std::array<int, max_codes> m;
  int name = -1;  ///< of a program, index into Program::names; -1: none
  int g_count = 0;
  int m_count = 0;

  static constexpr int slot(char letter) {
    return letter == 'c' ? 26 : letter == 'r' ? 27 : letter - 'A';
  }
  bool has(char letter) const { return (present >> slot(letter) & 1U) != 0; }
  double operator[](char letter) const { return value[static_cast<std::size_t>(slot(letter))]; }
  int column_of(char letter) const { return column[static_cast<std::size_t>(slot(letter))]; }
  bool is_scaled(char letter) const { return (scaled >> slot(letter) & 1U) != 0; }
  bool has_g(int tenths) const {
    for (int i = 0; i < g_count; ++i) {
      if (g[static_cast<std::size_t>(i)] == tenths) return true;
    }
    return false;
  }
  bool has_m(int code) const {
    return std::find(m.begin(), m.begin() + m_count, code) != m.begin() + m_count;
  }
};

/// Evaluates the words of a block into `words`. Raises alarms of the expressions, 007 and 010.
void read_words(const Program& program, const Block& block, const Variables& variables,
                NcWords& words);

}  // namespace ridgeline::macro
