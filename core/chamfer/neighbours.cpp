#include "core/chamfer/neighbours.hpp"

#include <cmath>

#include "core/base/text.hpp"
#include "core/geometry/material.hpp"

namespace ridgeline::chamfer {
namespace {

constexpr double touching = 1e-6;  ///< walls of holes that lie in one another are no collision [mm]

}  // namespace

std::vector<Neighbour> neighbours(const Job& job, const std::vector<CutPoint>& borders,
                                  double within, const Progress& progress) {
  const geometry::Material material = geometry::material_of(job.workpiece);
  const std::vector<geometry::Hole>& holes = job.workpiece.holes;
  const std::size_t first = material.cavities.size() - holes.size();  // before them: the bore
  std::vector<Neighbour> near;
  for (std::size_t i = 0; i < holes.size(); ++i) {
    progress.at(static_cast<double>(i) / static_cast<double>(holes.size()), "neighbours");
    if (holes[i].name == job.hole) continue;
    Neighbour neighbour{.hole = holes[i].name, .distance = within, .at = {}};
    bool is_near = false;
    for (const CutPoint& border : borders) {
      for (const Eigen::Vector3d& G : {border.G1, border.G2}) {
        const double distance = geometry::distance(material.cavities[first + i], G);
        if (!(distance < neighbour.distance)) continue;
        neighbour.distance = distance;
        neighbour.at = border;
        is_near = true;
      }
    }
    if (is_near) near.push_back(neighbour);
  }
  return near;
}

void require_clear(const std::vector<Neighbour>& neighbours, double width) {
  for (const Neighbour& neighbour : neighbours) {
    if (!(neighbour.distance < -touching)) continue;
    throw Error(ErrorCode::WidthTooLarge,
                "the chamfer runs " + text(-neighbour.distance, "mm") + " into hole \"" +
                    neighbour.hole + "\"",
                {.field = "/width",
                 .value = text(width, "mm"),
                 .limit = "a chamfer that stays clear of hole \"" + neighbour.hole + "\"",
                 .parameter = neighbour.at.u,
                 .target = neighbour.at.P});
  }
}

std::string warning(const Neighbour& neighbour) {
  constexpr double steps = 1e4;  // a warning needs no more digits
  const double distance = std::round(neighbour.distance * steps) / steps;
  return "the chamfer passes hole \"" + neighbour.hole + "\" at " + text(distance, "mm") +
         ": as wide a chamfer of its edge meets this one";
}

}  // namespace ridgeline::chamfer
