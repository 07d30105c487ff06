#include "core/macro/runner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/macro/loops.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

namespace {

constexpr std::uint64_t check_interval = 8192;  // blocks between looks at the clock
constexpr std::size_t most_text = 50'000'000;   // bytes of messages and prints
constexpr std::size_t most_trace_text = 200;    // characters of a block in the trace

std::string place(const Program& program, const Block& block) {
  return numbered("O", program.number) + " line " + std::to_string(block.line);
}

}  // namespace

Runner::Runner(std::string text, const Options& options, const Progress& progress)
    : options_(options),
      progress_(progress),
      state_(options.profile),
      system_(state_, result_),
      variables_(options.profile, system_),
      recorder_(result_, options.limits.moves, options.profile.rapid),
      executor_(state_, recorder_, result_) {
  load(std::move(text));
}

Result Runner::run() {
  prepare();
  start_ = std::chrono::steady_clock::now();
  try {
    loop();
  } catch (const AlarmRaised& raised) {
    result_.alarm = raised.alarm;
    result_.alarm->message = readable(result_.alarm->message);
    const Frame& frame = frames_.back();
    result_.alarm->program = frame.program->number;
    if (block_ != nullptr) {
      result_.alarm->line = static_cast<int>(block_->line);
      if (result_.alarm->column == 0) result_.alarm->column = block_->column;
    }
  }
  finish();
  return std::move(result_);
}

void Runner::prepare() {
  const Program* main = &programs_.front();
  if (options_.program) {
    main = loaded(*options_.program);
    if (main == nullptr) {
      throw Error(ErrorCode::BadInput, numbered("the text holds no program O", *options_.program));
    }
  }
  for (const auto& [number, value] : options_.set) {
    try {
      if (number >= 100 && number <= 999 && variables_.is_common(number)) {
        variables_.write_common(number, value);
      } else if (number >= 1 && number <= 33) {
        variables_.write_local(number, value);
      } else {
        system_.preset(number, value);
      }
    } catch (const AlarmRaised&) {
      throw Error(ErrorCode::BadInput, numbered("there is no variable #", number) + " on control " +
                                           options_.profile.name);
    }
  }
  system_.on_hazard = [this](int number) {
    if (hazard_ == block_) return;
    hazard_ = block_;
    if (result_.warnings.size() >= 100) return;
    result_.warnings.push_back(place(*frames_.back().program, *block_) + ": #" +
                               std::to_string(number) +
                               " is read while a control still moves, unless a block before it "
                               "stops the look-ahead (G53, M00)");
  };
  state_.modal.O = state_.main_program = main->number;
  result_.motion.reserve(std::min(main->blocks.size(), options_.limits.moves));
  Frame frame;
  frame.program = main;
  frames_.push_back(frame);
}

void Runner::loop() {
  while (!ended_) {
    Frame& frame = frames_.back();
    if (static_cast<std::size_t>(frame.next) >= frame.program->blocks.size()) {
      if (frames_.size() == 1) break;  // end of the text: like M30
      return_from(false);
      continue;
    }
    const Block& block = frame.program->blocks[static_cast<std::size_t>(frame.next++)];
    block_ = &block;
    if (++result_.statements >= next_check_) check_limits();
    if (block.optional && options_.block_skip) continue;
    const Program* const program = frame.program;  // the frame may be gone after the step
    step(frame, block);
    if (options_.trace && result_.trace.size() < options_.limits.trace) trace(*program, block);
  }
  executor_.finish();
}

void Runner::step(Frame& frame, const Block& block) {
  if (block.label >= 0) state_.modal.N = block.label;
  switch (block.kind) {
    case BlockKind::Assign: assign(frame, block); break;
    case BlockKind::IfGoto:
      if (holds(frame, block)) jump(frame, frame.next - 1, block);
      break;
    case BlockKind::IfThen:
      if (!holds(frame, block)) frame.next = block.target;
      break;
    case BlockKind::While:
      if (!holds(frame, block)) frame.next = block.target + 1;
      break;
    case BlockKind::End: frame.next = block.target; break;
    case BlockKind::Goto: jump(frame, frame.next - 1, block); break;
    case BlockKind::Nc: nc(frame, block); break;
    case BlockKind::Call: call_macro(frame, block); break;
    case BlockKind::ModalCall: call_modal(frame, block); break;
    case BlockKind::Print: print(*frame.program, block); break;
    case BlockKind::Name: name_variables(*frame.program, block); break;
    case BlockKind::Faulty: {
      const Alarm& alarm = frame.program->alarms[static_cast<std::size_t>(block.target)];
      throw AlarmRaised(alarm.number, alarm.message, alarm.column);
    }
    case BlockKind::Do:
    case BlockKind::Empty:
    case BlockKind::Ignored: break;
  }
}

void Runner::check_limits() {
  if (result_.statements > options_.limits.steps) {
    raise(AlarmNumber::StepLimit, std::to_string(options_.limits.steps) + " blocks");
  }
  next_check_ = std::min(result_.statements + check_interval, options_.limits.steps + 1);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  if (spent.count() > options_.limits.seconds) {
    raise(AlarmNumber::TimeLimit, number_text(options_.limits.seconds) + " s");
  }
  progress_.at(0, "macro");
}

bool Runner::holds(const Frame& frame, const Block& block) const {
  return evaluate(*frame.program, block.code, variables_).number != 0;
}

// Of #[expression].
int Runner::computed_number(const Program& program, std::int32_t code, int column) const {
  const std::int64_t number = rounded_integer(evaluate(program, code, variables_).number, column);
  if (number < 0 || number > 999999999) {
    raise(AlarmNumber::VariableNumber, numbered("#", number), column);
  }
  return static_cast<int>(number);
}

void Runner::assign(const Frame& frame, const Block& block) {
  const Program& program = *frame.program;
  int number = block.variable;
  if (number < 0) number = computed_number(program, block.goto_code, block.column);
  assigned_ = number;
  const Value value = evaluate(program, block.code, variables_);
  if (number >= 1 && number <= 33) {
    variables_.write_local(number, value);
  } else if (variables_.is_common(number)) {
    variables_.write_common(number, value);
  } else {
    assign_system(program, block, number, value);
  }
}

// Room for text of the result, so that a loop cannot fill the memory.
void Runner::take_room(std::size_t bytes) {
  text_bytes_ += bytes;
  if (text_bytes_ > most_text) raise(AlarmNumber::MemoryLimit, "text of messages and DPRNT");
}

// #3000 stops with an alarm, #3006 stops with a message: both take the comment as their text.
void Runner::assign_system(const Program& program, const Block& block, int number, Value value) {
  if (number != 3000 && number != 3006) {
    variables_.write(number, value, block.column);
    return;
  }
  const std::string comment = readable(comment_text(program, block));
  if (number == 3006) {
    take_room(comment.size() + sizeof(comment));
    result_.messages.push_back(comment);
    return;
  }
  const std::int64_t user = rounded_integer(value.number, block.column);
  if (user < 0 || user > 999) {
    raise(AlarmNumber::ArgumentRange, "#3000 takes 0 to 999", block.column);
  }
  throw AlarmRaised(3000 + static_cast<int>(user), comment, block.column);
}

void Runner::jump(Frame& frame, std::int32_t from, const Block& block) {
  std::int32_t target = block.target;
  std::int64_t number = block.variable;
  if (block.goto_code >= 0) {
    const Value value = evaluate(*frame.program, block.goto_code, variables_);
    number = rounded_integer(value.number, block.column);
    if (number < 1 || number > 99999) {
      raise(AlarmNumber::GotoTarget, numbered("N", number), block.column);
    }
    target = goto_target(*frame.program, static_cast<int>(number), from);
  }
  if (target < 0) {
    raise(AlarmNumber::NumberNotFound, numbered("N", number), block.column);
  }
  if (!may_jump(*frame.program, from, target)) {
    raise(AlarmNumber::EndMissing, numbered("GOTO into a loop, N", number), block.column);
  }
  frame.next = target;
}

// DPRNT: characters as they are (* is a blank), variables with a digits before and b after the
// point.
void Runner::print(const Program& program, const Block& block) {
  std::string line;
  for (std::uint32_t i = 0; i < block.words; ++i) {
    const Word& word = program.words[block.first_word + i];
    if (word.letter != '#') {
      line += word.letter == '*' ? ' ' : word.letter;
      continue;
    }
    int number = static_cast<int>(word.number);
    if (number < 0) number = computed_number(program, word.code, word.column);
    line += printed(variables_.read(number, word.column).number, word.flags / 10, word.flags % 10);
  }
  take_room(line.size() + sizeof(line));
  result_.prints.push_back(readable(line));
}

// SETVN
void Runner::name_variables(const Program& program, const Block& block) {
  for (std::uint32_t i = 0; i < block.words; ++i) {
    const Word& word = program.words[block.first_word + i];
    variables_.set_name(block.variable + static_cast<int>(i),
                        program.names[static_cast<std::size_t>(word.number)], word.column);
  }
}

void Runner::nc(Frame& frame, const Block& block) {
  const Program& program = *frame.program;
  read_words(program, block, variables_, words_);
  if (!modal_calls_.empty() && is_each_block_call()) {
    call_each_block(program, block);
    return;
  }
  const Program* subprogram = nullptr;
  if (may_call_by_code()) {
    if (macro_by_code(frame, block)) return;
    subprogram = subprogram_by_code();
  }
  const BlockEffect effect =
      executor_.execute(words_, program.number, static_cast<int>(block.line));
  for (int i = 0; i < executor_.ended_modal_calls && !modal_calls_.empty(); ++i) {
    modal_calls_.pop_back();
  }
  if (executor_.ended_modal_calls > 0) note_modal_call();
  switch (effect.flow) {
    case BlockEffect::Flow::End: ended_ = true; break;
    case BlockEffect::Flow::Call: call_subprogram(program); break;
    case BlockEffect::Flow::Return: return_from(words_.has('P')); break;
    case BlockEffect::Flow::Next:
      if (subprogram != nullptr) {
        call_by_code(*subprogram, block.column);
      } else if (effect.moved && !modal_calls_.empty()) {
        after_move();
      }
      break;
  }
}

void Runner::trace(const Program& program, const Block& block) {
  TraceStep step;
  step.program = program.number;
  step.line = static_cast<int>(block.line);
  step.level = variables_.level();
  step.text = readable(line_text(program, block).substr(0, most_trace_text));
  step.moves = recorder_.moves();
  if (block.kind == BlockKind::Assign) {
    step.variable = assigned_;
    step.value = assigned_ > 0 && assigned_ < 1000 ? variables_.read(assigned_) : Value();
  }
  result_.trace.push_back(std::move(step));
}

void Runner::finish() {
  for (int number = 100; number <= 999; ++number) {
    if (variables_.is_common(number) && variables_.is_used(number)) {
      result_.variables[number] = variables_.common(number);
    }
  }
  while (variables_.level() > 0) variables_.close_level();
  for (int number = 1; number <= 33; ++number) {
    if (!variables_.local(number).vacant) result_.locals[number] = variables_.local(number);
  }
  Eigen::Vector3d shift = linear(shift_of(state_));
  result_.machine = recorder_.moves() > 0 ? recorder_.machine() : linear(state_.machine);
  result_.position = result_.machine - shift;
  const bool is_limit =
      result_.alarm && result_.alarm->number >= static_cast<int>(AlarmNumber::StepLimit);
  if (is_limit) shorten(result_, options_.limits.kept);
}

Result run(std::string text, const Options& options, const Progress& progress) {
  return Runner(std::move(text), options, progress).run();
}

}  // namespace ridgeline::macro
