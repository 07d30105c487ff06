#include "core/macro/variables.hpp"

#include <algorithm>
#include <string>

#include "core/macro/text.hpp"

namespace ridgeline::macro {

Value Variables::read(int number, int column) const {
  if (number >= 1 && number <= 33) return local(number);
  if (is_common(number)) return common(number);
  if (number == 0) return {};
  try {
    return system_.read(number);
  } catch (AlarmRaised& raised) {
    raised.alarm.column = column;
    throw;
  }
}

void Variables::write(int number, Value value, int column) {
  if (number >= 1 && number <= 33) {
    write_local(number, value);
  } else if (is_common(number)) {
    write_common(number, value);
  } else if (number == 0) {
    raise(AlarmNumber::WriteProtected, "#0", column);
  } else {
    try {
      system_.write(number, value);
    } catch (AlarmRaised& raised) {
      if (raised.alarm.column == 0) raised.alarm.column = column;
      throw;
    }
  }
}

void Variables::open_level(const Locals& arguments, std::uint64_t undotted, double scale) {
  levels_.push_back({arguments, undotted, scale});
  locals_ = levels_.back().values.data();
}

void Variables::close_level() {
  levels_.pop_back();
  locals_ = levels_.back().values.data();
}

void Variables::reset_level(const Locals& arguments) {
  levels_.back().values = arguments;
}

double Variables::point_added(int number) const {
  const Level& level = levels_.back();
  const double value = local(number).number;
  return (level.undotted >> number & 1U) != 0 ? value * level.scale : value;
}

void Variables::set_name(int number, const std::string& name, int column) {
  if (!is_common(number)) {
    raise(AlarmNumber::VariableNumber, numbered("SETVN names commons, not #", number), column);
  }
  std::erase_if(names_, [number](const auto& each) { return each.second == number; });
  const auto [place, is_new] = names_.emplace(name, number);
  if (!is_new) place->second = std::min(place->second, number);
}

int Variables::named(const std::string& name, int column) const {
  const auto found = names_.find(name);
  if (found == names_.end()) {
    raise(AlarmNumber::VariableNumber, "no SETVN gave a variable the name " + readable(name),
          column);
  }
  return found->second;
}

}  // namespace ridgeline::macro
