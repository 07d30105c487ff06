#include "core/macro/profile.hpp"

namespace ridgeline::macro {

// Literal digits, mantissa, nesting and functions by series: design sections 2.1 to 2.4.
std::optional<Profile> profile(std::string_view name) {
  Profile control;
  control.name = std::string(name);
  if (name == "30i" || name == "31i" || name == "32i") return control;
  control.subprogram_levels = 4;
  control.macro_levels = 4;
  if (name == "0i") return control;
  if (name != "16i" && name != "18i") return std::nullopt;
  control.literal_digits = 8;
  control.mantissa_bits = 32;
  control.condition_logic = false;
  control.power_functions = false;
  return control;
}

}  // namespace ridgeline::macro
