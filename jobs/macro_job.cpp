#include "jobs/macro_job.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "core/macro/parameters.hpp"
#include "jobs/limits.hpp"

namespace ridgeline::jobs {
namespace {

constexpr int max_program_number = 99'999'999;
constexpr int max_variable = 999'999;

/// A whole number in a key, with or without '#', 'O' or leading zeros before it.
int number_in(const std::string& key, const Value& value, int max) {
  std::size_t at = 0;
  if (at < key.size() && (key[at] == '#' || key[at] == 'O' || key[at] == 'o')) ++at;
  int number = 0;
  const char* const end = key.data() + key.size();
  const auto [rest, error] = std::from_chars(key.data() + at, end, number);
  if (error != std::errc() || rest != end || number < 0 || number > max) {
    value.refuse("an object whose keys are numbers from 0 to " + std::to_string(max));
  }
  return number;
}

void read_object(const Value& value) {
  Object{value};
}

/// A name that is not a number with or without O before it, as <NAME> calls it.
bool is_program_name(const std::string& key) {
  const std::size_t at = key.starts_with('O') || key.starts_with('o') ? 1 : 0;
  const bool is_number =
      at < key.size() && key.find_first_not_of("0123456789", at) == std::string::npos;
  const bool is_name = std::ranges::all_of(key, [](unsigned char c) { return std::isgraph(c); });
  return !is_number && is_name && !key.empty() && key[0] != '#';
}

std::string upper_case(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

macro::Profile named_profile(const Value& value) {
  const std::string& name = value.name();
  if (auto profile = macro::profile(name)) return *profile;
  constexpr std::array<std::string_view, 4> names{"16i", "18i", "0i", "30i"};
  value.refuse(alternatives(names));
}

bool read_switch(const Value& value) {
  return value.json().is_boolean() ? value.boolean() : value.integer(0, 1) == 1;
}

/// The switches of a control that its parameters set.
void read_switches(Object& object, macro::Profile& profile) {
  if (const auto dpi = object.optional("dpi")) profile.calculator_point = read_switch(*dpi);
  if (const auto nat = object.optional("nat")) profile.half_turn_angles = read_switch(*nat);
}

/// {"6050": 100, "1240": [0, 0, 100], "3401#0": 1}: parameters, those of axes with a value for
/// each, or single bits of them.
void read_parameters(const Value& value, macro::Profile& profile) {
  read_object(value);
  constexpr int most_axes = 50;
  for (const auto& [key, json] : value.json().items()) {
    const Value each(json, value.pointer() + "/" + pointer_token(key));
    const std::size_t hash = key.find('#', 1);
    const int number = number_in(key.substr(0, hash), value, 99'999);
    std::vector<double>& values = profile.parameters[number];
    if (hash != std::string::npos) {
      const int bit = number_in(key.substr(hash + 1), value, 7);
      if (values.empty()) values = {0};
      constexpr int all_bits = 255;
      if (!(values.front() >= 0 && values.front() <= all_bits)) {
        each.refuse("a bit of a parameter from 0 to 255");
      }
      const int others = static_cast<int>(values.front()) & ~(1 << bit);
      values.front() = others | (read_switch(each) ? 1 << bit : 0);
    } else if (json.is_array()) {
      values.clear();
      for (const Value& axis : each.array(1, most_axes)) values.push_back(axis.number());
    } else {
      values = {each.number()};
    }
  }
  macro::apply_parameters(profile);
}

macro::Profile read_profile(const Value& value) {
  if (value.json().is_string()) return named_profile(value);
  Object object(value);
  macro::Profile profile;
  if (const auto name = object.optional("name")) profile = named_profile(*name);
  read_switches(object, profile);
  profile.literal_digits = object.integer("digits", 6, 17, profile.literal_digits);
  profile.mantissa_bits = object.integer("mantissa_bits", 0, 53, profile.mantissa_bits);
  profile.subprogram_levels = object.integer("subprogram_levels", 1, 20, profile.subprogram_levels);
  profile.macro_levels = object.integer("macro_levels", 1, 20, profile.macro_levels);
  profile.brackets = object.integer("brackets", 1, 15, profile.brackets);
  profile.condition_logic = object.boolean("condition_logic", profile.condition_logic);
  profile.power_functions = object.boolean("power_functions", profile.power_functions);
  constexpr Choices<macro::OffsetMemory, 3> memories{{{"A", macro::OffsetMemory::A},
                                                      {"B", macro::OffsetMemory::B},
                                                      {"C", macro::OffsetMemory::C}}};
  profile.offset_memory = object.choice("offset_memory", memories, profile.offset_memory);
  profile.increment = object.number("increment", between(1e-6, 0.01, "mm"), profile.increment);
  profile.inch_increment =
      object.number("inch_increment", between(1e-7, 0.001, "inch"), profile.inch_increment);
  profile.arc_tolerance =
      object.number("arc_tolerance", between(0, 1000, "mm"), profile.arc_tolerance);
  profile.interference_check = object.boolean("interference_check", profile.interference_check);
  profile.blind_blocks = object.integer("blind_blocks", 1, 8, profile.blind_blocks);
  profile.rapid = object.number("rapid", above(0, 1e7, "mm/min"), profile.rapid);
  if (const auto references = object.optional("references")) {
    const std::vector<Value> points = references->array(1, 4);
    for (std::size_t i = 0; i < points.size(); ++i) {
      profile.references[i] = points[i].vector3(coordinate_range);
    }
  }
  if (const auto parameters = object.optional("parameters")) read_parameters(*parameters, profile);
  object.finish();
  return profile;
}

void read_variables(const Value& value, std::map<int, macro::Value>& set) {
  for (const auto& [key, number] : value.json().items()) {
    const int variable = number_in(key, value, max_variable);
    const Value each(number, value.pointer() + "/" + pointer_token(key));
    set[variable] = each.is_null() ? macro::Value() : macro::Value(each.number_or_text());
  }
}

// {"54": [x, y, z], ...}: work offsets by their G codes.
void read_work_offsets(const Value& value, std::map<int, macro::Value>& set) {
  for (const auto& [key, offset] : value.json().items()) {
    const std::string digits = key.starts_with('G') ? key.substr(1) : key;
    const int code = number_in(digits, value, 59);
    if (code < 54) value.refuse("an object whose keys are 54 to 59");
    const Value each(offset, value.pointer() + "/" + pointer_token(key));
    const Eigen::Vector3d at = each.vector3(coordinate_range);
    for (int axis = 0; axis < 3; ++axis) set[5221 + 20 * (code - 54) + axis] = at[axis];
  }
}

// {"1": {"D": radius, "H": length}} or {"D1": radius, "H1": length}: offset registers.
void read_tools(const Value& value, const macro::Profile& profile,
                std::map<int, macro::Value>& set) {
  const bool is_split = profile.offset_memory == macro::OffsetMemory::C;
  const int length = profile.offset_memory == macro::OffsetMemory::A ? 10000 : 11000;
  const int radius = is_split ? 13000 : length;
  for (const auto& [key, json] : value.json().items()) {
    const Value each(json, value.pointer() + "/" + pointer_token(key));
    if (json.is_object()) {
      const int number = number_in(key, value, 400);
      Object tool(each);
      for (const char* name : {"D", "d", "radius"}) {
        if (const auto D = tool.optional(name)) {
          set[radius + number] = D->number_or_text(coordinate_range);
        }
      }
      for (const char* name : {"H", "h", "length"}) {
        if (const auto H = tool.optional(name)) {
          set[length + number] = H->number_or_text(coordinate_range);
        }
      }
      tool.finish();
    } else {
      const bool is_length = key.starts_with('H') || key.starts_with('h');
      const bool is_radius = key.starts_with('D') || key.starts_with('d');
      const int number = number_in(is_length || is_radius ? key.substr(1) : key, value, 400);
      set[(is_length ? length : radius) + number] = each.number_or_text(coordinate_range);
    }
  }
}

}  // namespace

MacroJob read_macro_job(Object& job) {
  MacroJob read;
  constexpr Choices<MacroJob::Operation, 2> operations{
      {{"run", MacroJob::Operation::Run}, {"check", MacroJob::Operation::Check}}};
  read.operation = job.choice("operation", operations, MacroJob::Operation::Run);
  read.program = job.required("program").string();
  if (const auto programs = job.optional("programs")) {
    read_object(*programs);
    for (const auto& [key, text] : programs->json().items()) {
      std::string source = Value(text, programs->pointer() + "/" + pointer_token(key)).string();
      if (is_program_name(key)) {
        read.named_programs[upper_case(key)] = std::move(source);
      } else {
        read.programs[number_in(key, *programs, max_program_number)] = std::move(source);
      }
    }
  }
  macro::Options& options = read.options;
  if (const auto profile = job.optional("profile")) options.profile = read_profile(*profile);
  if (const auto switches = job.optional("opts"); switches && !switches->is_null()) {
    Object object(*switches);
    read_switches(object, options.profile);
    object.finish();
  }
  if (const auto offsets = job.optional("wcs"); offsets && !offsets->is_null()) {
    read_object(*offsets);
    read_work_offsets(*offsets, options.set);
  }
  if (const auto tools = job.optional("tools"); tools && !tools->is_null()) {
    read_object(*tools);
    read_tools(*tools, options.profile, options.set);
  }
  if (const auto set = job.optional("set"); set && !set->is_null()) {
    read_object(*set);
    read_variables(*set, options.set);
  }
  if (const auto number = job.optional("main")) {
    options.program = number->integer(0, max_program_number);
  }
  options.block_skip = job.boolean("block_skip", false);
  options.trace = job.boolean("trace", false);
  read.decimals = job.integer("decimals", 1, 6, 4);
  if (const auto limits = job.optional("limits")) {
    Object object(*limits);
    macro::Limits& most = options.limits;
    most.steps = static_cast<std::uint64_t>(
        object.number("steps", between(1, 1e12, "blocks"), static_cast<double>(most.steps)));
    most.seconds = object.number("seconds", above(0, 86400, "s"), most.seconds);
    most.moves = static_cast<std::size_t>(
        object.number("moves", between(0, 1e8, "moves"), static_cast<double>(most.moves)));
    most.kept = static_cast<std::size_t>(
        object.number("kept", between(0, 1e8, "moves"), static_cast<double>(most.kept)));
    object.finish();
  }
  return read;
}

std::function<std::optional<std::string>(int)> library_of(const MacroJob& job) {
  return [&job](int number) -> std::optional<std::string> {
    const auto found = job.programs.find(number);
    if (found == job.programs.end()) return std::nullopt;
    return found->second;
  };
}

std::function<std::optional<std::string>(const std::string&)> named_library_of(
    const MacroJob& job) {
  return [&job](const std::string& name) -> std::optional<std::string> {
    const auto found = job.named_programs.find(name);
    if (found == job.named_programs.end()) return std::nullopt;
    return found->second;
  };
}

}  // namespace ridgeline::jobs
