#pragma once

#include <functional>

#include "core/macro/result.hpp"
#include "core/macro/state.hpp"
#include "core/macro/variables.hpp"

namespace ridgeline::macro {

/// The system variables of design section 2.2, on the state of a simulated control.
class ControlVariables : public SystemVariables {
public:
  ControlVariables(State& state, Result& result) : state_(state), result_(result) {}

  Value read(int number) override;
  void write(int number, Value value) override;
  /// What a caller sets before the run: inputs (#1000..), skip positions and the tool number too.
  void preset(int number, Value value);
  /// Called when a variable is read that a control would read before the motion has ended.
  std::function<void(int number)> on_hazard;

private:
  Value modal(int group_or_address) const;
  Value position(int number);
  double* offset(int number);
  double* work_offset(int number);
  double milliseconds() const;

  State& state_;
  Result& result_;
  double timer_zero_ = 0;  ///< #3001 [ms]
  double hours_zero_ = 0;  ///< #3002 [h]
};

/// Cutter radius of offset number D, tool length of offset number H [mm]. Raises 030.
double radius_offset(const State& state, int number);
double length_offset(const State& state, int number);

}  // namespace ridgeline::macro
