#include "jobs/predict_stock.hpp"

#include "jobs/limits.hpp"

namespace ridgeline::jobs {
namespace {

using cutting::Combine;
using cutting::MaterialSide;

constexpr Choices<Combine, 2> combines{{{"all", Combine::All}, {"any", Combine::Any}}};
constexpr Choices<MaterialSide, 2> sides{
    {{"inside", MaterialSide::Inside}, {"outside", MaterialSide::Outside}}};

// Unit as it is when it is one already: scaling would change its last digit.
Eigen::Vector3d read_unit(const Value& value) {
  const Eigen::Vector3d given = value.vector3(between(-1e6, 1e6, ""));
  return std::abs(given.norm() - 1) < 1e-9 ? given : value.direction();
}

cutting::Round read_round(Object& object, double radius, MaterialSide side) {
  cutting::Round round;
  round.centre = object.required("centre").vector3(coordinate_range);
  round.axis = read_unit(object.required("axis"));
  round.R = object.number("radius", radius_range, radius);
  round.material = object.choice("material", sides, side);
  object.finish();
  return round;
}

cutting::Round read_groove(const Value& value, const cutting::Cut& cut) {
  if (value.json().is_object()) {
    Object object(value);
    return read_round(object, cut.cutter.r, MaterialSide::Outside);
  }
  return {value.vector3(coordinate_range), cutting::feed_direction(cut), cut.cutter.r,
          MaterialSide::Outside};
}

cutting::Face read_face(const Value& value) {
  Object object(value);
  if (!object.has("normal")) {
    object.required("radius");
    return read_round(object, 0, MaterialSide::Outside);
  }
  const cutting::HalfSpace plane{read_unit(object.required("normal")),
                                 object.number("height", coordinate_range)};
  object.finish();
  return plane;
}

std::shared_ptr<const cutting::HeightMap> read_map(const Value& value, cutting::Stock& stock) {
  Object object(value);
  auto map = std::make_shared<cutting::HeightMap>();
  const std::vector<Value> origin = object.required("origin").array(2, 2);
  map->origin = {origin[0].number(coordinate_range), origin[1].number(coordinate_range)};
  map->cell = object.number("cell", between(1e-4, 1e3, "mm"));
  map->columns = object.required("columns").integer(2, 20'000);
  const Value heights = object.required("heights");
  map->heights = heights.numbers(coordinate_range);
  const auto columns = static_cast<std::size_t>(map->columns);
  if (map->heights.size() % columns != 0 || map->heights.size() < 2 * columns) {
    heights.refuse("at least two whole rows of " + std::to_string(columns) + " heights");
  }
  map->rows = static_cast<int>(map->heights.size() / columns);
  stock.map_origin = object.required("at").vector3(coordinate_range);
  object.finish();
  return map;
}

// Plane stock: P.n <= depth - r, for a ball from its centre, for a square mill from its axis.
void read_plane(Object& object, cutting::Cut& cut) {
  const bool ball = cut.cutter.kind == cutting::CutterKind::Ball;
  const double depth = object.number(ball ? "c" : "a", between(0, 2 * cut.cutter.r, "mm"));
  cut.stock.faces.push_back(cutting::HalfSpace{cut.n, depth - cut.cutter.r});
}

}  // namespace

void read_stock(const Value& value, cutting::Cut& cut) {
  Object object(value);
  cut.n = read_unit(object.required("normal"));
  if (cut.cutter.kind == cutting::CutterKind::Square) {
    cut.cutter.height = object.number("ap", between(1e-4, 1e3, "mm"));
  }
  if (const std::optional<Value> faces = object.optional("faces")) {
    for (const Value& face : faces->array(1, 16)) cut.stock.faces.push_back(read_face(face));
  }
  cut.stock.combine = object.choice("combine", combines, Combine::All);
  if (const std::optional<Value> map = object.optional("map")) {
    cut.stock.map = read_map(*map, cut.stock);
  }
  if (object.has("c") || object.has("a") || (cut.stock.faces.empty() && !cut.stock.map)) {
    read_plane(object, cut);
  }
  if (const std::optional<Value> grooves = object.optional("grooves")) {
    for (const Value& groove : grooves->array(0, 64)) {
      cut.stock.grooves.push_back(read_groove(groove, cut));
    }
  }
  object.finish();
}

}  // namespace ridgeline::jobs
