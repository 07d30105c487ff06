#include "jobs/page.hpp"

#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/error.hpp"
#include "core/path/arc.hpp"
#include "jobs/refuse.hpp"
#include "viewer/page.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::json;

constexpr std::size_t most_pieces = 200'000;  // a page of 12 MB
constexpr double screen_tolerance = 0.005;    // of arcs drawn as chords [mm]

void append(std::string& bytes, std::uint64_t bits, int count) {
  for (int i = 0; i < count; ++i) bytes += static_cast<char>((bits >> (8 * i)) & 0xFF);
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = (group << 8) | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? digits[(group >> (18 - 6 * k)) & 63U] : '=';
    }
  }
  return text;
}

Json array_of(const Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

/// Columns of a frame.
Json axes_of(const Eigen::Matrix3d& axes) {
  return {array_of(axes.col(0)), array_of(axes.col(1)), array_of(axes.col(2))};
}

/// x' y' z' of a hole as the hole frame has them, whatever the way its position is given.
Json hole_document(const geometry::Workpiece& workpiece, const geometry::Hole& hole) {
  const geometry::Frame frame = geometry::hole_frame(workpiece, hole);
  const std::optional<double> floor = geometry::floor_height(workpiece, hole);
  const double far = 4 * (workpiece.size.cwiseAbs().sum() + workpiece.outer_radius +
                          workpiece.length + (frame.origin - workpiece.position).norm());
  // One wall: the hole begins at the axis of the bore.
  const double from = floor ? *floor : hole.walls == 1 ? 0 : -far;
  return {{"name", hole.name},
          {"position", array_of(frame.origin)},
          {"axes", axes_of(frame.axes)},
          {"radius", hole.profile.R2},
          {"straight_along", hole.profile.straight_along},
          {"straight_across", hole.profile.straight_across},
          {"range", {from, far}}};
}

}  // namespace

std::string page(const Json& data) {
  const std::string_view whole = viewer::page();
  const std::size_t at = whole.find(viewer::page_marker);
  if (at == std::string_view::npos) {
    refuse({.code = ErrorCode::Unsupported,
            .field = "",
            .value = "html",
            .limit = "another format",
            .message = "this program was built without the viewer (RIDGELINE_VIEWER=OFF): it has "
                       "no format \"html\""});
  }
  std::string text(whole.substr(0, at));
  for (const char c : data.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";  // no text can close the script element
    } else {
      text += c;
    }
  }
  text += whole.substr(at + viewer::page_marker.size());
  return text;
}

Json page_points(const std::vector<Vector3d>& points) {
  std::string bytes;
  bytes.reserve(12 * points.size());
  for (const Vector3d& p : points) {
    for (const double v : {p.x(), p.y(), p.z()}) {
      append(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(v)), 4);
    }
  }
  return {{"f32", base64(bytes)}};
}

Json page_rows(const Json& document, std::initializer_list<PageRow> rows) {
  Json list = Json::array();
  for (const PageRow& row : rows) {
    const Json::json_pointer place("/" + std::string(row.key));
    if (!document.contains(place)) continue;
    const Json& value = document.at(place);
    list.push_back({{"key", row.key}, {"name", row.name}, {"value", value}, {"unit", row.unit}});
    if (value.is_null()) list.back()["missing"] = row.missing;
  }
  return list;
}

Json page_values(const std::vector<double>& values) {
  std::string bytes;
  bytes.reserve(8 * values.size());
  for (const double v : values) append(bytes, std::bit_cast<std::uint64_t>(v), 8);
  return {{"f64", base64(bytes)}};
}

Json document_of(const std::vector<PageChart>& charts) {
  constexpr std::array<const char*, 3> styles{"curve", "guide", "dots"};
  Json list = Json::array();
  for (const PageChart& chart : charts) {
    Json series = Json::array();
    for (const PageSeries& each : chart.series) {
      series.push_back({{"name", each.name},
                        {"style", styles.at(static_cast<std::size_t>(each.style))},
                        {"values", page_values(each.values)}});
    }
    list.push_back({{"title", chart.title},
                    {"unit", chart.unit},
                    {"scale", chart.scale},
                    {"series", std::move(series)}});
  }
  return list;
}

Json page_axis(const char* title, const std::vector<double>& values,
               const std::vector<double>& at) {
  Json axis = {{"title", title}, {"values", page_values(values)}};
  if (!at.empty()) axis["at"] = page_values(at);
  return axis;
}

PageMotion page_motion(const path::Motion& motion, const Progress& progress) {
  PageMotion drawn;
  for (const auto kind : {path::MoveKind::Rapid, path::MoveKind::Approach, path::MoveKind::LeadIn,
                          path::MoveKind::Cut, path::MoveKind::LeadOut, path::MoveKind::Retract}) {
    drawn.names.emplace_back(path::name(kind));
  }
  if (motion.moves.empty()) return drawn;
  drawn.start = motion.moves.front().to;  // how the control comes to the first is not known
  Vector3d from = drawn.start;
  constexpr double seconds = 60;
  for (std::size_t i = 1; i < motion.moves.size(); ++i) {
    progress.step(i, motion.moves.size(), "page");
    const path::Move& move = motion.moves[i];
    for (const Vector3d& p : path::sampled(from, move, screen_tolerance)) {
      drawn.kinds.push_back(static_cast<int>(move.kind));
      drawn.to.push_back(p);
      drawn.feeds.push_back(move.feed * seconds);
      drawn.moves.push_back(i);
    }
    from = move.to;
  }
  return drawn;
}

Json document_of(const PageMotion& motion) {
  if (motion.to.size() > most_pieces) {
    refuse({.code = ErrorCode::Unsupported,
            .field = "",
            .value = std::to_string(motion.to.size()) + " pieces of path",
            .limit = "at most " + std::to_string(most_pieces),
            .message = "the path has " + std::to_string(motion.to.size()) +
                       " pieces, too many for a page in the browser (at most " +
                       std::to_string(most_pieces) + "): ask for csv or json"});
  }
  return {{"names", motion.names},
          {"kinds", motion.kinds},
          {"start", array_of(motion.start)},
          {"to", page_points(motion.to)},
          {"feed", page_values(motion.feeds)},
          {"moves", motion.moves}};
}

Json page_part(const geometry::Workpiece& workpiece) {
  const bool is_block = workpiece.shape == geometry::BodyShape::ManifoldBlock;
  Json holes = Json::array();
  for (const geometry::Hole& hole : workpiece.holes) {
    holes.push_back(hole_document(workpiece, hole));
  }
  Json part = {{"shape", is_block ? "manifold_block" : "thick_walled_cylinder"},
               {"position", array_of(workpiece.position)},
               {"inner_radius", workpiece.inner_radius},
               {"holes", std::move(holes)}};
  if (is_block) {
    part["axes"] = axes_of(geometry::block_frame(workpiece).axes);
    part["size"] = array_of(workpiece.size);
    return part;
  }
  const Vector3d across = workpiece.axis.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << across, workpiece.axis, across.cross(workpiece.axis);
  part["axes"] = axes_of(axes);
  part["outer_radius"] = workpiece.outer_radius;
  part["length"] = workpiece.length;
  return part;
}

Json page_tool(const tool::Tool& tool, const Vector3d& axis, double control_to_centre) {
  Json document = {{"radius", tool::cutting_radius(tool)},
                   {"axis", array_of(axis)},
                   {"control_to_centre", control_to_centre}};
  const auto add = [&](const char* key, const std::optional<double>& value) {
    if (value) document[key] = *value;
  };
  add("neck_radius", tool.neck_radius);
  add("neck_length", tool.neck_length);
  add("shank_radius", tool.shank_radius);
  add("stickout", tool.stickout);
  add("holder_radius", tool.holder_radius);
  return document;
}

}  // namespace ridgeline::jobs
