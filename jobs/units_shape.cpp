#include "jobs/units_shape.hpp"

#include <cmath>

#include "core/units/tolerance.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
using units::Point;
using units::Segment;
using units::Sense;

constexpr Choices<Sense, 2> senses{{{"cw", Sense::Clockwise}, {"ccw", Sense::CounterClockwise}}};
enum class Pattern { Line, Arc };
constexpr Choices<Pattern, 2> patterns{{{"line", Pattern::Line}, {"arc", Pattern::Arc}}};

/// Rows come from other programs too: a centre may be off by the rounding of its decimals.
constexpr double centre_tolerance = 1e-3;  // [mm]

Json row_document(const Segment& row) {
  Json document = {{"pattern", name_of(patterns, row.arc ? Pattern::Arc : Pattern::Line)},
                   {"start", point_document(row.start)},
                   {"end", point_document(row.end)}};
  if (row.arc) {
    document["radius"] = row.arc->radius;
    document["sense"] = name_of(senses, row.arc->sense);
    document["centre"] = point_document(row.arc->centre);
  }
  return document;
}

/// The centre of a flat arc lies far away, that of an ogive beyond the axis.
Point read_centre(const Value& value) {
  constexpr Range range = between(-2e6, 2e6, "mm");
  const std::vector<Value> both = value.array(2, 2);
  return {both[0].number(range), both[1].number(range)};
}

Segment read_arc(Object& object, const Point& start, const Point& end) {
  const double R = object.number("radius", above(0, 1e6, "mm"));
  const Sense sense = object.required("sense").choice(senses);
  const std::optional<Value> centre = object.optional("centre");
  if (!centre) {
    if (std::hypot(end.r - start.r, end.z - start.z) > 2 * R + centre_tolerance) {
      object.refuse("radius", "at least half the distance of start and end");
    }
    const double least = std::hypot(end.r - start.r, end.z - start.z) / 2;
    return units::arc_segment(start, end, std::max(R, least), sense);
  }
  Segment row{start, end, Segment::Round{read_centre(*centre), R, sense}};
  for (const Point& p : {start, end}) {
    const double distance = std::hypot(p.r - row.arc->centre.r, p.z - row.arc->centre.z);
    if (!(std::abs(distance - R) <= centre_tolerance)) {
      centre->refuse("a centre at the radius from start and end (or leave it out)");
    }
  }
  return row;
}

Segment read_row(const Value& value) {
  Object object(value);
  const Pattern pattern = object.required("pattern").choice(patterns);
  Segment row{read_point(object.required("start")), read_point(object.required("end")), {}};
  if (pattern == Pattern::Arc) row = read_arc(object, row.start, row.end);
  object.finish();
  return row;
}

}  // namespace

Json point_document(const Point& point) {
  return Json::array({point.r, point.z});
}

Point read_point(const Value& value) {
  const std::vector<Value> both = value.array(2, 2);
  return {both[0].number(section_radius_range), both[1].number(section_range)};
}

Json rows_document(const std::vector<Segment>& rows) {
  Json document = Json::array();
  for (const Segment& row : rows) document.push_back(row_document(row));
  return document;
}

std::vector<Segment> read_rows(const Value& value) {
  std::vector<Segment> rows;
  for (const Value& row : value.array(1, max_rows)) rows.push_back(read_row(row));
  return rows;
}

Json region_document(const units::Region& region) {
  Json document = Json::array();
  for (const units::Contour& contour : units::contours(region)) {
    document.push_back(rows_document(contour));
  }
  return document;
}

units::Region read_region(const Value& value) {
  std::vector<units::Contour> loops;
  std::size_t count = 0;
  for (const Value& loop : value.array(0, max_rows)) {
    units::Contour joined;
    for (Segment& row : read_rows(loop)) {
      if (!joined.empty()) {
        const Point& last = joined.back().end;
        if (std::hypot(last.r - row.start.r, last.z - row.start.z) > units::vertex_tolerance) {
          joined.push_back({last, row.start, {}});
        }
      }
      joined.push_back(row);
    }
    const Point& last = joined.back().end;
    const Point& first = joined.front().start;
    if (std::hypot(last.r - first.r, last.z - first.z) > units::vertex_tolerance) {
      joined.push_back({last, first, {}});
    }
    count += joined.size();
    if (count > max_rows) value.refuse("at most " + std::to_string(max_rows) + " rows");
    loops.push_back(std::move(joined));
  }
  return units::region_of(loops);
}

}  // namespace ridgeline::jobs
