#pragma once

#include <cstdint>
#include <optional>

#include "core/macro/profile.hpp"

namespace ridgeline::macro {

/// What PRM[number, bit]/[axis] asks for.
struct ParameterPlace {
  std::int64_t number = 0;
  std::optional<std::int64_t> bit;   ///< 0 to 7
  std::optional<std::int64_t> axis;  ///< from 1
};

/// A parameter of the control: one that `profile` holds, or one that follows from its members.
/// Raises 119 for a bit or axis that does not exist and for a parameter that nobody gave.
double parameter(const Profile& profile, const ParameterPlace& place, int column);

/// Sets the members of the profile that its parameters decide: 3401#0 DPI, 6004#0 NAT, 6006#0 MLG,
/// 1240 to 1243 reference points, 3410 arc tolerance, and the codes that call programs (CodeCalls).
/// Throws Error{BadInput} for a value that is not possible.
void apply_parameters(Profile& profile);

}  // namespace ridgeline::macro
