#include "core/macro/nc_words.hpp"
#include "core/macro/text.hpp"

#include <cmath>
#include <string>

namespace ridgeline::macro {

namespace {

void add_g(NcWords& words, double value, int column) {
  if (words.g_count == NcWords::max_codes) raise(AlarmNumber::ImproperGCode, "too many", column);
  const double tenths = std::round(value * 10);
  if (!(tenths >= 0 && tenths < 10000) || std::abs(value * 10 - tenths) > 0.1) {
    raise(AlarmNumber::ImproperGCode, number_text(value), column);
  }
  const auto i = static_cast<std::size_t>(words.g_count++);
  words.g[i] = static_cast<int>(tenths);
  words.g_column[i] = static_cast<std::uint16_t>(column);
}

void add_m(NcWords& words, double value, const Word& word) {
  const bool is_literal = (word.flags & Word::is_literal) != 0;
  if (is_literal && (word.flags & Word::has_point) != 0) {
    raise(AlarmNumber::IllegalPoint, "in an M code", word.column);
  }
  if (words.m_count == NcWords::max_codes) raise(AlarmNumber::IllegalAddress, "M", word.column);
  const std::int64_t code = rounded_integer(value, word.column);
  if (code < 0 || code > 99999999) raise(AlarmNumber::IllegalAddress, "M", word.column);
  words.m[static_cast<std::size_t>(words.m_count++)] = static_cast<int>(code);
}

}  // namespace

void read_words(const Program& program, const Block& block, const Variables& variables,
                NcWords& words) {
  words.present = words.scaled = 0;
  words.g_count = words.m_count = 0;
  words.name = -1;
  const Word* const end = program.words.data() + block.first_word + block.words;
  const bool scales = !variables.profile().calculator_point;
  for (const Word* word = program.words.data() + block.first_word; word != end; ++word) {
    double number = word->number;
    if ((word->flags & Word::is_literal) == 0) {
      const Value value = evaluate(program, word->code, variables);
      if (value.vacant) continue;
      number = value.number;
    }
    if (word->letter == '<') {
      words.name = static_cast<int>(number);
    } else if (word->letter == 'G') {
      add_g(words, number, word->column);
    } else if (word->letter == 'M') {
      add_m(words, number, *word);
    } else {
      const int slot = NcWords::slot(word->letter);
      const std::uint64_t bit = std::uint64_t{1} << slot;
      words.present |= bit;
      words.scaled &= ~bit;
      if (scales && word->flags == Word::is_literal) words.scaled |= bit;
      words.value[static_cast<std::size_t>(slot)] = number;
      words.column[static_cast<std::size_t>(slot)] = word->column;
    }
  }
}

}  // namespace ridgeline::macro
