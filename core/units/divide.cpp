#include "core/units/divide.hpp"

#include <algorithm>
#include <cmath>

#include "core/units/figure.hpp"
#include "core/units/names.hpp"
#include "core/units/overlay.hpp"
#include "core/units/tolerance.hpp"

namespace ridgeline::units {
namespace {

/// The part of R in every zone; what lies in a removed unit's region is kept apart.
struct Parts {
  std::vector<Region> in_zone;
  Region in_removed;
};

Region all_removed(std::span<const Removed> removed) {
  std::vector<Region> regions;
  for (const Removed& one : removed) regions.push_back(one.region);
  return union_of(regions);
}

Parts parts_of(const Division& division) {
  Parts parts;
  const Region removed = all_removed(division.removed);
  parts.in_zone.resize(division.zones.size());
  for (std::size_t first = 0; first < division.zones.size(); first += overlay_limit - 2) {
    const std::size_t end = std::min(division.zones.size(), first + overlay_limit - 2);
    std::vector<const Region*> operands{&division.remaining, &removed};
    for (std::size_t i = first; i < end; ++i) operands.push_back(&division.zones[i].region);
    const Overlay cut = overlay(operands);
    for (std::size_t i = first; i < end; ++i) {
      const std::uint64_t bit = std::uint64_t{1} << (i - first + 2);
      parts.in_zone[i] = select(
          cut, [&](std::uint64_t covered) { return (covered & 3) == 1 && (covered & bit) != 0; });
    }
  }
  parts.in_removed = intersection_of(division.remaining, removed);
  return parts;
}

/// Which removed units covered a cell: bits as the operands of the overlay, from bit 2.
bool is_taken_out(const Division& division, const Zone& zone, std::uint64_t covered) {
  for (std::size_t i = 0; i < division.removed.size(); ++i) {
    const Removed& one = division.removed[i];
    if ((covered >> (i + 2) & 1) != 0 && one.kind == zone.kind && one.process == zone.process) {
      return true;
    }
  }
  return false;
}

void add(Region& sum, const Region& part) {
  if (is_empty(part)) return;
  const Region both[] = {sum, part};
  sum = union_of(both);
}

/// Work of units that were taken out: the other process takes it over where it can, else it is
/// left.
void hand_over(const Division& division, Parts& parts, Divided& result) {
  if (is_empty(parts.in_removed)) return;
  for (std::size_t i = 0; i < division.zones.size(); ++i) {
    const Zone& zone = division.zones[i];
    std::vector<const Region*> operands{&parts.in_removed, &zone.region};
    for (const Removed& one : division.removed) operands.push_back(&one.region);
    const Overlay cut = overlay(operands);
    const auto is_own = [&](std::uint64_t covered) {
      return (covered & 3) == 3 && !is_taken_out(division, zone, covered);
    };
    const auto is_beyond = [&](std::uint64_t covered) {
      return (covered & 3) == 3 && is_taken_out(division, zone, covered) && zone.beyond &&
             !is_taken_out(division, division.zones[*zone.beyond], covered);
    };
    add(parts.in_zone[i], select(cut, is_own));
    if (zone.beyond) add(parts.in_zone[*zone.beyond], select(cut, is_beyond));
    const double lost = volume(select(cut, [&](std::uint64_t covered) {
      return (covered & 3) == 3 && !is_own(covered) && !is_beyond(covered);
    }));
    if (lost < equal_volume) continue;
    result.left += lost;
    result.notes.push_back(std::string(name(zone.kind)) + " of process " +
                           std::to_string(zone.process) + " was removed: " + std::to_string(lost) +
                           " mm3 are left, no other unit reaches them");
  }
}

Curve straight_on(const Curve& curve, double z, double by) {
  const double r = radius_at(curve, z);
  return line_through({r, z}, {r + slope_at(curve, z) * by, z + by});
}

/// S603, S604, S703, S704: the end of a piece goes on straight over the split.
Region extension(const Division& division, const Zone& zone, const Region& piece) {
  if (!zone.ends_at_split || !(zone.overlap > merge_tolerance)) return {};
  const Region& other = division.zones[*zone.beyond].region;
  if (is_empty(intersection_of(other, division.turned))) return {};
  const double by = zone.process == 1 ? zone.overlap : -zone.overlap;
  std::vector<Region> bands;
  for (const Cell& cell : piece.cells) {
    const double z = zone.process == 1 ? cell.z1 : cell.z0;
    if (std::abs(z - zone.split) > merge_tolerance) continue;
    bands.push_back({{{.z0 = std::min(z, z + by),
                       .z1 = std::max(z, z + by),
                       .inner = straight_on(cell.inner, z, by),
                       .outer = straight_on(cell.outer, z, by)}}});
  }
  if (bands.empty()) return {};
  const Region band = union_of(bands);
  const Region* operands[] = {&band, &other, &division.turned, &division.blocked, &piece};
  return select(overlay(operands), [](std::uint64_t covered) { return covered == 7; });
}

/// The zone whose process takes a part: its own, unless that process is over.
std::size_t taker_of(const Division& division, std::size_t i) {
  const Zone& zone = division.zones[i];
  return zone.process < division.process && zone.beyond ? *zone.beyond : i;
}

/// An edited core may cut the extension apart: only what hangs on the piece is continuous work.
Region with_extension(const Region& piece, const Region& over) {
  if (is_empty(over)) return piece;
  const Region both[] = {piece, over};
  std::vector<Region> connected = pieces(union_of(both));
  if (connected.size() == 1) return connected.front();
  std::erase_if(connected, [&](const Region& part) {
    return volume(intersection_of(part, piece)) < equal_volume;
  });
  return union_of(connected);
}

Unit unit_of(const Division& division, const Zone& zone, const Region& piece) {
  Unit unit;
  unit.kind = zone.kind;
  unit.process = std::max(zone.process, division.process);
  unit.core = piece;
  unit.region = with_extension(piece, extension(division, zone, piece));
  if (zone.kind == UnitKind::Hole) {
    if (symmetric_difference(piece, zone.region) < equal_volume) {
      unit.hole = zone.hole;
      unit.process = zone.process;
    } else {
      unit.kind = UnitKind::BarInner;  // a drill leaves no ring
    }
  }
  unit.volume = volume(unit.region);
  draw_figure(unit);
  return unit;
}

}  // namespace

Divided divide(const Division& division) {
  Divided result;
  Parts parts = parts_of(division);
  if (!division.removed.empty()) hand_over(division, parts, result);
  for (std::size_t i = 0; i < division.zones.size(); ++i) {
    const std::size_t taker = taker_of(division, i);
    if (taker == i || is_empty(parts.in_zone[i])) continue;
    add(parts.in_zone[taker], parts.in_zone[i]);
    parts.in_zone[i] = {};
  }
  for (std::size_t i = 0; i < division.zones.size(); ++i) {
    for (const Region& piece : pieces(parts.in_zone[i])) {
      if (volume(piece) < equal_volume && thickness(piece) < sliver_thickness) {
        result.left += volume(piece);
        continue;
      }
      result.units.push_back(unit_of(division, division.zones[i], piece));
    }
  }
  return result;
}

}  // namespace ridgeline::units
