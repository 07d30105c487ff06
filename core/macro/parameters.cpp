#include "core/macro/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/macro/alarm.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {
namespace {

[[noreturn]] void refuse(std::int64_t number, const std::string& what, int column) {
  raise(AlarmNumber::ArgumentRange, numbered("parameter ", number) + ": " + what, column);
}

/// Parameters that are 0 on every control that nobody changed, and that this control knows.
bool is_known(std::int64_t number) {
  return (number >= 6000 && number <= 6010) || (number >= 6036 && number <= 6095) ||
         number == 3401 || number == 3402;
}

/// Of a member of the profile, where no parameter was given.
std::optional<double> from_profile(const Profile& profile, std::int64_t number, std::int64_t axis) {
  if (number == 3401) return profile.calculator_point ? 1 : 0;
  if (number == 6004) return profile.half_turn_angles ? 1 : 0;
  if (number == 6006) return profile.condition_logic ? 1 : 0;
  if (number == 3410) return profile.arc_tolerance;
  if (number >= 1240 && number <= 1243 && axis <= 3) {
    return profile.references[static_cast<std::size_t>(number - 1240)][axis - 1];
  }
  return is_known(number) ? std::optional(0.0) : std::nullopt;
}

int whole(const Profile& profile, int number, int low, int high) {
  const auto found = profile.parameters.find(number);
  if (found == profile.parameters.end()) return 0;
  const double value = found->second.front();
  if (!(value >= low && value <= high) || value != std::floor(value)) {
    const std::string limit =
        "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    throw Error(
        ErrorCode::BadInput,
        numbered("parameter ", number) + " is " + number_text(value) + "; it must be " + limit,
        {.field = numbered("/profile/parameters/", number),
         .value = number_text(value),
         .limit = limit});
  }
  return static_cast<int>(value);
}

std::optional<bool> bit(const Profile& profile, int number, int place) {
  if (!profile.parameters.contains(number)) return std::nullopt;
  return (whole(profile, number, 0, 255) >> place & 1) != 0;
}

/// Codes from the first on that call programs from the first on: three parameters.
void add_range(const Profile& profile, int parameter, int scale, std::map<int, int>& calls) {
  const int first = whole(profile, parameter, -9999, 99999999);
  const int program = whole(profile, parameter + 1, 0, 9999);
  const int count = whole(profile, parameter + 2, 0, 255);
  for (int i = 0; i < count; ++i) calls[std::abs(first) * scale + i * scale] = program + i;
}

CodeCalls code_calls(const Profile& profile) {
  CodeCalls calls;
  constexpr int last_g = 9999, last_m = 99999999, tenths = 10;
  add_range(profile, 6038, tenths, calls.g_macros);
  add_range(profile, 6041, 1, calls.g_macros);
  add_range(profile, 6044, 1, calls.m_subprograms);
  add_range(profile, 6047, 1, calls.m_macros);
  for (int i = 0; i < 10; ++i) {
    const int g = whole(profile, 6050 + i, -last_g, last_g);
    if (g > 0) calls.g_macros[g * tenths] = 9010 + i;
    if (g < 0) calls.g_modal_macros[-g * tenths] = 9010 + i;
    if (const int m = whole(profile, 6080 + i, 0, last_m); m > 0) calls.m_macros[m] = 9020 + i;
    if (i == 0) continue;
    if (const int m = whole(profile, 6070 + i, 0, last_m); m > 0) calls.m_subprograms[m] = 9000 + i;
  }
  calls.t_subprogram = bit(profile, 6001, 5).value_or(false);
  return calls;
}

}  // namespace

double parameter(const Profile& profile, const ParameterPlace& place, int column) {
  const std::int64_t number = place.number, axis = place.axis.value_or(1);
  const std::int64_t bit_number = place.bit.value_or(0);
  if (bit_number < 0 || bit_number > 7) refuse(number, "bit 0 to 7", column);
  if (axis < 1 || axis > 50) refuse(number, "axis 1 to 50", column);
  std::optional<double> value;
  const auto given = number > 0 && number <= 99999
                         ? profile.parameters.find(static_cast<int>(number))
                         : profile.parameters.end();
  if (given != profile.parameters.end()) {
    const std::vector<double>& values = given->second;
    if (static_cast<std::size_t>(axis) <= values.size()) {
      value = values[static_cast<std::size_t>(axis - 1)];
    }
  } else {
    value = from_profile(profile, number, axis);
  }
  if (!value) refuse(number, "has no value here: give it to the control", column);
  if (!place.bit) return *value;
  return static_cast<double>(std::llround(*value) >> bit_number & 1);
}

void apply_parameters(Profile& profile) {
  if (const auto dpi = bit(profile, 3401, 0)) profile.calculator_point = *dpi;
  if (const auto nat = bit(profile, 6004, 0)) profile.half_turn_angles = *nat;
  if (const auto logic = bit(profile, 6006, 0)) profile.condition_logic = *logic;
  if (const auto arc = profile.parameters.find(3410); arc != profile.parameters.end()) {
    profile.arc_tolerance = arc->second.front();
  }
  for (int i = 0; i < 4; ++i) {
    const auto point = profile.parameters.find(1240 + i);
    if (point == profile.parameters.end()) continue;
    for (std::size_t axis = 0; axis < std::min<std::size_t>(3, point->second.size()); ++axis) {
      profile.references[static_cast<std::size_t>(i)][static_cast<int>(axis)] = point->second[axis];
    }
  }
  profile.calls = code_calls(profile);
}

}  // namespace ridgeline::macro
