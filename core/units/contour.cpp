#include "core/units/contour.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/error.hpp"
#include "core/units/overlay.hpp"
#include "core/units/tolerance.hpp"

namespace ridgeline::units {
namespace {

constexpr double pi = std::numbers::pi;

double distance(const Point& p, const Point& q) {
  return std::hypot(p.r - q.r, p.z - q.z);
}

/// Angle of a point about a centre, z right and r up.
double angle(const Point& centre, const Point& p) {
  return std::atan2(p.r - centre.r, p.z - centre.z);
}

/// Signed angle that an arc turns through; a full circle when start and end are one. Ends that a
/// vertex moved past each other make a hair of an arc the other way, not nearly a full circle.
double turn(const Segment& segment) {
  const double from = angle(segment.arc->centre, segment.start);
  const double by = std::remainder(angle(segment.arc->centre, segment.end) - from, 2 * pi);
  const double gap = distance(segment.start, segment.end);
  if (gap > 0 && gap < 10 * vertex_tolerance && std::abs(by) * radius(segment) < 2 * gap) return by;
  if (segment.arc->sense == Sense::CounterClockwise) return by > 0 ? by : by + 2 * pi;
  return by < 0 ? by : by - 2 * pi;
}

Point on_circle(const Point& centre, double radius, double angle) {
  return {.r = centre.r + radius * std::sin(angle), .z = centre.z + radius * std::cos(angle)};
}

/// A monotone piece of boundary with its own curve.
struct Stroke {
  Curve curve;
  double z0 = 0;
  double z1 = 0;
  int winding = 0;
};

/// Crossing a stroke outwards (towards greater r) enters what lies to its left: a stroke that runs
/// towards greater z has its left above.
void add_line(std::vector<Stroke>& strokes, const Segment& line) {
  if (std::abs(line.end.z - line.start.z) <= merge_tolerance) return;
  strokes.push_back({line_through(line.start, line.end), std::min(line.start.z, line.end.z),
                     std::max(line.start.z, line.end.z), line.end.z > line.start.z ? 1 : -1});
}

/// Splits an arc at the poles of its circle, where it turns back in z.
void add_arc(std::vector<Stroke>& strokes, const Segment& arc) {
  const Point& centre = arc.arc->centre;
  const double R = radius(arc);
  const double by = turn(arc);
  const double from = angle(centre, arc.start);
  std::vector<double> cuts{0};
  for (int k = -4; k <= 4; ++k) {
    const double t = (k * pi - from) / by;
    if (t > 0 && t < 1) cuts.push_back(t);
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.push_back(1);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double za = i == 0 ? arc.start.z : centre.z + R * std::cos(from + by * cuts[i]);
    const double zb =
        i + 2 == cuts.size() ? arc.end.z : centre.z + R * std::cos(from + by * cuts[i + 1]);
    if (std::abs(zb - za) <= merge_tolerance) continue;
    const double middle = from + by * (cuts[i] + cuts[i + 1]) / 2;
    strokes.push_back({{.a = centre, .b = {}, .radius = R, .side = std::sin(middle) > 0 ? 1 : -1},
                       std::min(za, zb),
                       std::max(za, zb),
                       zb > za ? 1 : -1});
  }
}

/// Interval of r that a slab covers at one of its limits.
struct Interval {
  double r0 = 0;
  double r1 = 0;
};

/// The parts of a that b does not cover, longer than the vertex tolerance.
std::vector<Interval> uncovered(const std::vector<Interval>& a, const std::vector<Interval>& b) {
  std::vector<Interval> parts;
  for (const Interval& whole : a) {
    double r = whole.r0;
    for (const Interval& cut : b) {
      if (cut.r1 <= r || cut.r0 >= whole.r1) continue;
      if (cut.r0 - r > vertex_tolerance) parts.push_back({r, cut.r0});
      r = std::max(r, cut.r1);
    }
    if (whole.r1 - r > vertex_tolerance) parts.push_back({r, whole.r1});
  }
  return parts;
}

struct SlabView {
  std::size_t first = 0;
  std::size_t end = 0;
};

std::vector<SlabView> slabs(const Region& region) {
  std::vector<SlabView> views;
  for (std::size_t i = 0; i < region.cells.size(); ++i) {
    if (views.empty() || region.cells[views.back().first].z0 != region.cells[i].z0) {
      views.push_back({i, i});
    }
    views.back().end = i + 1;
  }
  return views;
}

std::vector<Interval> intervals(const Region& region, const SlabView& view, double z) {
  std::vector<Interval> found;
  for (std::size_t i = view.first; i < view.end; ++i) {
    const Cell& cell = region.cells[i];
    const Interval one{radius_at(cell.inner, z), radius_at(cell.outer, z)};
    if (!found.empty() && one.r0 - found.back().r1 <= vertex_tolerance) {
      found.back().r1 = std::max(found.back().r1, one.r1);
    } else {
      found.push_back(one);
    }
  }
  return found;
}

/// Every segment of the boundary, directed with the region on its left, in no order.
std::vector<Segment> boundary(const Region& region) {
  std::vector<Segment> found;
  for (const Cell& cell : region.cells) {
    found.push_back(segment_of(cell.inner, cell.z0, cell.z1));
    found.push_back(segment_of(cell.outer, cell.z1, cell.z0));
  }
  const std::vector<SlabView> views = slabs(region);
  for (std::size_t k = 0; k <= views.size(); ++k) {
    const bool has_below = k > 0;
    const bool has_above = k < views.size();
    const double z =
        has_above ? region.cells[views[k].first].z0 : region.cells[views[k - 1].first].z1;
    std::vector<Interval> below;
    std::vector<Interval> above;
    if (has_below && region.cells[views[k - 1].first].z1 == z) {
      below = intervals(region, views[k - 1], z);
    }
    if (has_above) above = intervals(region, views[k], z);
    for (const Interval& part : uncovered(below, above)) {
      found.push_back({{part.r0, z}, {part.r1, z}, {}});
    }
    for (const Interval& part : uncovered(above, below)) {
      found.push_back({{part.r1, z}, {part.r0, z}, {}});
    }
    if (has_below && region.cells[views[k - 1].first].z1 != z) {
      const double end = region.cells[views[k - 1].first].z1;
      for (const Interval& part : intervals(region, views[k - 1], end)) {
        found.push_back({{part.r0, end}, {part.r1, end}, {}});
      }
    }
  }
  std::erase_if(found, [](const Segment& segment) {
    return distance(segment.start, segment.end) <= merge_tolerance;
  });
  return found;
}

/// How far a segment turns to the left of the direction that was followed, in (-pi, pi].
double left_turn(const Point& from, const Point& to) {
  return std::atan2(from.z * to.r - from.r * to.z, from.z * to.z + from.r * to.r);
}

/// The unused segment that goes on from the end of `last`: the one with the nearest start; of those
/// at one vertex the one most to the left, so that pieces that meet in a point stay apart.
std::size_t following(const std::vector<Segment>& all, const std::vector<char>& used,
                      const Segment& last) {
  double nearest = 4 * vertex_tolerance;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!used[i]) nearest = std::min(nearest, distance(all[i].start, last.end));
  }
  std::size_t best = all.size();
  double best_turn = 0;
  const Point heading = direction_at(last, 1);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (used[i] || distance(all[i].start, last.end) > nearest + merge_tolerance) continue;
    const double turned = left_turn(heading, direction_at(all[i], 0));
    if (best == all.size() || turned > best_turn) {
      best = i;
      best_turn = turned;
    }
  }
  if (best == all.size()) {
    throw Error(ErrorCode::Internal, "the boundary of a region does not close at r " +
                                         std::to_string(last.end.r) + ", z " +
                                         std::to_string(last.end.z) + " mm");
  }
  return best;
}

bool is_straight_on(const Segment& p, const Segment& q) {
  if (p.arc.has_value() != q.arc.has_value()) return false;
  if (p.arc) {
    return p.arc->sense == q.arc->sense && distance(p.arc->centre, q.arc->centre) < 1e-9 &&
           std::abs(radius(p) - radius(q)) < 1e-9 && distance(p.start, q.end) > vertex_tolerance;
  }
  const Point u = direction_at(p, 0);
  const double across = std::abs((q.end.z - p.start.z) * u.r - (q.end.r - p.start.r) * u.z);
  const double middle = std::abs((q.start.z - p.start.z) * u.r - (q.start.r - p.start.r) * u.z);
  const Point v = direction_at(q, 0);
  return u.z * v.z + u.r * v.r > 0 && across < merge_tolerance && middle < merge_tolerance;
}

}  // namespace

double radius(const Segment& segment) {
  return segment.arc ? segment.arc->radius : 0;
}

double length(const Segment& segment) {
  return segment.arc ? std::abs(turn(segment)) * radius(segment)
                     : distance(segment.start, segment.end);
}

Point point_at(const Segment& segment, double fraction) {
  if (!segment.arc) {
    return {.r = std::lerp(segment.start.r, segment.end.r, fraction),
            .z = std::lerp(segment.start.z, segment.end.z, fraction)};
  }
  const Point& centre = segment.arc->centre;
  return on_circle(centre, radius(segment),
                   angle(centre, segment.start) + turn(segment) * fraction);
}

Point direction_at(const Segment& segment, double fraction) {
  if (!segment.arc) {
    const double l = std::max(distance(segment.start, segment.end), 1e-300);
    return {.r = (segment.end.r - segment.start.r) / l, .z = (segment.end.z - segment.start.z) / l};
  }
  const double by = turn(segment);
  const double at = angle(segment.arc->centre, segment.start) + by * fraction;
  const double sign = by > 0 ? 1 : -1;
  return {.r = sign * std::cos(at), .z = -sign * std::sin(at)};
}

Segment arc_segment(const Point& start, const Point& end, double radius, Sense sense) {
  const double chord = distance(start, end);
  if (!(chord > 0 && radius > 0 && chord <= 2 * radius * (1 + 1e-9))) {
    throw Error(ErrorCode::BadInput, "arc of radius " + std::to_string(radius) +
                                         " mm between points " + std::to_string(chord) +
                                         " mm apart; 0 < distance <= 2 radius must hold");
  }
  const double h = std::sqrt(std::max(0.0, radius * radius - chord * chord / 4));
  const double uz = (end.z - start.z) / chord;
  const double ur = (end.r - start.r) / chord;
  const double side = sense == Sense::CounterClockwise ? 1 : -1;
  const Point centre{.r = (start.r + end.r) / 2 + side * h * uz,
                     .z = (start.z + end.z) / 2 - side * h * ur};
  return {start, end, Segment::Round{centre, radius, sense}};
}

std::vector<Segment> simplified(const std::vector<Segment>& segments) {
  std::vector<Segment> merged;
  for (const Segment& segment : segments) {
    if (!merged.empty() && is_straight_on(merged.back(), segment)) {
      merged.back().end = segment.end;
    } else {
      merged.push_back(segment);
    }
  }
  if (segments.empty() || distance(segments.back().end, segments.front().start) > merge_tolerance) {
    return merged;
  }
  while (merged.size() > 2 && is_straight_on(merged.back(), merged.front())) {
    merged.front().start = merged.back().start;
    merged.pop_back();
  }
  return merged;
}

Segment segment_of(const Curve& curve, double z0, double z1) {
  Segment segment{{radius_at(curve, z0), z0}, {radius_at(curve, z1), z1}, {}};
  if (is_arc(curve)) {
    const bool forward = z1 > z0;
    const bool upper = curve.side > 0;
    segment.arc = Segment::Round{curve.a, curve.radius,
                                 forward == upper ? Sense::Clockwise : Sense::CounterClockwise};
  }
  return segment;
}

Region region_of(std::span<const Contour> contours) {
  std::vector<Stroke> strokes;
  for (const Contour& contour : contours) {
    for (const Segment& segment : contour) {
      if (segment.arc) {
        add_arc(strokes, segment);
      } else {
        add_line(strokes, segment);
      }
    }
  }
  std::vector<BoundaryPiece> pieces;
  double z0 = HUGE_VAL;
  double z1 = -HUGE_VAL;
  bool crosses_axis = false;
  for (const Stroke& stroke : strokes) {
    pieces.push_back({&stroke.curve, stroke.z0, stroke.z1, 0, stroke.winding});
    z0 = std::min(z0, stroke.z0);
    z1 = std::max(z1, stroke.z1);
    crosses_axis |= range(stroke.curve, stroke.z0, stroke.z1).min < -merge_tolerance;
  }
  if (pieces.empty()) return {};
  Region whole = select(overlay(std::move(pieces)), [](std::uint64_t) { return true; });
  if (!crosses_axis) return whole;
  return intersection_of(whole, rectangle(0, 1 + 2 * box(whole).r1, z0, z1));
}

Region region_of(const Contour& contour) {
  return region_of(std::span<const Contour>(&contour, 1));
}

std::vector<Contour> contours(const Region& region) {
  if (is_empty(region)) return {};
  const std::vector<Segment> all = boundary(region);
  std::vector<char> used(all.size(), 0);
  std::vector<Contour> loops;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (used[i]) continue;
    Contour loop;
    for (std::size_t next = i; loop.empty() || next != i;
         next = following(all, used, loop.back())) {
      loop.push_back(all[next]);
      if (next != i) used[next] = 1;
      if (loop.size() > 1) loop.back().start = loop[loop.size() - 2].end;
    }
    used[i] = 1;
    loop.back().end = loop.front().start;
    loop = simplified(loop);
    if (loop.size() >= 2) loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace ridgeline::units
