#include "core/cutting/boundary.hpp"

namespace ridgeline::cutting {
namespace {

Boundary boundary_of(const Face& face) {
  if (const auto* plane = std::get_if<HalfSpace>(&face)) {
    return {.sign = 0, .a = plane->n, .c = Eigen::Vector3d::Zero(), .h = plane->h};
  }
  const Round& round = std::get<Round>(face);
  return {.sign = round.material == MaterialSide::Inside ? 1.0 : -1.0,
          .a = round.axis,
          .c = round.centre,
          .h = round.R * round.R};
}

}  // namespace

std::vector<Boundary> boundaries(const Stock& stock) {
  std::vector<Boundary> all;
  for (const Face& face : stock.faces) all.push_back(boundary_of(face));
  for (const Round& groove : stock.grooves) all.push_back(boundary_of(groove));
  return all;
}

}  // namespace ridgeline::cutting
