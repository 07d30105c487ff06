#include "jobs/units_product.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/angle.hpp"
#include "core/units/names.hpp"
#include "jobs/limits.hpp"
#include "jobs/units_shape.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
using units::FaceEdge;
using units::Hole;
using units::HoleBottom;
using units::HoleStep;
using units::MilledFace;
using units::Remainder;

constexpr Choices<HoleBottom, 3> bottoms{{
    {"flat", HoleBottom::Flat},
    {"cone", HoleBottom::Cone},
    {"through", HoleBottom::Through},
}};
constexpr Range place_range = between(-1e5, 1e5, "mm");
constexpr Range size_range = above(0, 1e5, "mm");
constexpr Range extent_range = between(0, 1e5, "mm");

Json edge_document(const FaceEdge& edge) {
  Json document = {{"pattern", edge.is_arc ? "arc" : "line"},
                   {"start", vector_document(edge.start)},
                   {"end", vector_document(edge.end)}};
  if (edge.is_arc) {
    document["centre"] = vector_document(edge.centre);
    document["sense"] = edge.is_clockwise ? "cw" : "ccw";
  }
  return document;
}

FaceEdge read_edge(const Value& value) {
  constexpr Choices<bool, 2> patterns{{{"line", false}, {"arc", true}}};
  constexpr Choices<bool, 2> senses{{{"cw", true}, {"ccw", false}}};
  Object object(value);
  FaceEdge edge;
  edge.is_arc = object.required("pattern").choice(patterns);
  edge.start = object.required("start").vector3(place_range);
  edge.end = object.required("end").vector3(place_range);
  if (edge.is_arc) {
    edge.centre = object.required("centre").vector3(place_range);
    edge.is_clockwise = object.required("sense").choice(senses);
  }
  object.finish();
  return edge;
}

std::string read_text(Object& object, std::string_view key) {
  const std::optional<Value> value = object.optional(key);
  return value ? shortened(value->string(), 400) : std::string();
}

struct Extent {
  double low = 0;
  double high = 0;
};
Extent read_extent(const Value& value, const Range& range) {
  const std::vector<Value> both = value.array(2, 2);
  const Extent extent{both[0].number(range), both[1].number(range)};
  if (!(extent.low <= extent.high)) value.refuse("[least, greatest]");
  return extent;
}

std::vector<HoleStep> read_steps(const Value& value) {
  std::vector<HoleStep> steps;
  for (const Value& each : value.array(0, 100)) {
    Object object(each);
    HoleStep step;
    step.diameter = object.number("diameter", extent_range);
    step.end_diameter = object.number("end_diameter", extent_range, step.diameter);
    step.length = object.number("length", extent_range);
    object.finish();
    steps.push_back(step);
  }
  return steps;
}

/// What a drill or a mill would cut, for features given without their volume.
double nominal_volume(const Hole& hole) {
  const auto frustum = [](double d0, double d1, double l) {
    return std::numbers::pi * l * (d0 * d0 + d0 * d1 + d1 * d1) / 12;
  };
  double sum = 0;
  for (const HoleStep& step : hole.steps) {
    sum += frustum(step.diameter, step.end_diameter, step.length);
  }
  if (hole.bottom == HoleBottom::Cone) {
    sum += frustum(hole.diameter, 0, hole.diameter / 2 / std::tan(hole.point_angle / 2));
  }
  return sum;
}

double nominal_volume(const MilledFace& face) {
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  for (const std::vector<FaceEdge>& loop : face.outline) {
    for (const FaceEdge& edge : loop) {
      const Eigen::Vector3d a = edge.start - face.point;
      const Eigen::Vector3d b = edge.end - face.point;
      twice += Eigen::Vector3d(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
                               a.x() * b.y() - a.y() * b.x());
    }
  }
  return twice.norm() / 2 * face.depth;
}

template <class T, class Read>
std::vector<T> read_list(Object& object, std::string_view key, const Read& read) {
  std::vector<T> list;
  const std::optional<Value> value = object.optional(key);
  if (!value) return list;
  for (const Value& each : value->array(0, max_holes)) list.push_back(read(each));
  return list;
}

template <class T, class Write>
Json list_document(const std::vector<T>& list, const Write& write) {
  Json document = Json::array();
  for (const T& each : list) document.push_back(write(each));
  return document;
}

}  // namespace

Json vector_document(const Eigen::Vector3d& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json hole_document(const Hole& hole) {
  Json document = {{"name", hole.name},
                   {"start", vector_document(hole.start)},
                   {"direction", vector_document(hole.direction)},
                   {"diameter", hole.diameter},
                   {"depth", hole.depth},
                   {"bottom", name_of(bottoms, hole.bottom)},
                   {"volume", hole.volume}};
  if (hole.bottom == HoleBottom::Cone) document["point_angle"] = degrees(hole.point_angle);
  document["steps"] = Json::array();
  for (const HoleStep& step : hole.steps) {
    document["steps"].push_back({{"diameter", step.diameter},
                                 {"end_diameter", step.end_diameter},
                                 {"length", step.length}});
  }
  return document;
}

Hole read_product_hole(const Value& value) {
  Object object(value);
  Hole hole;
  hole.name = read_text(object, "name");
  hole.start = object.required("start").vector3(place_range);
  hole.direction = object.required("direction").direction();
  hole.diameter = object.number("diameter", size_range);
  hole.depth = object.number("depth", size_range);
  hole.bottom = object.choice("bottom", bottoms, HoleBottom::Through);
  hole.point_angle =
      radians(object.number("point_angle", inside(10, 180, "degrees"), degrees(hole.point_angle)));
  if (const std::optional<Value> steps = object.optional("steps")) hole.steps = read_steps(*steps);
  if (hole.steps.empty()) hole.steps = {{hole.diameter, hole.diameter, hole.depth}};
  hole.volume = object.number("volume", section_volume_range, nominal_volume(hole));
  object.finish();
  return hole;
}

Json face_document(const MilledFace& face) {
  Json document = {{"name", face.name},
                   {"form", face.form},
                   {"normal", vector_document(face.normal)},
                   {"point", vector_document(face.point)},
                   {"depth", face.depth},
                   {"length", face.length},
                   {"width", face.width},
                   {"corner_radius", face.corner_radius},
                   {"z", {face.z0, face.z1}},
                   {"volume", face.volume}};
  document["outline"] = list_document(face.outline, [](const std::vector<FaceEdge>& loop) {
    return list_document(loop, edge_document);
  });
  return document;
}

MilledFace read_face(const Value& value) {
  Object object(value);
  MilledFace face;
  face.name = read_text(object, "name");
  face.form = read_text(object, "form");
  face.normal = object.required("normal").direction();
  face.point = object.required("point").vector3(place_range);
  face.depth = object.number("depth", extent_range);
  face.length = object.number("length", extent_range, 0);
  face.width = object.number("width", extent_range, 0);
  face.corner_radius = object.number("corner_radius", extent_range, 0);
  if (const std::optional<Value> outline = object.optional("outline")) {
    for (const Value& loop : outline->array(0, max_rows)) {
      face.outline.emplace_back();
      for (const Value& edge : loop.array(1, max_rows)) {
        face.outline.back().push_back(read_edge(edge));
      }
    }
  }
  face.z0 = face.z1 = face.point.z();
  if (const std::optional<Value> z = object.optional("z")) {
    const Extent extent = read_extent(*z, place_range);
    face.z0 = extent.low;
    face.z1 = extent.high;
  }
  face.volume = object.number("volume", section_volume_range, nominal_volume(face));
  object.finish();
  return face;
}

Json remainder_document(const Remainder& remainder) {
  return {{"name", remainder.name},
          {"why", remainder.why},
          {"r", {remainder.r0, remainder.r1}},
          {"z", {remainder.z0, remainder.z1}},
          {"angle", degrees(remainder.angle)},
          {"volume", remainder.volume}};
}

Remainder read_remainder(const Value& value) {
  Object object(value);
  Remainder remainder;
  remainder.name = read_text(object, "name");
  remainder.why = read_text(object, "why");
  const Extent r = read_extent(object.required("r"), extent_range);
  const Extent z = read_extent(object.required("z"), place_range);
  remainder.r0 = r.low;
  remainder.r1 = r.high;
  remainder.z0 = z.low;
  remainder.z1 = z.high;
  remainder.angle = radians(object.number("angle", turn_range, 0));
  remainder.volume = object.number("volume", section_volume_range);
  object.finish();
  return remainder;
}

Json product_document(const units::Product& product) {
  return {{"name", product.name},
          {"shape", region_document(product.shadow)},
          {"volume", product.volume},
          {"x_length", product.x_length},
          {"y_length", product.y_length},
          {"holes", list_document(product.holes, hole_document)},
          {"faces", list_document(product.faces, face_document)},
          {"remainders", list_document(product.remainders, remainder_document)},
          {"notes", product.notes}};
}

units::Product read_product(const Value& value) {
  Object object(value);
  units::Product product;
  product.name = read_text(object, "name");
  const Value shape = object.required("shape");
  product.shadow = read_region(shape);
  if (units::is_empty(product.shadow)) shape.refuse("contours that bound an area");
  product.holes = read_list<Hole>(object, "holes", read_product_hole);
  product.faces = read_list<MilledFace>(object, "faces", read_face);
  product.remainders = read_list<Remainder>(object, "remainders", read_remainder);
  double features = 0;
  for (const Hole& hole : product.holes) features += hole.volume;
  for (const MilledFace& face : product.faces) features += face.volume;
  for (const Remainder& rest : product.remainders) features += rest.volume;
  const double whole = units::volume(product.shadow);
  if (std::optional<double> volume = object.optional_number("volume", section_volume_range)) {
    product.volume = *volume;
  } else {
    product.volume = std::max(0.0, whole - features);
  }
  const double diameter = 2 * units::box(product.shadow).r1;
  product.x_length = object.number("x_length", extent_range, diameter);
  product.y_length = object.number("y_length", extent_range, diameter);
  if (const std::optional<Value> notes = object.optional("notes")) {
    for (const Value& note : notes->array(0, 1000)) {
      product.notes.push_back(shortened(note.string(), 400));
    }
  }
  object.finish();
  return product;
}

}  // namespace ridgeline::jobs
