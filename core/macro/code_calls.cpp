#include <algorithm>
#include <optional>
#include <utility>

#include "core/macro/runner.hpp"

namespace ridgeline::macro {
namespace {

constexpr int t_program = 9000;    ///< of T codes
constexpr int t_variable = 149;    ///< that tells it the T code
constexpr double half_code = .05;  ///< G codes in tenths compare within this

std::optional<int> program_of(const std::map<int, int>& calls, int code) {
  const auto found = calls.find(code);
  return found == calls.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

// Within a program that a code called, these codes are what they are elsewhere.
bool Runner::may_call_by_code() const {
  return !options_.profile.calls.is_empty() &&
         std::none_of(frames_.begin(), frames_.end(),
                      [](const Frame& frame) { return frame.is_by_code; });
}

// A G code calls like G65 (a negative parameter: like G66), an M code when the block begins with
// it. Nothing else of the block is done.
bool Runner::macro_by_code(Frame& frame, const Block& block) {
  const CodeCalls& calls = options_.profile.calls;
  std::optional<int> program;
  char letter = 'G';
  double code = 0;
  bool is_modal = false;
  for (int i = 0; i < words_.g_count && !program; ++i) {
    const int tenths = words_.g[static_cast<std::size_t>(i)];
    program = program_of(calls.g_macros, tenths);
    is_modal = !program && calls.g_modal_macros.contains(tenths);
    if (is_modal) program = calls.g_modal_macros.at(tenths);
    code = tenths / 10.0;
  }
  const bool begins_with_m =
      block.words > 0 && frame.program->words[block.first_word].letter == 'M';
  if (!program && begins_with_m && words_.m_count > 0) {
    letter = 'M';
    code = words_.m[0];
    program = program_of(calls.m_macros, words_.m[0]);
  }
  if (!program) return false;
  Call call = read_call(*frame.program, block, letter, code - half_code, code + half_code);
  const Program& called = find(*program, block.column);
  if (is_modal) {
    add_modal(called, call, block.column);
    return true;
  }
  Frame next;
  next.kind = FrameKind::Macro;
  next.program = &called;
  next.repeats = call.repeats;
  next.arguments = call.arguments;
  next.is_by_code = true;
  push(next, block.column);
  return true;
}

// An M code or T calls its program after the rest of the block; neither goes to the machine.
const Program* Runner::subprogram_by_code() {
  const CodeCalls& calls = options_.profile.calls;
  for (int i = 0; i < words_.m_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const std::optional<int> program = program_of(calls.m_subprograms, words_.m[k]);
    if (!program) continue;
    std::move(words_.m.begin() + i + 1, words_.m.begin() + words_.m_count, words_.m.begin() + i);
    --words_.m_count;
    return &find(*program, block_->column);
  }
  if (!calls.t_subprogram || !words_.has('T')) return nullptr;
  variables_.write(t_variable, words_['T'], words_.column_of('T'));
  words_.present &= ~(std::uint64_t{1} << NcWords::slot('T'));
  return &find(t_program, block_->column);
}

void Runner::call_by_code(const Program& called, int column) {
  Frame next;
  next.kind = FrameKind::Subprogram;
  next.program = &called;
  next.is_by_code = true;
  if (words_.has('L')) next.repeats = rounded_integer(words_['L'], words_.column_of('L'));
  push(next, column);
}

}  // namespace ridgeline::macro
