#include "core/units/offset.hpp"

#include <algorithm>
#include <cmath>

#include "core/units/contour.hpp"
#include "core/units/overlay.hpp"
#include "core/units/tolerance.hpp"

namespace ridgeline::units {
namespace {

Contour disc(const Point& centre, double R) {
  const Point left{centre.r, centre.z - R};
  const Point right{centre.r, centre.z + R};
  const Segment::Round round{centre, R, Sense::CounterClockwise};
  return {{left, right, round}, {right, left, round}};
}

Point moved(const Point& p, const Point& direction, double by) {
  return {.r = p.r + by * direction.r, .z = p.z + by * direction.z};
}

/// Unit normal to the right of a segment: away from the region on its left.
Point outward(const Segment& segment, double fraction) {
  const Point along = direction_at(segment, fraction);
  return {.r = -along.z, .z = along.r};
}

/// What the offset adds along one segment: between it and its parallel on the right.
Contour band(const Segment& segment, double d) {
  const Point a = moved(segment.start, outward(segment, 0), d);
  const Point b = moved(segment.end, outward(segment, 1), d);
  const Segment back{segment.end, segment.start, {}};
  if (!segment.arc) return {{segment.start, a, {}}, {a, b, {}}, {b, segment.end, {}}, back};
  const Segment::Round& round = *segment.arc;
  const bool bulges = round.sense == Sense::CounterClockwise;
  const double R = bulges ? round.radius + d : round.radius - d;
  const Segment::Round inner{round.centre, round.radius,
                             bulges ? Sense::Clockwise : Sense::CounterClockwise};
  const Segment reversed{segment.end, segment.start, inner};
  if (R <= merge_tolerance) {
    return {{segment.start, round.centre, {}}, {round.centre, segment.end, {}}, reversed};
  }
  const Segment parallel{a, b, Segment::Round{round.centre, R, round.sense}};
  return {{segment.start, a, {}}, parallel, {b, segment.end, {}}, reversed};
}

bool is_on_axis(const Segment& segment) {
  return !segment.arc && segment.start.r <= merge_tolerance && segment.end.r <= merge_tolerance;
}

}  // namespace

Region grown(const Region& region, double d) {
  if (!(d > 0)) return region;
  std::vector<Region> parts{region};
  for (const Contour& loop : contours(region)) {
    for (const Segment& segment : loop) {
      if (is_on_axis(segment)) continue;
      parts.push_back(region_of(band(segment, d)));
      parts.push_back(region_of(disc(segment.start, d)));
      parts.push_back(region_of(disc(segment.end, d)));
    }
  }
  return union_of(parts);
}

Region shrunk(const Region& region, double d) {
  if (!(d > 0) || is_empty(region)) return region;
  const Box extents = box(region);
  const double margin = 2 * d + 1;
  const Region around = rectangle(0, extents.r1 + margin, extents.z0 - margin, extents.z1 + margin);
  return difference_of(region, grown(difference_of(around, region), d));
}

}  // namespace ridgeline::units
