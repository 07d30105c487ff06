#include "core/units/skin.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/units/figure.hpp"
#include "core/units/offset.hpp"
#include "core/units/overlay.hpp"
#include "core/units/tolerance.hpp"

namespace ridgeline::units {

Region filled_behind(const Region& shadow, bool is_outer) {
  Contour contour = limit_of(shadow, is_outer ? Limit::Greatest : Limit::Least);
  if (contour.empty()) return {};
  const Point first = contour.front().start;
  const Point last = contour.back().end;
  const double r = is_outer ? 0 : box(shadow).r1 + 1000;
  contour.push_back({last, {r, last.z}, {}});
  contour.push_back({{r, last.z}, {r, first.z}, {}});
  contour.push_back({{r, first.z}, first, {}});
  return region_of(contour);
}

std::vector<Interval> free_on(const Bar& bar, const std::vector<Segment>& skin, double r, double z0,
                              double z1) {
  const bool is_outer = bar.is_outer;
  std::vector<double> cuts{z0, z1};
  const auto add = [&](double z) {
    if (z > z0 && z < z1) cuts.push_back(z);
  };
  for (const Segment& row : skin) {
    add(row.start.z);
    add(row.end.z);
    if (row.arc) {
      const double h = r - row.arc->centre.r;
      const double d = row.arc->radius * row.arc->radius - h * h;
      if (d < 0) continue;
      for (const double sign : {-1.0, 1.0}) {
        const double z = row.arc->centre.z + sign * std::sqrt(d);
        if (z >= std::min(row.start.z, row.end.z) && z <= std::max(row.start.z, row.end.z)) add(z);
      }
    } else if ((row.start.r - r) * (row.end.r - r) < 0) {
      add(row.start.z + (row.end.z - row.start.z) * (r - row.start.r) / (row.end.r - row.start.r));
    }
  }
  std::sort(cuts.begin(), cuts.end());
  const auto height = [&](double z) -> std::optional<double> {
    for (const Segment& row : skin) {
      const double low = std::min(row.start.z, row.end.z);
      const double high = std::max(row.start.z, row.end.z);
      if (z < low || z > high || high - low < merge_tolerance) continue;
      if (!row.arc) {
        return row.start.r +
               (row.end.r - row.start.r) * (z - row.start.z) / (row.end.z - row.start.z);
      }
      const double h =
          row.arc->radius * row.arc->radius - (z - row.arc->centre.z) * (z - row.arc->centre.z);
      const double middle = (row.start.r + row.end.r) / 2;
      const double side = middle >= row.arc->centre.r ? 1 : -1;
      return row.arc->centre.r + side * std::sqrt(std::max(0.0, h));
    }
    return std::nullopt;
  };
  std::vector<Interval> free;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i + 1] - cuts[i] < merge_tolerance) continue;
    const std::optional<double> h = height((cuts[i] + cuts[i + 1]) / 2);
    if (h && (is_outer ? *h > r + merge_tolerance : *h < r - merge_tolerance)) continue;
    if (h && !is_outer && *h < merge_tolerance) continue;  // solid
    if (!free.empty() && free.back().z1 >= cuts[i] - merge_tolerance) {
      free.back().z1 = cuts[i + 1];
    } else {
      free.push_back({cuts[i], cuts[i + 1]});
    }
  }
  return free;
}

std::vector<Segment> skin_of(const Bar& bar, double distance, double z0, double z1) {
  const Region forbidden = grown(bar.filled, distance);
  const Box f = box(forbidden);
  const Region part = intersection_of(forbidden, rectangle(0, f.r1 + 1, z0, z1));
  return simplified(limit_of(part, bar.is_outer ? Limit::Greatest : Limit::Least));
}

double steepest_fall(const Bar& bar) {
  double steepest = 0;
  for (const Segment& row : limit_of(bar.region, bar.is_outer ? Limit::Least : Limit::Greatest)) {
    for (const double t : {0.02, 0.5, 0.98}) {
      const Point d = direction_at(row, t);
      const double along = d.z * bar.way;
      const double fall = (bar.is_outer ? -d.r : d.r) * (along < 0 ? -1 : 1);
      if (fall > 1e-6) steepest = std::max(steepest, std::atan2(fall, std::abs(along)));
    }
  }
  return steepest;
}

}  // namespace ridgeline::units
