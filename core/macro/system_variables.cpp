#include "core/macro/system_variables.hpp"
#include "core/macro/text.hpp"

#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>
#include <string>

namespace ridgeline::macro {

namespace {

// A macro statement takes about this long on a control, so that waiting loops end [ms].
constexpr double statement_time = 1;

bool is_plain(int number) {
  const auto in = [number](int first, int last) { return number >= first && number <= last; };
  return in(1000, 1035) || in(1100, 1135) || in(3003, 3005) || in(3007, 3008) || in(3901, 3902);
}
bool is_input(int number) {
  return number >= 1000 && number <= 1035;
}

std::tm local_time() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm time{};
  localtime_r(&now, &time);
  return time;
}

// Numbers of controls with more than 20 axes, 50 to a kind, as those with 20: #100001 is #5001,
// #100301 is #5201 and #101001 is #14001.
int short_number(int number) {
  constexpr int wide = 50, narrow = 20;
  const auto at = [number](int first, int count, int other) {
    const int kind = (number - first) / wide, axis = (number - first) % wide;
    const bool is_there = number >= first && kind < count && axis < narrow;
    return is_there ? other + kind * narrow + axis : 0;
  };
  for (const int found : {at(100001, 5, 5001), at(100301, 7, 5201), at(101001, 300, 14001)}) {
    if (found != 0) return found;
  }
  return number;
}

[[noreturn]] void unknown(int number) {
  raise(AlarmNumber::VariableNumber, numbered("#", number));
}

void check_offset_number(int number) {
  if (number < 0 || number >= Offsets::registers) {
    raise(AlarmNumber::IllegalOffsetNumber, std::to_string(number));
  }
}

}  // namespace

double radius_offset(const State& state, int number) {
  check_offset_number(number);
  if (number == 0) return 0;
  const auto i = static_cast<std::size_t>(number);
  const Offsets& offsets = state.offsets;
  if (state.profile.offset_memory == OffsetMemory::C) {
    return offsets.radius_geometry[i] + offsets.radius_wear[i];
  }
  return offsets.length_geometry[i] + offsets.length_wear[i];
}

double length_offset(const State& state, int number) {
  check_offset_number(number);
  if (number == 0) return 0;
  const auto i = static_cast<std::size_t>(number);
  return state.offsets.length_geometry[i] + state.offsets.length_wear[i];
}

Value ControlVariables::read(int number) {
  if (is_plain(number)) {
    const auto stored = state_.plain.find(number);
    return stored == state_.plain.end() ? 0.0 : stored->second;
  }
  if (number == 3000 || number == 3006) return 0.0;
  if (number == 3001 || number == 3002) {
    if (on_hazard) on_hazard(number);
    return number == 3001 ? milliseconds() - timer_zero_ : milliseconds() / 3.6e6 - hours_zero_;
  }
  if (number == 3011 || number == 3012) {
    const std::tm time = local_time();
    if (number == 3012) return time.tm_hour * 10000.0 + time.tm_min * 100 + time.tm_sec;
    return (time.tm_year + 1900) * 10000.0 + (time.tm_mon + 1) * 100 + time.tm_mday;
  }
  if (number == 3100) return {};
  if (number == 3101) return std::numbers::pi;
  if (number == 3102) return std::numbers::e;
  if (number == 4000) return static_cast<double>(state_.main_program);
  if (number > 4000 && number < 4600) return modal(number % 200);
  number = short_number(number);
  if (number > 5000 && number < 5200) return position(number);
  if (const double* value = offset(number)) return *value / unit(state_);
  if (const double* value = work_offset(number)) return *value / unit(state_);
  unknown(number);
}

void ControlVariables::write(int number, Value value) {
  number = short_number(number);
  if ((number >= 3100 && number <= 3102) || number == 4000 || is_input(number) || number == 3011 ||
      number == 3012 || number == 3007 || number == 3008 || (number > 4000 && number < 4600) ||
      (number > 5000 && number < 5200)) {
    read(number);  // 115 before 116
    raise(AlarmNumber::WriteProtected, numbered("#", number));
  }
  preset(number, value);
}

void ControlVariables::preset(int number, Value value) {
  result_.variables[number] = value;
  if (is_plain(number)) {
    state_.plain[number] = value.number;
  } else if (number == 3001) {
    timer_zero_ = milliseconds() - value.number;
  } else if (number == 3002) {
    hours_zero_ = milliseconds() / 3.6e6 - value.number;
  } else if (number > 5060 && number <= 5060 + axis_count) {
    state_.skip[static_cast<std::size_t>(number - 5061)] = value.number * unit(state_);
  } else if (number == 4120) {
    state_.modal.T = static_cast<int>(rounded_integer(value.number, 0));
  } else if (double* length = offset(number)) {
    *length = value.number * unit(state_);
  } else if (double* coordinate = work_offset(number)) {
    *coordinate = value.number * unit(state_);
    follow_machine(state_);
  } else {
    result_.variables.erase(number);
    unknown(number);
  }
}

Value ControlVariables::modal(int number) const {
  const Modal& modal = state_.modal;
  const auto code = [](int tenths) { return Value(tenths / 10.0); };
  switch (number) {
    case 1: return code(modal.motion);
    case 2: return code(modal.plane);
    case 3: return code(modal.distance);
    case 4: return code(modal.stroke);
    case 5: return code(modal.feed_mode);
    case 6: return code(modal.units);
    case 7: return code(modal.compensation);
    case 8: return code(modal.length);
    case 9: return code(modal.canned);
    case 10: return code(modal.return_level);
    case 11: return code(modal.scaling);
    case 12: return code(modal.modal_call);
    case 13: return code(modal.surface_speed);
    case 14: return code(modal.work_offset);
    case 15: return code(modal.cutting_mode);
    case 16: return code(modal.rotation);
    case 17: return code(modal.polar);
    case 22: return code(modal.mirror);
    case 102: return modal.B;
    case 107: return static_cast<double>(modal.D);
    case 108: return modal.E;
    case 109: return modal.F;
    case 111: return static_cast<double>(modal.H);
    case 113: return static_cast<double>(modal.M);
    case 114: return static_cast<double>(modal.N);
    case 115: return static_cast<double>(modal.O);
    case 119: return modal.S;
    case 120: return static_cast<double>(modal.T);
    case 130: return static_cast<double>(modal.P);
    default: break;
  }
  if (number >= 1 && number <= 30) return 0.0;  // groups that no milling code here belongs to
  unknown(4000 + number);
}

// #5001 block end, #5021 machine, #5041 present, #5061 skip, #5081 tool offset; 0 offline:
// #5101 servo deviation, #5121 handle interruption, #5181 distance to go.
Value ControlVariables::position(int number) {
  const int kind = (number - 5001) / 20;
  const int axis = (number - 5001) % 20;
  if (axis >= axis_count || kind == 7 || kind == 8) unknown(number);
  const auto i = static_cast<std::size_t>(axis);
  const double scale = is_rotary(axis) ? 1 : unit(state_);
  if ((kind == 1 || kind == 2) && on_hazard) on_hazard(number);
  switch (kind) {
    case 0: return state_.position[i] / scale;
    case 1: return state_.machine[i] / scale;
    case 2: {
      Axes shift = shift_of(state_);
      shift[2] -= state_.length;
      return (state_.machine[i] - shift[i]) / scale;
    }
    case 3: return state_.skip[i] / scale;
    case 4: return axis == 2 ? state_.length / scale : 0.0;
    default: return 0.0;
  }
}

double* ControlVariables::offset(int number) {
  const OffsetMemory memory = state_.profile.offset_memory;
  Offsets& offsets = state_.offsets;
  const auto in = [number](int first, std::vector<double>& values, int count) -> double* {
    const int index = number - first;
    if (index < 1 || index > count) return nullptr;
    return &values[static_cast<std::size_t>(index)];
  };
  constexpr int all = Offsets::registers - 1;
  std::vector<double>& wear =
      memory == OffsetMemory::A ? offsets.length_geometry : offsets.length_wear;
  if (double* value = in(2000, wear, 200)) return value;
  if (double* value = in(10000, wear, all)) return value;
  if (memory == OffsetMemory::A) return nullptr;
  if (double* value = in(2200, offsets.length_geometry, 200)) return value;
  if (double* value = in(11000, offsets.length_geometry, all)) return value;
  if (memory == OffsetMemory::B) return nullptr;
  if (double* value = in(12000, offsets.radius_wear, all)) return value;
  return in(13000, offsets.radius_geometry, all);
}

// #5201.. external, #5221.. G54 in steps of 20; #7001.. and #14001.. G54.1; #2500 + 100 axis.
double* ControlVariables::work_offset(int number) {
  const auto at = [this](int set, int axis) -> double* {
    if (axis >= axis_count) return nullptr;
    return &state_.offsets.work[static_cast<std::size_t>(set)][static_cast<std::size_t>(axis)];
  };
  if (number >= 5201 && number <= 5340) return at((number - 5201) / 20, (number - 5201) % 20);
  if (number >= 7001 && number <= 7960) return at(7 + (number - 7001) / 20, (number - 7001) % 20);
  if (number >= 14001 && number <= 20000) {
    return at(7 + (number - 14001) / 20, (number - 14001) % 20);
  }
  if (number >= 2500 && number < 2900 && number % 100 <= 6) {
    return at(number % 100, (number - 2500) / 100);
  }
  return nullptr;
}

double ControlVariables::milliseconds() const {
  return result_.seconds * 1000 + static_cast<double>(result_.statements) * statement_time;
}

}  // namespace ridgeline::macro
