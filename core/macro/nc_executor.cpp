#include "core/macro/nc_executor.hpp"
#include "core/macro/text.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/macro/system_variables.hpp"

namespace ridgeline::macro {

namespace {

std::string code_text(char letter, double value) {
  return letter + number_text(value);
}

// G codes of group 00 and others that use the axis words themselves.
bool takes_axis_words(int code) {
  switch (code) {
    case 40:
    case 51:
    case 100:
    case 270:
    case 280:
    case 290:
    case 300:
    case 310:
    case 500:
    case 510:
    case 501:
    case 511:
    case 520:
    case 530:
    case 600:
    case 680:
    case 920:
    case 921: return true;
    default: return false;
  }
}

// Look-ahead, smoothing and stroke checks: nothing to simulate.
bool is_without_effect(int code) {
  return code == 50 || code == 80 || code == 90 || code == 250 || code == 260;
}

bool is_after_move(int m) {
  return m == 0 || m == 1 || m == 2 || m == 5 || m == 9 || m == 30;
}

}  // namespace

BlockEffect NcExecutor::execute(const NcWords& words, int program, int line) {
  words_ = &words;
  program_ = program;
  line_ = line;
  moved_ = false;
  one_shot_ = 0;
  switches_compensation_ = false;
  ended_modal_calls = 0;
  BlockEffect effect;
  if (setting_parameters_) {
    setting_parameters_ = !words.has_g(110);
    return effect;
  }
  for (int i = 0; i < words.g_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    apply_g(words.g[k], words.g_column[k]);
  }
  functions_before_move();
  if (!run_special()) {
    const int length_code = words.has_g(430)   ? 430
                            : words.has_g(440) ? 440
                            : words.has_g(490) ? 490
                                               : 0;
    const bool is_length = words.has('H') && !words.has_m(98);  // of M98 it is a sequence number
    if (length_code != 0 || (is_length && state_.modal.length != 490)) {
      apply_length(state_.modal.length);
    }
    const bool is_cycle = state_.modal.canned != 800;
    if (has_axis_word() || (is_cycle && words.has('R'))) {
      if (is_cycle) {
        canned_cycle();
      } else {
        const Axes to = target();
        if (state_.modal.motion == 20 || state_.modal.motion == 30) {
          arc(to);
        } else {
          straight(state_.modal.motion == 0 ? MoveKind::Rapid : MoveKind::Line, to);
        }
      }
    } else if ((state_.modal.motion == 20 || state_.modal.motion == 30) &&
               state_.modal.canned == 800 && (words.has('I') || words.has('J') || words.has('K'))) {
      arc(state_.position);  // a full circle needs no end
    } else if (length_code != 0) {
      straight(state_.modal.motion == 0 ? MoveKind::Rapid : MoveKind::Line, state_.position);
    }
  }
  effect.moved = moved_;
  functions_after_move(effect);
  return effect;
}

void NcExecutor::execute_modes(const NcWords& words) {
  words_ = &words;
  for (int i = 0; i < words.g_count; ++i) apply_modal(words.g[static_cast<std::size_t>(i)]);
}

void NcExecutor::finish() {
  corner_break_.flush();
  compensation_.flush();
}

void NcExecutor::apply_g(int code, int column) {
  if (takes_axis_words(code)) {
    one_shot_ = code;
    if (code == 680) state_.modal.rotation = code;
    return;
  }
  if (apply_modal(code) || is_without_effect(code)) return;
  raise(AlarmNumber::ImproperGCode,
        numbered("G", code / 10) + (code % 10 != 0 ? numbered(".", code % 10) : ""), column);
}

bool NcExecutor::apply_modal(int code) {
  Modal& modal = state_.modal;
  if (code == 842 || code == 843) code = code == 842 ? 840 : 740;  // rigid tapping as 15i has it
  switch (code) {
    case 0:
    case 10:
    case 20:
    case 30:
    case 330: set_motion(code); return true;
    case 150:
    case 160:
      if (code == 160 && modal.polar == 150) state_.polar = state_.pole = Eigen::Vector2d::Zero();
      modal.polar = code;
      return true;
    case 170:
    case 180:
    case 190: select_plane(code); return true;
    case 200:
    case 210: select_units(code); return true;
    case 220:
    case 230:
      if (code == 220) one_shot_ = code;  // its words are the forbidden space
      modal.stroke = code;
      return true;
    case 400:
    case 410:
    case 420:
      switches_compensation_ = (modal.compensation == 400) != (code == 400);
      modal.compensation = code;
      return true;
    case 430:
    case 440:
    case 490: modal.length = code; return true;
    case 540:
    case 550:
    case 560:
    case 570:
    case 580:
    case 590:
    case 541: select_work_offset(code); return true;
    case 610:
    case 620:
    case 630:
    case 640: modal.cutting_mode = code; return true;
    case 670: ++ended_modal_calls; return true;
    case 690: rotation_off(); return true;
    case 730:
    case 740:
    case 760:
    case 800:
    case 810:
    case 820:
    case 830:
    case 840:
    case 850:
    case 860:
    case 870:
    case 880:
    case 890:
      if (code == 800 || modal.canned == 800) cycle_.is_set = false;
      modal.canned = code;
      return true;
    case 900:
    case 910: modal.distance = code; return true;
    case 930:
    case 940:
    case 950: modal.feed_mode = code; return true;
    case 960:
    case 970: modal.surface_speed = code; return true;
    case 980:
    case 990: modal.return_level = code; return true;
    case 110: return true;
    default: return false;
  }
}

void NcExecutor::set_motion(int code) {
  state_.modal.motion = code;
  state_.modal.canned = 800;  // a code of group 01 ends a drilling cycle
}

void NcExecutor::select_plane(int code) {
  if (code != state_.modal.plane && compensation_.is_active()) {
    raise(AlarmNumber::PlaneChangedInCompensation);
  }
  if (code != state_.modal.plane && state_.rotation.is_active) {
    raise(AlarmNumber::PlaneMismatch, "plane change while G68 is active");
  }
  state_.modal.plane = code;
}

void NcExecutor::select_units(int code) {
  state_.modal.units = code;
  function(code_text('G', code / 10));
}

// G54 P_ is G54.1 P_, unless another code of the block takes the P.
bool NcExecutor::is_additional_offset() const {
  if (!words_->has('P') || words_->m_count > 0 || state_.modal.canned != 800) return false;
  for (int i = 0; i < words_->g_count; ++i) {
    const int code = words_->g[static_cast<std::size_t>(i)];
    if (takes_axis_words(code) || is_without_effect(code) || (code >= 730 && code <= 890)) {
      return false;
    }
  }
  return true;
}

void NcExecutor::select_work_offset(int code) {
  if (code == 540 && is_additional_offset()) code = 541;
  int index = code / 10 - 53;
  std::string word = code_text('G', code / 10);
  if (code == 541) {
    const double number = words_->has('P') ? (*words_)['P'] : 1;
    if (!(number >= 1 && number <= 300)) {
      raise(AlarmNumber::ArgumentRange, "G54.1 P1 to P300", words_->column_of('P'));
    }
    state_.modal.P = static_cast<int>(std::lround(number));
    index = 6 + state_.modal.P;
    word = numbered("G54.1P", state_.modal.P);
  }
  state_.modal.work_offset = code;
  if (index == state_.work_offset) return;
  state_.work_offset = index;
  follow_machine(state_);
  function(word);
}

void NcExecutor::apply_length(int code) {
  if (words_->has('H')) {
    const std::int64_t number = rounded_integer((*words_)['H'], words_->column_of('H'));
    if (number < 0 || number >= Offsets::registers) {
      raise(AlarmNumber::IllegalOffsetNumber, "H", words_->column_of('H'));
    }
    state_.modal.H = static_cast<int>(number);
  }
  const double length = length_offset(state_, code == 490 ? 0 : state_.modal.H);
  state_.length = code == 440 ? -length : length;
}

void NcExecutor::functions_before_move() {
  const NcWords& words = *words_;
  Modal& modal = state_.modal;
  if (words.has('F')) modal.F = words['F'];
  if (words.has('E')) modal.E = words['E'];
  if (words.has('B')) modal.B = words['B'];
  if (words.has('D')) {
    const std::int64_t number = rounded_integer(words['D'], words.column_of('D'));
    if (number < 0 || number >= Offsets::registers) {
      raise(AlarmNumber::IllegalOffsetNumber, "D", words.column_of('D'));
    }
    modal.D = static_cast<int>(number);
  }
  const bool is_speed_limit = one_shot_ == 920 || one_shot_ == 500;
  if (words.has('S') && !is_speed_limit) {
    modal.S = words['S'];
    result_.spindle_speed = modal.S;
    function(code_text('S', words['S']));
  }
  if (words.has('T')) {
    modal.T = static_cast<int>(rounded_integer(words['T'], words.column_of('T')));
    if (state_.spindle_tool < 0) result_.tool = modal.T;
    function(numbered("T", modal.T));
  }
  for (int i = 0; i < words.m_count; ++i) {
    const int m = words.m[static_cast<std::size_t>(i)];
    if (m == 98 || m == 99 || m == 198 || is_after_move(m)) continue;
    modal.M = m;
    if (m == 6) result_.tool = state_.spindle_tool = modal.T;
    function(numbered("M", m));
  }
}

void NcExecutor::functions_after_move(BlockEffect& effect) {
  for (int i = 0; i < words_->m_count; ++i) {
    const int m = words_->m[static_cast<std::size_t>(i)];
    if (m == 98 || m == 198) effect.flow = BlockEffect::Flow::Call;
    if (m == 99) effect.flow = BlockEffect::Flow::Return;
    if (!is_after_move(m)) continue;
    state_.modal.M = m;
    if (m == 2 || m == 30) {
      effect.flow = BlockEffect::Flow::End;
      finish();
    }
    function(numbered("M", m));
  }
}

void NcExecutor::function(const std::string& word) {
  corner_break_.event(word, program_, line_, !has_axis_word());
}

bool NcExecutor::has_axis_word() const {
  constexpr std::uint64_t axes = [] {
    std::uint64_t bits = 0;
    for (const char letter : {'X', 'Y', 'Z', 'A', 'B', 'C', 'U', 'V', 'W'}) {
      bits |= std::uint64_t{1} << NcWords::slot(letter);
    }
    return bits;
  }();
  return (words_->present & axes) != 0;
}

// True when the block's axis words are used up.
bool NcExecutor::run_special() {
  switch (one_shot_) {
    case 0: return false;
    case 40: dwell(); return true;
    case 51:  // the axes of a smooth path, not where to go
    case 220: return true;
    case 100: set_data(); return true;
    case 270: reference_check(); return true;
    case 280:
    case 300: reference_return(one_shot_); return true;
    case 290: from_reference(); return true;
    case 310: skip_move(); return true;
    case 500:
      state_.scaling.is_active = false;
      state_.modal.scaling = 500;
      break;
    case 510: scaling_on(); return true;
    case 501:
    case 511: mirror(one_shot_ == 511); return true;
    case 520: local_system(); return true;
    case 530: machine_move(); return true;
    case 600: straight(MoveKind::Rapid, target()); return true;
    case 680: rotation_on(); return true;
    case 920: preset_system(); return true;
    case 921: preset_system_off(); return true;
    default: break;
  }
  follow_machine(state_);
  return false;
}

// X, U in seconds (increments of 1 ms without a point), P in milliseconds.
void NcExecutor::dwell() {
  const NcWords& words = *words_;
  double seconds = 0;
  for (const char letter : {'X', 'U'}) {
    if (words.has(letter)) seconds = words.is_scaled(letter) ? words[letter] / 1000 : words[letter];
  }
  if (words.has('P')) seconds = words['P'] / 1000;
  if (!(seconds >= 0)) raise(AlarmNumber::ImproperCommand, "a dwell cannot be negative");
  Segment wait = segment(MoveKind::Dwell);
  wait.to = wait.from;
  wait.seconds = seconds;
  send(wait);
}

}  // namespace ridgeline::macro
