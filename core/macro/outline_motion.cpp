#include "core/macro/outline_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/macro/compensation.hpp"
#include "core/macro/corner.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double same_point = 1e-6;     // [mm]
constexpr double rapid_feed = 20000;    // [mm/min], for the time only
constexpr double arc_tolerance = 0.03;  // [mm], ends of an arc about its centre

[[noreturn]] void refuse(const std::string& limit) {
  ErrorDetails details;
  details.field = "outline";
  details.limit = limit;
  throw Error(ErrorCode::BadInput, "outline must " + limit, details);
}

Segment segment_of(const Vector2d& from, const OutlineMove& move, double z, double feed) {
  Segment segment;
  segment.kind = move.centre ? MoveKind::Arc : MoveKind::Line;
  segment.from = {from.x(), from.y(), z};
  segment.to = {move.to.x(), move.to.y(), z};
  segment.feed = feed;
  if (!move.centre) return segment;
  const Vector2d a = from - *move.centre, b = move.to - *move.centre;
  segment.centre = {move.centre->x(), move.centre->y(), z};
  segment.counter_clockwise = move.counter_clockwise;
  double sweep = std::atan2(b.y(), b.x()) - std::atan2(a.y(), a.x());
  if (!move.counter_clockwise) sweep = -sweep;
  sweep = std::fmod(sweep, 2 * std::numbers::pi);
  if (sweep < 0) sweep += 2 * std::numbers::pi;
  segment.sweep = (a - b).norm() < same_point ? 2 * std::numbers::pi : sweep;
  return segment;
}

void check(const Outline& outline) {
  if (outline.moves.empty()) refuse("have at least one move");
  Vector2d from = outline.start;
  for (const OutlineMove& move : outline.moves) {
    if (!move.centre && (move.to - from).norm() < same_point) refuse("have no move of length 0");
    if (move.centre) {
      const double start = (from - *move.centre).norm(), end = (move.to - *move.centre).norm();
      if (start < same_point || std::abs(start - end) > arc_tolerance) {
        refuse("have arcs whose ends are at one distance from their centres");
      }
    }
    from = move.to;
  }
}

// A closed outline with a straight move begins in the middle of the longest.
void begin_on_longest(OutlinePath& path) {
  std::size_t longest = path.moves.size();
  double most = 0;
  Vector2d from = path.start, best_from = path.start;
  for (std::size_t i = 0; i < path.moves.size(); ++i) {
    const double length = (path.moves[i].to - from).norm();
    if (!path.moves[i].centre && length > most) {
      most = length;
      longest = i;
      best_from = from;
    }
    from = path.moves[i].to;
  }
  if (longest == path.moves.size()) return;
  const OutlineMove split = path.moves[longest];
  // To the increment that programs are written in, so that text and motion begin alike.
  const Vector2d middle =
      ((best_from + split.to) / 2).unaryExpr([](double x) { return std::round(x * 1000) / 1000; });
  std::rotate(path.moves.begin(), path.moves.begin() + static_cast<std::ptrdiff_t>(longest),
              path.moves.end());
  path.start = middle;
  OutlineMove last;
  last.to = middle;
  path.moves.push_back(last);
}

}  // namespace

OutlinePath outline_path(const Cycle& cycle, double offset) {
  const Outline& outline = *cycle.outline;
  check(outline);
  OutlinePath path;
  path.start = outline.start;
  path.moves = outline.moves;
  const bool is_closed = (path.moves.back().to - path.start).norm() < same_point;
  if (is_closed) begin_on_longest(path);
  const double lead = std::ceil(std::abs(offset) + cycle.D / 2 + cycle.z_clear);
  const double side = outline.tool_left ? lead : -lead;
  const auto rounded = [](const Vector2d& p) {
    return Vector2d(p.unaryExpr([](double x) { return std::round(x * 1000) / 1000; }));
  };
  const Vector2d before_last =
      path.moves.size() > 1 ? path.moves[path.moves.size() - 2].to : path.start;
  path.lead_in = rounded(
      path.start + side * left_of(start_tangent(segment_of(path.start, path.moves.front(), 0, 1))));
  path.lead_out =
      rounded(path.moves.back().to +
              side * left_of(end_tangent(segment_of(before_last, path.moves.back(), 0, 1))));
  return path;
}

void outline_motion(const Cycle& cycle, const std::vector<OffsetPass>& passes, Result& result,
                    const Progress& progress) {
  double most = 0;
  for (const OffsetPass& pass : passes) most = std::max(most, std::abs(pass.offset));
  const OutlinePath path = outline_path(cycle, most);
  Recorder recorder(result, std::numeric_limits<std::size_t>::max(), rapid_feed);
  recorder.shift_index({});  // work and machine coordinates are the same
  Profile control;
  Compensation compensation(recorder, control);
  const auto send = [&](MoveKind kind, const Vector3d& to, double feed, double offset) {
    Segment segment;
    segment.kind = kind;
    segment.from = recorder.machine();
    segment.to = to;
    segment.feed = feed;
    segment.offset = offset;
    compensation.move(segment);
  };
  const auto at = [](const Vector2d& p, double z) { return Vector3d(p.x(), p.y(), z); };
  try {
    for (std::size_t i = 0; i < passes.size(); ++i) {
      progress.at(static_cast<double>(i) / static_cast<double>(passes.size()), "cycle");
      const double offset = cycle.outline->tool_left ? passes[i].offset : -passes[i].offset;
      const double z = passes[i].z_tip, h = cycle.z_clear;
      send(MoveKind::Rapid, at(path.lead_in, h), 0, 0);
      send(MoveKind::Line, at(path.lead_in, z), cycle.approach_feed, 0);
      send(MoveKind::Line, at(path.start, z), cycle.feed, offset);
      Vector2d from = path.start;
      for (const OutlineMove& move : path.moves) {
        Segment segment = segment_of(from, move, z, cycle.feed);
        segment.offset = offset;
        compensation.move(segment);
        from = move.to;
      }
      Segment out;
      out.kind = MoveKind::Line;
      out.from = at(from, z);
      out.to = at(path.lead_out, z);
      out.feed = cycle.feed;
      compensation.move(out);
      send(MoveKind::Line, at(path.lead_out, h), cycle.approach_feed, 0);
    }
  } catch (const AlarmRaised& raised) {
    refuse("leave room for the offset " + number_text(most) + " mm: " + raised.alarm.message);
  }
}

}  // namespace ridgeline::macro
