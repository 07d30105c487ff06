#pragma once

#include <optional>
#include <string_view>

namespace ridgeline::macro {

/// System variables that a name stands for: #first, or by a subscript #(first + n - base).
struct SystemName {
  int first = 0;
  int count = 1;  ///< of subscripts; 1: the name takes none
  int base = 1;   ///< lowest subscript
};

/// Of a name such as _DATE or _ABSIO, as [#_ABSIO[1]] for #5001; nullopt: there is none.
std::optional<SystemName> system_name(std::string_view name);

/// Longest name that SETVN gives to a common variable.
inline constexpr std::size_t longest_name = 31;

}  // namespace ridgeline::macro
