#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/units/region.hpp"

namespace ridgeline::units {

/// Seen with z to the right and r up.
enum class Sense { Clockwise, CounterClockwise };

/// A line from start to end, or a circular arc about a centre. The pattern rows (FIG) of document
/// 004, figure 4.
struct Segment {
  Point start;
  Point end;
  struct Round {
    Point centre;
    double radius = 0;
    Sense sense = Sense::CounterClockwise;
  };
  std::optional<Round> arc;
};

/// Closed: the end of each segment is the start of the next, the last joins the first.
using Contour = std::vector<Segment>;

/// Radius of an arc [mm]; 0 for a line.
double radius(const Segment& segment);

/// Length along the segment [mm].
double length(const Segment& segment);

/// The point at a fraction of the length, and the direction there (unit, z to r as components).
Point point_at(const Segment& segment, double fraction);
Point direction_at(const Segment& segment, double fraction);

/// Rows with a radius instead of a centre: the shorter arc. Throws Error{BadInput} when the ends
/// are farther apart than the diameter.
Segment arc_segment(const Point& start, const Point& end, double radius, Sense sense);

/// The region inside closed contours: winding number not 0. What lies at r < 0 is cut off.
Region region_of(std::span<const Contour> contours);
Region region_of(const Contour& contour);

/// The boundary: outer loops counter-clockwise (z right, r up), holes clockwise. As few segments as
/// there are.
std::vector<Contour> contours(const Region& region);

/// Rows that go straight on as one row; a closed contour also over its end.
std::vector<Segment> simplified(const std::vector<Segment>& segments);

/// Curve between z0 and z1 as a segment, in the direction of z given by the order of the limits.
Segment segment_of(const Curve& curve, double z0, double z1);

}  // namespace ridgeline::units
