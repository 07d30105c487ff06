#pragma once

#include <optional>
#include <string_view>

#include "core/units/program.hpp"

namespace ridgeline::units {

/// Names of interfaces.md: "face_front", "bar_outer", ...
std::string_view name(UnitKind kind) noexcept;
std::optional<UnitKind> unit_kind(std::string_view name) noexcept;

/// "auto", "edited", "frozen", "kept".
std::string_view name(State state) noexcept;
std::optional<State> state(std::string_view name) noexcept;

/// "flat", "cone", "through".
std::string_view name(HoleBottom bottom) noexcept;
std::optional<HoleBottom> hole_bottom(std::string_view name) noexcept;

}  // namespace ridgeline::units
