#include "core/units/names.hpp"

#include <algorithm>
#include <array>

namespace ridgeline::units {
namespace {

constexpr std::array<std::string_view, 8> kinds = {"face_front", "face_back",  "bar_outer",
                                                   "bar_inner",  "groove",     "hole",
                                                   "face_mill",  "unexplained"};
constexpr std::array<std::string_view, 4> states = {"auto", "edited", "frozen", "kept"};
constexpr std::array<std::string_view, 3> bottoms = {"flat", "cone", "through"};

template <class Enum, std::size_t n>
std::optional<Enum> find(const std::array<std::string_view, n>& names, std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Enum>(found - names.begin());
}

}  // namespace

std::string_view name(UnitKind kind) noexcept {
  return kinds[static_cast<std::size_t>(kind)];
}
std::optional<UnitKind> unit_kind(std::string_view name) noexcept {
  return find<UnitKind>(kinds, name);
}
std::string_view name(State state) noexcept {
  return states[static_cast<std::size_t>(state)];
}
std::optional<State> state(std::string_view name) noexcept {
  return find<State>(states, name);
}
std::string_view name(HoleBottom bottom) noexcept {
  return bottoms[static_cast<std::size_t>(bottom)];
}
std::optional<HoleBottom> hole_bottom(std::string_view name) noexcept {
  return find<HoleBottom>(bottoms, name);
}

}  // namespace ridgeline::units
