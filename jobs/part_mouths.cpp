#include "jobs/part_mouths.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "jobs/definitions.hpp"
#include "jobs/units_product.hpp"
#include "part/axis.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;

constexpr double square = 0.01;  // [degrees] of skew that is none

Vector3d vector(const Json& v) {
  return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

/// The hole of a mouth as a definition; a text with the reason where there is none.
Json hole_of(const Json& mouth) {
  const std::string kind = mouth.at("kind");
  Json hole = {{"name", mouth.at("name")},
               {"radius", mouth.at("radius")},
               {"walls", 1},
               {"axis", mouth.at("axis")},
               {"position", mouth.at("position")}};
  if (kind == "round") {
    hole["shape"] = "circle";
    return hole;
  }
  if (kind != "slot" && kind != "rounded_rectangle") return mouth.value("why", kind);
  const double skew = mouth.at("skew");
  const bool is_along = skew < square;
  if (!is_along && skew < 90 - square) {
    return "it lies askew by " + text(skew) + " degrees to the wall's axis";
  }
  const double r = mouth.at("radius");
  const double longer = mouth.at("length").get<double>() - 2 * r;
  const double shorter = std::max(0.0, mouth.at("width").get<double>() - 2 * r);
  hole["shape"] = "rounded_rectangle";
  hole["straight_along"] = is_along ? longer : shorter;
  hole["straight_across"] = is_along ? shorter : longer;
  if (kind == "slot" && is_along) {
    hole["shape"] = "elongated";
    hole.erase("straight_across");
  }
  return hole;
}

bool is_same_wall(const Json& a, const Json& b) {
  if (std::abs(a.at("radius").get<double>() - b.at("radius").get<double>()) > part::same_place) {
    return false;
  }
  return part::is_same_axis({vector(a.at("point")), vector(a.at("axis"))},
                            {vector(b.at("point")), vector(b.at("axis"))});
}

/// A block round a bore that holds the whole part, so that nothing of it is taken for air.
Json block_round(const Json& wall, const Json& mouths, const std::string& name) {
  const Vector3d low = vector(mouths.at("low"));
  const Vector3d high = vector(mouths.at("high"));
  const Vector3d axis = vector(wall.at("axis"));
  const Vector3d on_axis = vector(wall.at("point"));
  const Vector3d position = on_axis + ((low + high) / 2 - on_axis).dot(axis) * axis;
  double along = 0;
  double aside = 2 * wall.at("radius").get<double>();
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d p((corner & 1) != 0 ? high.x() : low.x(), (corner & 2) != 0 ? high.y() : low.y(),
                     (corner & 4) != 0 ? high.z() : low.z());
    const Vector3d d = p - position;
    along = std::max(along, std::abs(d.dot(axis)));
    aside = std::max(aside, (d - d.dot(axis) * axis).norm());
  }
  return {{"kind", "workpiece"},
          {"name", name},
          {"shape", "manifold_block"},
          {"position", vector_document(position)},
          {"axis", wall.at("axis")},
          {"bore_radius", wall.at("radius")},
          {"size", {2 * aside, 2 * along, 2 * aside}},
          {"holes", Json::array()}};
}

}  // namespace

Json chamfer_job(const std::string& workpiece, const std::string& hole, const char* edge,
                 const ChamferWish& wish) {
  return {{"job", "chamfer"},  {"workpiece", workpiece}, {"hole", hole},       {"edge", edge},
          {"tool", wish.tool}, {"tool_axis", "hole"},    {"width", wish.width}};
}

Json block_edges(const Json& mouths, const std::string& name,
                 const std::optional<ChamferWish>& wish) {
  Json workpieces = Json::array(), edges = Json::array(), unnamed = Json::array(),
       jobs = Json::array();
  std::vector<Json> walls;
  const auto leave = [&](const Json& mouth, const std::string& why) {
    unnamed.push_back({{"name", mouth.at("name")}, {"kind", mouth.at("kind")}, {"why", why}});
  };
  for (const Json& mouth : mouths.at("mouths")) {
    const Json hole = hole_of(mouth);
    const Json& wall = mouth.at("wall");
    if (hole.is_string()) {
      leave(mouth, hole.get<std::string>());
      continue;
    }
    if (!wall.at("is_bore").get<bool>()) {
      leave(mouth, "it lies on an outside of a part that is not turned");
      continue;
    }
    std::size_t place = 0;
    while (place < walls.size() && !is_same_wall(walls[place], wall)) ++place;
    Json workpiece = place < walls.size()
                         ? workpieces[place]
                         : block_round(wall, mouths, name + "-" + std::to_string(place + 1));
    workpiece["holes"].push_back(hole);
    try {
      validate_definition(workpiece);
    } catch (const Error& error) {
      leave(mouth, error.what());
      continue;
    }
    if (place == walls.size()) {
      walls.push_back(wall);
      workpieces.push_back(workpiece);
    } else {
      workpieces[place] = workpiece;
    }
    const std::string of = workpiece.at("name");
    const std::string hole_name = mouth.at("name");
    edges.push_back({{"workpiece", of}, {"hole", hole_name}, {"edge", "inner"}});
    if (wish) jobs.push_back(chamfer_job(of, hole_name, "inner", *wish));
  }
  return {{"job", "units"},
          {"status", "ok"},
          {"operation", "holes"},
          {"workpieces", std::move(workpieces)},
          {"edges", std::move(edges)},
          {"unnamed", std::move(unnamed)},
          {"mouths", mouths.at("mouths")},
          {"jobs", std::move(jobs)}};
}

}  // namespace ridgeline::jobs
