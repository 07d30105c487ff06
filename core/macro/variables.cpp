#include "core/macro/variables.hpp"

#include <string>

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

}  // namespace ridgeline::macro
