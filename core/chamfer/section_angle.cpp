#include "core/chamfer/section_angle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"
#include "core/base/text.hpp"

namespace ridgeline::chamfer {

using std::numbers::pi;

TableAngle table_angle(const AngleTable& table, double phi) {
  const std::vector<AngleTable::Entry>& entries = table.entries;
  const double first = entries.front().phi;
  const double turned = phi - first - 2 * pi * std::floor((phi - first) / (2 * pi));  // [0, 2 pi]
  const auto above = std::ranges::upper_bound(
      entries, turned, {}, [&](const AngleTable::Entry& entry) { return entry.phi - first; });
  const AngleTable::Entry& low = *std::prev(above);
  const bool wraps = above == entries.end();
  const AngleTable::Entry& high = wraps ? entries.front() : *above;
  const double span = high.phi - low.phi + (wraps ? 2 * pi : 0);
  const double slope = (high.delta - low.delta) / span;
  return {.delta = low.delta + slope * (turned - (low.phi - first)), .slope = slope};
}

void require_table(const AngleTable& table) {
  const std::vector<AngleTable::Entry>& entries = table.entries;
  bool ascending = !entries.empty();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double step = entries[i].phi - (i == 0 ? entries[0].phi : entries[i - 1].phi);
    ascending = ascending && std::isfinite(entries[i].phi) && (i == 0 || step > 0);
  }
  if (ascending && entries.back().phi - entries.front().phi < 2 * pi) return;
  throw Error(ErrorCode::BadInput,
              "section angle table: the angles phi must ascend within one turn, " +
                  text(degrees(2 * pi), "deg"),
              {.field = "/section_angle"});
}

}  // namespace ridgeline::chamfer
