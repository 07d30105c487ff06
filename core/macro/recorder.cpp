#include "core/macro/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace ridgeline::macro {

namespace {

constexpr std::size_t first_room = 1024;  // moves
constexpr std::size_t many_moves = 100'000;
constexpr double full_turn_slack = 1e-9;  // [rad], rounding of a full circle's angle

double length_of(const Segment& segment) {
  if (segment.kind != MoveKind::Arc) return (segment.to - segment.from).norm();
  const Eigen::Vector2d radius =
      in_plane(segment.plane, segment.from) - in_plane(segment.plane, segment.centre);
  const int third = path::axes_of(segment.plane).third;
  return std::hypot(radius.norm() * segment.sweep, segment.to[third] - segment.from[third]);
}

ArcDetail arc_detail(const Segment& segment) {
  const int third = path::axes_of(segment.plane).third;
  ArcDetail arc;
  arc.plane = segment.plane;
  arc.sense =
      segment.counter_clockwise ? path::ArcSense::CounterClockwise : path::ArcSense::Clockwise;
  arc.centre = segment.centre - segment.shift;
  arc.centre[third] = segment.from[third] - segment.shift[third];
  arc.turns = static_cast<int>((segment.sweep + full_turn_slack) / (2 * std::numbers::pi));
  return arc;
}

}  // namespace

std::uint32_t Recorder::shift_index(const WorkShift& shift) {
  if (result_.shifts.empty() || !(result_.shifts.back() == shift)) {
    result_.shifts.push_back(shift);
  }
  return static_cast<std::uint32_t>(result_.shifts.size() - 1);
}

void Recorder::move(const Segment& segment) {
  if (result_.motion.size() >= move_limit_) {
    raise(AlarmNumber::MemoryLimit, std::to_string(move_limit_) + " moves");
  }
  std::vector<Move>& motion = result_.motion;
  if (motion.size() == motion.capacity()) {                         // no farther than the limit
    const std::size_t factor = motion.size() < many_moves ? 2 : 8;  // copying many takes long
    motion.reserve(std::min(std::max(first_room, factor * motion.size()), move_limit_));
  }
  Move& move = motion.emplace_back();
  move.kind = segment.kind;
  move.machine_fixed = segment.machine_fixed;
  move.program = segment.program;
  move.line = segment.line;
  move.shift = segment.shift_index;
  move.to = segment.to - segment.shift;
  machine_ = segment.to;
  double feed = rapid_feed_;
  if (segment.kind == MoveKind::Arc) {
    move.detail = static_cast<std::uint32_t>(result_.arcs.size());
    result_.arcs.push_back(arc_detail(segment));
  }
  if (segment.kind == MoveKind::Line || segment.kind == MoveKind::Arc) {
    move.feed = feed = segment.feed;
  }
  if (segment.kind == MoveKind::Dwell) {
    move.detail = static_cast<std::uint32_t>(result_.dwells.size());
    result_.dwells.push_back(segment.seconds);
    result_.seconds += segment.seconds;
  } else if (feed > 0) {
    result_.seconds += length_of(segment) / feed * 60;
  }
}

void Recorder::event(std::string word, int program, int line) {
  if (result_.events.size() >= move_limit_) {
    raise(AlarmNumber::MemoryLimit, std::to_string(move_limit_) + " functions");
  }
  result_.events.push_back({result_.motion.size(), std::move(word), program, line});
}

void Recorder::axis(char axis, double to) {
  if (!result_.motion.empty()) result_.axes.push_back({result_.motion.size() - 1, axis, to});
}

void shorten(Result& result, std::size_t count) {
  const auto cut = [&](auto& list, const char* name) {
    if (list.size() <= count) return;
    result.warnings.push_back("of " + std::to_string(list.size()) + " " + name + " the first " +
                              std::to_string(count) + " are given");
    list.resize(count);
    list.shrink_to_fit();
  };
  cut(result.motion, "moves");
  cut(result.events, "functions");
  cut(result.messages, "messages");
  cut(result.prints, "lines of DPRNT");
  std::erase_if(result.axes, [&](const AxisMove& axis) { return axis.move >= count; });
}

}  // namespace ridgeline::macro
