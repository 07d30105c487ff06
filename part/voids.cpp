#include "part/voids.hpp"

#include <algorithm>

#include "core/units/overlay.hpp"
#include "core/units/tolerance.hpp"

namespace ridgeline::part {
namespace {

constexpr double crack = 2e-3;  // [mm]: between free-form faces that meet within a file's tolerance

std::vector<units::Region> closed_voids(const units::Region& section) {
  const units::Box whole = units::box(section);
  const units::Region around = units::rectangle(0, whole.r1 + 1, whole.z0 - 1, whole.z1 + 1);
  std::vector<units::Region> found = units::pieces(units::difference_of(around, section));
  std::erase_if(found, [&](const units::Region& piece) {
    const units::Box b = units::box(piece);
    return b.z0 < whole.z0 || b.z1 > whole.z1 || b.r1 > whole.r1;
  });
  return found;
}

}  // namespace

Filled without_voids(units::Region section, bool solid_has_cavity) {
  Filled filled{std::move(section), {}};
  for (const units::Region& piece : closed_voids(filled.section)) {
    const units::Box b = units::box(piece);
    if (solid_has_cavity && std::min(b.z1 - b.z0, units::thickness(piece)) > crack) continue;
    const units::Region both[] = {filled.section, piece};
    filled.section = units::union_of(both);
    const double volume = units::volume(piece);
    if (volume < units::equal_volume) continue;
    filled.voids.push_back({.name = {},
                            .why = "closed all round in the half section: only faces that are not "
                                   "turned open this void",
                            .r0 = b.r0,
                            .r1 = b.r1,
                            .z0 = b.z0,
                            .z1 = b.z1,
                            .volume = volume});
  }
  return filled;
}

}  // namespace ridgeline::part
