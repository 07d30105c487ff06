#include "jobs/motion.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace ridgeline::jobs {
namespace {

// Columns of a move: kind; to; feed; arc: centre (2), plane, sense. The names are in the order of
// the enumerations MoveKind, ArcPlane and ArcSense.
constexpr std::size_t columns = 9;

nlohmann::json column_description() {
  return nlohmann::json::parse(R"({"columns": [
    {"key": "kind", "names": ["rapid", "approach", "lead_in", "cut", "lead_out", "retract"]},
    {"key": "to", "size": 3},
    {"key": "feed"},
    {"key": "arc", "columns": [{"key": "centre", "size": 2},
                               {"key": "plane", "names": ["XY", "ZX", "YZ"]},
                               {"key": "sense", "names": ["cw", "ccw"]}]}]})");
}

/// Indices of the two axes of a plane, the first turned into the second.
std::array<Eigen::Index, 2> plane_axes(path::ArcPlane plane) {
  switch (plane) {
    case path::ArcPlane::XY: return {0, 1};
    case path::ArcPlane::ZX: return {2, 0};
    case path::ArcPlane::YZ: return {1, 2};
  }
  throw Error(ErrorCode::Internal, "an arc plane without axes");
}

/// mm/s to mm/min without the noise of the way there and back: programs carry 0.001 mm/min.
double per_minute(double feed) {
  constexpr double steps = 1e6;
  return std::round(feed * 60 * steps) / steps;
}

void append_move(const path::Move& move, std::vector<double>& cells) {
  constexpr double absent = std::numeric_limits<double>::quiet_NaN();
  cells.insert(cells.end(), {static_cast<double>(move.kind), move.to.x(), move.to.y(), move.to.z(),
                             per_minute(move.feed)});
  if (!move.arc) {
    cells.insert(cells.end(), {absent, absent, absent, absent});
    return;
  }
  const Eigen::Vector3d centre = move.arc->axes.transpose() * move.arc->centre;
  const std::array<Eigen::Index, 2> axes = plane_axes(move.arc->plane);
  cells.insert(cells.end(), {centre[axes[0]], centre[axes[1]], static_cast<double>(move.arc->plane),
                             static_cast<double>(move.arc->sense)});
}

}  // namespace

Array points_array(std::string pointer, const std::vector<Eigen::Vector3d>& points,
                   const Progress& progress) {
  Array array{std::move(pointer), {points.size(), 3}, {}};
  array.values.reserve(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    progress.step(i, points.size(), "answer");
    const Eigen::Vector3d& p = points[i];
    array.values.insert(array.values.end(), {p.x(), p.y(), p.z()});
  }
  return array;
}

Array moves_array(std::string pointer, const path::Motion& motion, nlohmann::json& document,
                  const Progress& progress) {
  document[nlohmann::json::json_pointer(pointer)] = column_description();
  Array array{std::move(pointer), {motion.moves.size(), columns}, {}};
  array.values.reserve(columns * motion.moves.size());
  for (std::size_t i = 0; i < motion.moves.size(); ++i) {
    progress.step(i, motion.moves.size(), "answer");
    append_move(motion.moves[i], array.values);
  }
  return array;
}

}  // namespace ridgeline::jobs
