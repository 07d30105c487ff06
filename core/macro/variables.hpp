#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/macro/program.hpp"
#include "core/macro/value.hpp"

namespace ridgeline::macro {

/// Variables that are not memory: modal state, positions, offsets, timers (design section 2.2).
class SystemVariables {
public:
  virtual ~SystemVariables() = default;
  /// Raises 115 for a number that does not exist.
  virtual Value read(int number) = 0;
  /// Raises 115, or 116 when the variable cannot be written.
  virtual void write(int number, Value value) = 0;
};

/// #1 to #33 of one macro level. [0] is not used.
using Locals = std::array<Value, 34>;

/// Memory of a run: locals of each level, commons, and the way to the system variables.
class Variables {
public:
  Variables(const Profile& profile, SystemVariables& system)
      : profile_(profile), system_(system), levels_(1), locals_(levels_.front().values.data()) {}

  Value local(int number) const { return locals_[number]; }
  Value common(int number) const { return common_[static_cast<std::size_t>(number)]; }
  /// Any variable; #0 is vacant. Raises 115.
  Value read(int number, int column = 0) const;
  /// Raises 115 or 116.
  void write(int number, Value value, int column = 0);
  /// For the assignment of a plain #n: no search of its kind.
  void write_local(int number, Value value) { locals_[number] = value; }
  void write_common(int number, Value value) {
    common_[static_cast<std::size_t>(number)] = value;
    used_.set(static_cast<std::size_t>(number));
  }

  bool is_common(int number) const {
    return (number >= 100 && number <= profile_.last_low_common) ||
           (number >= 500 && number <= profile_.last_high_common);
  }
  /// Commons that were written or are named in a program: reported at the end, vacant ones too.
  void mark_used(int number) { used_.set(static_cast<std::size_t>(number)); }
  bool is_used(int number) const { return used_.test(static_cast<std::size_t>(number)); }

  /// A macro call opens a level with its arguments; its M99 closes it. `undotted`: bit i when
  /// argument #i was written without decimal point and scaled by `scale`, for ADP.
  void open_level(const Locals& arguments, std::uint64_t undotted, double scale);
  void close_level();
  /// A repeated call starts again from its arguments.
  void reset_level(const Locals& arguments);
  int level() const { return static_cast<int>(levels_.size()) - 1; }
  const Locals& locals() const { return levels_.back().values; }
  double point_added(int number) const;

  /// SETVN: the name of a common variable; the one with the lowest number has it. Raises 115.
  void set_name(int number, const std::string& name, int column);
  /// The number of a named variable. Raises 115.
  int named(const std::string& name, int column) const;

  SystemVariables& system() const { return system_; }
  const Profile& profile() const { return profile_; }

private:
  struct Level {
    Locals values;
    std::uint64_t undotted = 0;
    double scale = 1;
  };
  const Profile& profile_;
  SystemVariables& system_;
  std::vector<Level> levels_;
  Value* locals_;
  std::array<Value, 1000> common_;
  std::bitset<1000> used_;
  std::map<std::string, int, std::less<>> names_;
};

/// Value of the expression that starts at instruction `code`. Raises 110..119.
Value evaluate(const Program& program, std::int32_t code, const Variables& variables);

/// A value as a whole number (an address that counts, an index): half away from zero.
std::int64_t rounded_integer(double value, int column);

}  // namespace ridgeline::macro
