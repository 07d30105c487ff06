#include "jobs/macro_page.hpp"

#include <vector>

#include "core/path/arc.hpp"
#include "jobs/page.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;

constexpr double screen_tolerance = 0.01;  // of arcs drawn as chords [mm]
constexpr std::size_t most_samples = 6000;

/// The points of a move after `from`, its end included.
std::vector<Vector3d> points_of(const macro::Result& result, const macro::Move& move,
                                const Vector3d& from) {
  if (move.kind != macro::MoveKind::Arc) return {move.to};
  const macro::ArcDetail& arc = macro::arc_of(result, move);
  path::Move shape;
  shape.to = move.to;
  shape.feed = 1;
  shape.arc = path::Arc{arc.centre, arc.plane, arc.sense};
  return path::sampled(from, shape, screen_tolerance);
}

PageMotion motion_of(const macro::Result& result, const Progress& progress) {
  PageMotion drawn;
  drawn.names = {"rapid", "line", "arc"};  // in the order of MoveKind; a dwell is no way
  bool is_first = true;
  Vector3d from = Vector3d::Zero();
  for (std::size_t i = 0; i < result.motion.size(); ++i) {
    progress.step(i, result.motion.size(), "page");
    const macro::Move& move = result.motion[i];
    if (move.kind == macro::MoveKind::Dwell) continue;
    if (is_first) {
      drawn.start = from = move.to;  // where the machine stood before is not known
      is_first = false;
      continue;
    }
    for (const Vector3d& p : points_of(result, move, from)) {
      drawn.kinds.push_back(static_cast<int>(move.kind));
      drawn.to.push_back(p);
      drawn.feeds.push_back(move.feed);
      drawn.moves.push_back(i);
    }
    from = move.to;
  }
  return drawn;
}

/// Feed and height along the path, with the axis that they share.
void add_charts(const PageMotion& motion, Json& data) {
  std::vector<double> travelled, feed, height;
  double length = 0;
  Vector3d from = motion.start;
  const std::size_t step = 1 + motion.to.size() / most_samples;
  for (std::size_t i = 0; i < motion.to.size(); ++i) {
    length += (motion.to[i] - from).norm();
    from = motion.to[i];
    if (i % step != 0) continue;
    travelled.push_back(length);
    feed.push_back(motion.feeds[i]);
    height.push_back(from.z());
  }
  data["charts"] = Json::array();
  if (travelled.empty()) return;
  data["along"] = page_axis("along the path [mm]", travelled, travelled);
  data["charts"] = document_of(
      {{"Feed (rapid: 0)", "mm/min", {{"feed", feed}}}, {"Height", "mm", {{"Z", height}}}});
}

Json report_rows(const Json& document) {
  return page_rows(document, {{"statements", "executed statements", ""},
                              {"machining_seconds", "machining time", "s"},
                              {"tool", "tool", ""},
                              {"spindle_speed", "spindle speed", "rev/min"},
                              {"cusp", "cusp height", "mm"}});
}

}  // namespace

std::string macro_page(const macro::Result& result, std::string_view title, const Json& document,
                       const Progress& progress) {
  const PageMotion motion = motion_of(result, progress);
  Json data = {{"job", document.at("job")},
               {"title", title},
               {"motion", document_of(motion)},
               {"report", report_rows(document)},
               {"warnings", Json::array()}};
  add_charts(motion, data);
  if (document.contains("warnings")) data["warnings"] = document.at("warnings");
  if (document.contains("alarm")) {
    data["warnings"].push_back("alarm " + document.at("alarm").at("number").dump() + ": " +
                               document.at("alarm").at("message").get<std::string>());
  }
  return page(data);
}

}  // namespace ridgeline::jobs
