#include <algorithm>
#include <array>

#include "core/macro/runner.hpp"

namespace ridgeline::macro {

namespace {

// Variable of an argument letter in argument list I (design section 2.4); 0: no argument.
constexpr std::array<int, 26> argument_variables = {
    1, 2, 3, 7, 8, 9, 0, 11, 4, 5, 6, 0, 13, 0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};

constexpr int each_block_variable(char letter) {
  switch (letter) {
    case 'G': return 10;
    case 'L': return 12;
    case 'N': return 14;
    case 'P': return 16;
    default: return argument_variables[static_cast<std::size_t>(letter - 'A')];
  }
}

// Addresses that count without increments also when written without a point.
constexpr bool counts(char letter) {
  return letter == 'D' || letter == 'E' || letter == 'F' || letter == 'H' || letter == 'M' ||
         letter == 'S' || letter == 'T' || letter == 'G' || letter == 'L' || letter == 'N' ||
         letter == 'P';
}

// Argument list II: I, J, K that repeat or go back in order open the next of ten sets.
class ArgumentSets {
public:
  int variable(char letter, int column) {
    const int place = letter - 'I';
    if (place <= last_) ++set_;
    last_ = place;
    if (set_ >= 10) raise(AlarmNumber::MacroFormat, "more than ten sets of I J K", column);
    return 4 + 3 * set_ + place;
  }

private:
  int set_ = 0;
  int last_ = -1;
};

}  // namespace

Runner::Call Runner::read_call(const Program& program, const Block& block) {
  return read_call(program, block, 'G', 65, 66.1);
}

// Words before the code (from low to high) act as in any block, those after it are arguments.
Runner::Call Runner::read_call(const Program& program, const Block& block, char letter, double low,
                               double high) {
  Call call;
  Arguments& arguments = call.arguments;
  arguments.scale = 1 / increment(state_);
  ArgumentSets sets;
  bool is_after = false;
  call.column = block.column;
  for (std::uint32_t i = 0; i < block.words; ++i) {
    const Word& word = program.words[block.first_word + i];
    const Value value = word_value(program, word);
    if (!is_after) {
      is_after = word.letter == letter && value.number >= low && value.number <= high;
      call.code = value.number;
      if (!is_after && word.letter != 'G' && word.letter != 'M') {
        raise(AlarmNumber::MacroFormat, "arguments come after the code that calls", word.column);
      }
      continue;
    }
    if (word.letter == '<') {
      call.name = static_cast<int>(word.number);
      call.column = word.column;
      continue;
    }
    if (word.letter == 'P' || word.letter == 'L') {
      if (value.vacant) continue;
      const std::int64_t integer = rounded_integer(value.number, word.column);
      if (word.letter == 'L') {
        call.repeats = integer;
      } else {
        call.number = static_cast<int>(std::clamp<std::int64_t>(integer, -1, 999999999));
        call.column = word.column;
      }
      continue;
    }
    if (word.letter == 'N' || word.letter == 'O') continue;
    if (word.letter == 'G') {
      raise(AlarmNumber::GAsArgument, "G after the code that calls", word.column);
    }
    if (word.letter == 'c' || word.letter == 'r') {
      raise(AlarmNumber::MacroFormat, ",C and ,R are no arguments", word.column);
    }
    const bool is_set = word.letter >= 'I' && word.letter <= 'K';
    const int variable = is_set ? sets.variable(word.letter, word.column)
                                : argument_variables[static_cast<std::size_t>(word.letter - 'A')];
    take_argument(arguments, word, value, variable);
  }
  return call;
}

Value Runner::word_value(const Program& program, const Word& word) const {
  const bool is_literal = (word.flags & Word::is_literal) != 0;
  return is_literal ? Value(word.number) : evaluate(program, word.code, variables_);
}

void Runner::take_argument(Arguments& arguments, const Word& word, Value value,
                           int variable) const {
  const auto v = static_cast<std::size_t>(variable);
  arguments.values[v] = value;
  arguments.undotted &= ~(std::uint64_t{1} << v);
  const bool scales =
      word.flags == Word::is_literal && !options_.profile.calculator_point && !counts(word.letter);
  if (!scales) return;
  arguments.values[v] = word.number / arguments.scale;
  arguments.undotted |= std::uint64_t{1} << v;
}

// G66.1: the block is G65 P_ with all its words as arguments, those too that G65 has no variable
// for: the last G, L, N, P. Its modal G codes act as well.
void Runner::call_each_block(const Program& program, const Block& block) {
  executor_.execute_modes(words_);
  const std::size_t depth = modal_depth();
  Arguments arguments;
  arguments.scale = 1 / increment(state_);
  ArgumentSets sets;
  for (std::uint32_t i = 0; i < block.words; ++i) {
    const Word& word = program.words[block.first_word + i];
    const char letter = word.letter;
    if (letter < 'A' || letter > 'Z') {
      raise(AlarmNumber::MacroFormat, "no argument of G66.1", word.column);
    }
    const bool is_set = letter >= 'I' && letter <= 'K';
    const int variable = is_set ? sets.variable(letter, word.column) : each_block_variable(letter);
    if (variable == 0) raise(AlarmNumber::MacroFormat, "no argument of G66.1", word.column);
    take_argument(arguments, word, word_value(program, word), variable);
  }
  call_modally(modal_calls_[depth - 1], arguments, depth, block.column);
}

}  // namespace ridgeline::macro
