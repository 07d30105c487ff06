#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/macro/runner.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

void Runner::load(std::string text) {
  for (Program& program : compile(std::move(text), options_.profile)) {
    programs_.push_back(std::move(program));
    const Program& kept = programs_.back();
    by_number_.emplace(kept.number, &kept);
    if (!kept.name.empty()) by_name_.emplace(kept.name, &kept);
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
  frames_.push_back(frame);
}

// <NAME>; <O123> is O123.
const Program& Runner::find(const std::string& name, int column) {
  int number = 0;
  const char* const end = name.data() + name.size();
  if (name.size() > 1 && name[0] == 'O') {
    const auto [rest, error] = std::from_chars(name.data() + 1, end, number);
    if (error == std::errc() && rest == end) return find(number, column);
  }
  const auto found = by_name_.find(name);
  if (found != by_name_.end()) return *found->second;
  if (options_.named_library) {
    if (std::optional<std::string> text = options_.named_library(name)) {
      const std::size_t first = programs_.size();
      load(std::move(*text));
      return *by_name_.emplace(name, &programs_[first]).first->second;
    }
  }
  raise(AlarmNumber::NumberNotFound, "<" + readable(name) + ">", column);
}

const Program& Runner::called_by(const Program& program, const Call& call) {
  if (call.name >= 0) {
    return find(program.names[static_cast<std::size_t>(call.name)], call.column);
  }
  if (call.number < 0) raise(AlarmNumber::NoProgramNumber, {}, call.column);
  return find(call.number, call.column);
}

void Runner::call_macro(Frame& frame, const Block& block) {
  Call call = read_call(*frame.program, block);
  Frame called;
  called.kind = FrameKind::Macro;
  called.program = &called_by(*frame.program, call);
  called.repeats = call.repeats;
  called.arguments = call.arguments;
  push(called, call.column);
}

void Runner::call_modal(Frame& frame, const Block& block) {
  Call call = read_call(*frame.program, block);
  add_modal(called_by(*frame.program, call), call, block.column);
  if (modal_calls_.back().is_each_block) {  // which calls in its own block too
    call_modally(modal_calls_.back(), call.arguments, modal_calls_.size(), block.column);
  }
}

void Runner::add_modal(const Program& program, const Call& call, int column) {
  if (modal_calls_.size() >= static_cast<std::size_t>(options_.profile.macro_levels)) {
    raise(AlarmNumber::TooManyMacroLevels, "G66", column);
  }
  const bool is_each_block = call.code > 66 && call.code < 67;
  modal_calls_.push_back({&program, call.repeats, call.arguments, is_each_block});
  note_modal_call();
}

// #4012
void Runner::note_modal_call() {
  state_.modal.modal_call = modal_calls_.empty()                ? 670
                            : modal_calls_.back().is_each_block ? 661
                                                                : 660;
}

// How many of the modal calls the frame may trigger: the latest of them, whose own blocks trigger
// only those before it.
std::size_t Runner::modal_depth() const {
  return std::min(modal_calls_.size(), frames_.back().modal_depth);
}

void Runner::after_move() {
  const std::size_t depth = modal_depth();
  if (depth == 0 || modal_calls_[depth - 1].is_each_block) return;
  const ModalCall& call = modal_calls_[depth - 1];
  call_modally(call, call.arguments, depth, 0);
}

void Runner::call_modally(const ModalCall& call, const Arguments& arguments, std::size_t depth,
                          int column) {
  Frame called;
  called.kind = FrameKind::Modal;
  called.program = call.program;
  called.repeats = call.repeats;
  called.arguments = arguments;
  called.modal_depth = depth - 1;
  push(called, column);
}

// G67 and what steers the program (M98, M99, its end) stay what they are under G66.1.
bool Runner::is_each_block_call() const {
  const std::size_t depth = modal_depth();
  if (depth == 0 || !modal_calls_[depth - 1].is_each_block) return false;
  const bool steers = words_.has_g(670) || words_.has_m(98) || words_.has_m(198) ||
                      words_.has_m(99) || words_.has_m(2) || words_.has_m(30);
  return !steers;
}

// M98 Ppppp Lr, M98 <NAME> Lr, or P(rrr)pppp when there is no program of the whole number. With Q,
// on other makes H, it begins at that sequence number; without P, in the program that calls.
void Runner::call_subprogram(const Program& program) {
  Frame called;
  called.kind = FrameKind::Subprogram;
  const char start = words_.has('Q') ? 'Q' : 'H';
  if (words_.has('L')) called.repeats = rounded_integer(words_['L'], words_.column_of('L'));
  if (words_.name >= 0) {
    called.program = &find(program.names[static_cast<std::size_t>(words_.name)], block_->column);
  } else if (words_.has('P')) {
    called.program = &numbered_subprogram(called.repeats);
  } else if (words_.has(start)) {
    called.program = &program;
  } else {
    raise(AlarmNumber::NoProgramNumber, "M98", block_->column);
  }
  if (words_.has(start)) {
    const int column = words_.column_of(start);
    const std::int64_t label = rounded_integer(words_[start], column);
    const bool is_possible = label >= 1 && label <= 99999999;
    called.first = is_possible ? goto_target(*called.program, static_cast<int>(label), -1) : -1;
    if (called.first < 0) raise(AlarmNumber::NumberNotFound, numbered("N", label), column);
    called.next = called.first;
  }
  push(called, block_->column);
}

const Program& Runner::numbered_subprogram(std::int64_t& repeats) {
  const int column = words_.column_of('P');
  const std::int64_t P = rounded_integer(words_['P'], column);
  if (P < 0 || P > 999999999) raise(AlarmNumber::NumberNotFound, numbered("O", P), column);
  int number = static_cast<int>(P);
  const bool has_repeats = !words_.has('L') && P > 9999 && loaded(number) == nullptr &&
                           !(options_.library && options_.library(number));
  if (has_repeats) {
    repeats = P / 10000;
    number = static_cast<int>(P % 10000);
  }
  return find(number, column);
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
      done.next = done.first;
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
