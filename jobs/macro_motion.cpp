#include "jobs/macro_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/path/arc.hpp"
#include "jobs/svg.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Columns of a move. The names are in the order of the enumerations MoveKind, ArcPlane and
// ArcSense.
constexpr std::size_t columns = 18;

nlohmann::json column_description() {
  return nlohmann::json::parse(R"({"columns": [
    {"key": "kind", "names": ["rapid", "line", "arc", "dwell"]},
    {"key": "to", "size": 3},
    {"key": "machine", "size": 3},
    {"key": "centre", "size": 3},
    {"key": "plane", "names": ["XY", "ZX", "YZ"]},
    {"key": "sense", "names": ["cw", "ccw"]},
    {"key": "turns"},
    {"key": "feed"},
    {"key": "seconds"},
    {"key": "coordinates", "names": ["machine"]},
    {"key": "program"},
    {"key": "line"}]})");
}

void append(std::vector<double>& cells, const Vector3d& p) {
  cells.insert(cells.end(), {p.x(), p.y(), p.z()});
}

void append_move(const macro::Result& result, const macro::Move& move, std::vector<double>& cells) {
  constexpr double absent = std::numeric_limits<double>::quiet_NaN();
  cells.push_back(static_cast<double>(move.kind));
  append(cells, move.to);
  append(cells, macro::machine_of(result, move));
  if (move.kind == macro::MoveKind::Arc) {
    const macro::ArcDetail& arc = macro::arc_of(result, move);
    append(cells, arc.centre);
    cells.insert(cells.end(), {static_cast<double>(arc.plane), static_cast<double>(arc.sense),
                               static_cast<double>(arc.turns)});
  } else {
    cells.insert(cells.end(), 6, absent);
  }
  cells.push_back(move.feed);
  cells.push_back(move.kind == macro::MoveKind::Dwell ? result.dwells[move.detail] : absent);
  cells.push_back(move.machine_fixed ? 0 : absent);
  cells.push_back(move.program);
  cells.push_back(move.line);
}

/// The points of a move after `from`, arcs in steps of a few degrees.
void append_points(const macro::Result& result, const macro::Move& move, const Vector3d& from,
                   std::vector<Vector3d>& points) {
  if (move.kind == macro::MoveKind::Arc) {
    const macro::ArcDetail& arc = macro::arc_of(result, move);
    path::Move shape;
    shape.to = move.to;
    shape.feed = 1;
    shape.arc = path::Arc{arc.centre, arc.plane, arc.sense};
    constexpr double drawing_tolerance = 0.01;  // [mm]
    for (const Vector3d& p : path::sampled(from, shape, drawing_tolerance)) points.push_back(p);
    return;
  }
  points.push_back(move.to);
}

struct Curves {
  std::vector<std::vector<Vector3d>> rapids, cuts;
};

Curves curves_of(const macro::Result& result, const Progress& progress) {
  Curves curves;
  Vector3d at = Vector3d::Zero();
  bool is_first = true;
  bool was_rapid = false;
  for (std::size_t i = 0; i < result.motion.size(); ++i) {
    progress.step(i, result.motion.size(), "drawing");
    const macro::Move& move = result.motion[i];
    if (move.kind == macro::MoveKind::Dwell) continue;
    const bool is_rapid = move.kind == macro::MoveKind::Rapid;
    auto& list = is_rapid ? curves.rapids : curves.cuts;
    if (is_first || is_rapid != was_rapid) {
      list.push_back(is_first ? std::vector<Vector3d>() : std::vector<Vector3d>{at});
    }
    append_points(result, move, at, list.back());
    was_rapid = is_rapid;
    at = move.to;
    is_first = false;
  }
  return curves;
}

struct Bounds {
  Vector2d min = Vector2d::Constant(std::numeric_limits<double>::max());
  Vector2d max = Vector2d::Constant(std::numeric_limits<double>::lowest());
};

/// One view: the components i and j of every curve.
void draw_view(Svg& svg, const Curves& curves, int i, int j, double left, double right,
               const Progress& progress) {
  Bounds bounds;
  const auto flat = [&](std::span<const Vector3d> curve) {
    std::vector<Vector2d> points;
    points.reserve(curve.size());
    for (const Vector3d& p : curve) points.emplace_back(p[i], p[j]);
    return points;
  };
  for (const auto* list : {&curves.cuts, &curves.rapids}) {
    for (const auto& curve : *list) {
      for (std::size_t n = 0; n < curve.size(); ++n) {
        progress.step(n, curve.size(), "drawing");
        const Vector2d p(curve[n][i], curve[n][j]);
        bounds.min = bounds.min.cwiseMin(p);
        bounds.max = bounds.max.cwiseMax(p);
      }
    }
  }
  if (!(bounds.min.x() <= bounds.max.x())) return;
  const Vector2d margin = Vector2d::Constant(0.5);
  const View view{bounds.min - margin, bounds.max + margin, {left, 50}, {right, 560}};
  const auto draw = [&](const std::vector<Vector3d>& curve, std::string_view style) {
    constexpr std::size_t most = 50'000;  // points between two looks for a cancel
    for (std::size_t first = 0; first + 1 < curve.size(); first += most) {
      progress.at(1, "drawing");
      svg.polyline(
          view,
          flat(std::span(curve).subspan(first).first(std::min(most + 1, curve.size() - first))),
          style);
    }
  };
  for (const auto& curve : curves.rapids) {
    draw(curve, "hidden");
  }
  for (const auto& curve : curves.cuts) {
    draw(curve, "path");
  }
}

}  // namespace

Array macro_moves_array(std::string pointer, const macro::Result& result, nlohmann::json& document,
                        const Progress& progress) {
  document[nlohmann::json::json_pointer(pointer)] = column_description();
  Array array{std::move(pointer), {result.motion.size(), columns}, {}};
  array.values.reserve(columns * result.motion.size());
  for (std::size_t i = 0; i < result.motion.size(); ++i) {
    progress.step(i, result.motion.size(), "answer");
    append_move(result, result.motion[i], array.values);
  }
  return array;
}

std::string macro_drawing(const macro::Result& result, std::string_view title,
                          const Progress& progress) {
  Svg svg(1200, 600, title);
  const Curves curves = curves_of(result, progress);
  struct Side {
    int right, up;
    const char* name;
    double left;
  };
  constexpr double width = 370;
  for (const Side& side : {Side{0, 1, "X Y", 20}, Side{0, 2, "X Z", 415}, Side{1, 2, "Y Z", 810}}) {
    draw_view(svg, curves, side.right, side.up, side.left, side.left + width, progress);
    svg.text({side.left, 30}, side.name);
  }
  return std::move(svg).finish();
}

}  // namespace ridgeline::jobs
