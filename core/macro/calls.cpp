#include <algorithm>
#include <cmath>
#include <utility>

#include "core/macro/runner.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

namespace {

// Variable of an argument letter in argument list I (design section 2.4); 0: no argument.
constexpr std::array<int, 26> argument_variables = {
    1, 2, 3, 7, 8, 9, 0, 11, 4, 5, 6, 0, 13, 0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};

// Addresses that count without increments also when written without a point.
constexpr bool counts(char letter) {
  return letter == 'D' || letter == 'E' || letter == 'F' || letter == 'H' || letter == 'M' ||
         letter == 'S' || letter == 'T';
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

void Runner::load(std::string text) {
  for (Program& program : compile(std::move(text), options_.profile)) {
    programs_.push_back(std::move(program));
    const Program& kept = programs_.back();
    by_number_.emplace(kept.number, &kept);
    note_commons(kept);
  }
}

// Commons that a program names are reported at the end even when nothing wrote them.
void Runner::note_commons(const Program& program) {
  for (const Instruction& instruction : program.code) {
    if (instruction.op == Op::Common) variables_.mark_used(instruction.index);
  }
  for (const Block& block : program.blocks) {
    if (block.kind == BlockKind::Assign && variables_.is_common(block.variable)) {
      variables_.mark_used(block.variable);
    }
  }
}

const Program* Runner::loaded(int number) {
  const auto found = by_number_.find(number);
  return found == by_number_.end() ? nullptr : found->second;
}

const Program& Runner::find(int number, int column) {
  if (const Program* program = loaded(number)) return *program;
  if (options_.library) {
    if (std::optional<std::string> text = options_.library(number)) {
      const std::size_t first = programs_.size();
      load(std::move(*text));
      if (const Program* program = loaded(number)) return *program;
      if (programs_[first].number == 0) {  // a file of that name without an O word
        programs_[first].number = number;
        by_number_[number] = &programs_[first];
        return programs_[first];
      }
    }
  }
  raise(AlarmNumber::NumberNotFound, numbered("O", number), column);
}

int Runner::levels(bool macros) const {
  return static_cast<int>(std::count_if(frames_.begin(), frames_.end(), [&](const Frame& frame) {
    const bool is_macro = frame.kind == FrameKind::Macro || frame.kind == FrameKind::Modal;
    return macros ? is_macro : frame.kind == FrameKind::Subprogram;
  }));
}

void Runner::push(Frame frame, int column) {
  const bool is_macro = frame.kind == FrameKind::Macro || frame.kind == FrameKind::Modal;
  const int limit = is_macro ? options_.profile.macro_levels : options_.profile.subprogram_levels;
  if (levels(is_macro) >= limit) {
    raise(is_macro ? AlarmNumber::TooManyMacroLevels : AlarmNumber::TooManyLevels,
          std::to_string(limit) + " at most", column);
  }
  if (frame.repeats <= 0) return;
  if (frame.kind != FrameKind::Modal) frame.modal_depth = frames_.back().modal_depth;
  if (is_macro) {
    variables_.open_level(frame.arguments.values, frame.arguments.undotted, frame.arguments.scale);
  }
  state_.modal.O = frame.program->number;
  frames_.push_back(std::move(frame));
}

// G65 and G66: words before the G code act as in any block, those after it are arguments.
Runner::Arguments Runner::read_arguments(const Program& program, const Block& block,
                                         std::int64_t& repeats, int& number, int& number_column) {
  Arguments arguments;
  const double step = increment(state_);
  arguments.scale = 1 / step;
  ArgumentSets sets;
  bool is_after = false;
  number = -1;
  for (std::uint32_t i = 0; i < block.words; ++i) {
    const Word& word = program.words[block.first_word + i];
    const bool is_literal = (word.flags & Word::is_literal) != 0;
    if (!is_after) {
      is_after = word.letter == 'G' && is_literal && (word.number == 65 || word.number == 66);
      if (!is_after && word.letter != 'G' && word.letter != 'M') {
        raise(AlarmNumber::MacroFormat, "arguments come after G65 and G66", word.column);
      }
      continue;
    }
    const Value value = is_literal ? Value(word.number) : evaluate(program, word.code, variables_);
    if (word.letter == 'P' || word.letter == 'L') {
      if (value.vacant) continue;
      const std::int64_t integer = rounded_integer(value.number, word.column);
      if (word.letter == 'L') {
        repeats = integer;
      } else {
        number = static_cast<int>(std::clamp<std::int64_t>(integer, -1, 999999999));
        number_column = word.column;
      }
      continue;
    }
    if (word.letter == 'N' || word.letter == 'O') continue;
    if (word.letter == 'G') {
      raise(AlarmNumber::GAsArgument, "a computed G", word.column);
    }
    if (word.letter == 'c' || word.letter == 'r') {
      raise(AlarmNumber::MacroFormat, ",C and ,R are no arguments", word.column);
    }
    const bool is_set = word.letter >= 'I' && word.letter <= 'K';
    const int variable = is_set ? sets.variable(word.letter, word.column)
                                : argument_variables[static_cast<std::size_t>(word.letter - 'A')];
    const auto v = static_cast<std::size_t>(variable);
    arguments.values[v] = value;
    arguments.undotted &= ~(std::uint64_t{1} << v);
    const bool scales = is_literal && (word.flags & Word::has_point) == 0 &&
                        !options_.profile.calculator_point && !counts(word.letter);
    if (scales) {
      arguments.values[v] = word.number * step;
      arguments.undotted |= std::uint64_t{1} << v;
    }
  }
  if (number < 0) raise(AlarmNumber::NoProgramNumber, {}, block.column);
  return arguments;
}

void Runner::call_macro(Frame& frame, const Block& block) {
  Frame called;
  called.kind = FrameKind::Macro;
  int number = 0, column = block.column;
  called.arguments = read_arguments(*frame.program, block, called.repeats, number, column);
  called.program = &find(number, column);
  push(std::move(called), column);
}

void Runner::call_modal(Frame& frame, const Block& block) {
  ModalCall call;
  int number = 0, column = block.column;
  call.arguments = read_arguments(*frame.program, block, call.repeats, number, column);
  call.program = &find(number, column);
  if (modal_calls_.size() >= static_cast<std::size_t>(options_.profile.macro_levels)) {
    raise(AlarmNumber::TooManyMacroLevels, "G66", block.column);
  }
  modal_calls_.push_back(std::move(call));
  state_.modal.modal_call = 660;
}

// The latest G66 that the frame may trigger; its own moves trigger only those before it.
void Runner::after_move() {
  const std::size_t depth = std::min(modal_calls_.size(), frames_.back().modal_depth);
  if (depth == 0) return;
  const ModalCall& call = modal_calls_[depth - 1];
  Frame called;
  called.kind = FrameKind::Modal;
  called.program = call.program;
  called.repeats = call.repeats;
  called.arguments = call.arguments;
  called.modal_depth = depth - 1;
  push(std::move(called), 0);
}

// M98 Ppppp Lr, or P(rrr)pppp when there is no program of the whole number.
void Runner::call_subprogram() {
  if (!words_.has('P')) raise(AlarmNumber::NoProgramNumber, "M98", block_->column);
  const int column = words_.column_of('P');
  const std::int64_t P = rounded_integer(words_['P'], column);
  if (P < 0 || P > 999999999) raise(AlarmNumber::NumberNotFound, numbered("O", P), column);
  Frame called;
  called.kind = FrameKind::Subprogram;
  int number = static_cast<int>(P);
  if (words_.has('L')) {
    called.repeats = rounded_integer(words_['L'], words_.column_of('L'));
  } else if (P > 9999 && loaded(number) == nullptr &&
             !(options_.library && options_.library(number))) {
    called.repeats = P / 10000;
    number = static_cast<int>(P % 10000);
  }
  called.program = &find(number, column);
  push(std::move(called), column);
}

void Runner::return_from(bool to_label) {
  if (frames_.size() == 1) {
    if (!to_label) {
      restart_main();
      return;
    }
  } else {
    Frame& done = frames_.back();
    const bool is_macro = done.kind == FrameKind::Macro || done.kind == FrameKind::Modal;
    if (!to_label && done.repeats > 1) {
      --done.repeats;
      done.next = 0;
      if (is_macro) variables_.reset_level(done.arguments.values);
      return;
    }
    if (is_macro) variables_.close_level();
    frames_.pop_back();
    state_.modal.O = frames_.back().program->number;
  }
  if (!to_label) return;
  Frame& caller = frames_.back();
  const int column = words_.column_of('P');
  const std::int64_t number = rounded_integer(words_['P'], column);
  const std::int32_t target =
      number < 1 || number > 99999999
          ? -1
          : goto_target(*caller.program, static_cast<int>(number), caller.next - 1);
  if (target < 0) raise(AlarmNumber::NumberNotFound, numbered("N", number), column);
  caller.next = target;
}

// M99 in the main program begins it again. A pass that begins like the one before would go on for
// ever: the run ends before it.
void Runner::restart_main() {
  executor_.finish();
  Restart now;
  for (std::size_t i = 0; i < now.commons.size(); ++i) {
    now.commons[i] = variables_.common(static_cast<int>(i));
  }
  now.locals = variables_.locals();
  now.machine = state_.machine;
  const bool is_same = restart_.is_set && restart_.commons == now.commons &&
                       restart_.locals == now.locals && restart_.machine == now.machine;
  if (is_same) {
    result_.warnings.push_back("M99 in the main program repeats it without end");
    ended_ = true;
    return;
  }
  restart_ = now;
  restart_.is_set = true;
  frames_.back().next = 0;
}

}  // namespace ridgeline::macro
