#include "core/macro/corner_break.hpp"

#include <cmath>

#include "core/macro/alarm.hpp"
#include "core/macro/corner.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Sine of the turn below which two moves have no corner.
constexpr double no_corner = 1e-9;

double plane_length(const Segment& segment) {
  return (in_plane(segment.plane, segment.to) - in_plane(segment.plane, segment.from)).norm();
}

Vector3d at(const Segment& segment, double distance_from_start) {
  const double t = distance_from_start / plane_length(segment);
  return segment.from + t * (segment.to - segment.from);
}

}  // namespace

void CornerBreak::move(const Segment& segment) {
  if (!held_) {
    if (segment.chamfer > 0 || segment.corner_radius > 0) {
      held_ = segment;
    } else {
      next_.move(segment);
    }
    return;
  }
  if (!moves_in_plane(segment)) {
    raise(AlarmNumber::NoSolutionAtCorner, "the next block has no move in the plane");
  }
  if (held_->kind == MoveKind::Arc || segment.kind == MoveKind::Arc) {
    raise(AlarmNumber::NoSolutionAtCorner, ",C and ,R are offered between straight moves");
  }
  const Vector2d t1 = end_tangent(*held_);
  const Vector2d t2 = start_tangent(segment);
  const double sine = t1.x() * t2.y() - t1.y() * t2.x();
  Segment first = *held_;
  held_.reset();
  const double tangent = std::abs(sine) / (1 + t1.dot(t2));  // tan of half the turn
  const double cut = first.chamfer > 0 ? first.chamfer : first.corner_radius * tangent;
  Segment second = segment;
  if (std::abs(sine) > no_corner) {
    if (!(cut <= plane_length(first) && cut <= plane_length(second))) {
      raise(AlarmNumber::NoSolutionAtCorner, number_text(cut) + " mm of each move are needed");
    }
    Segment corner = first;
    corner.chamfer = corner.corner_radius = 0;
    corner.from = at(first, plane_length(first) - cut);
    corner.to = at(second, cut);
    if (first.chamfer <= 0) {
      corner.kind = MoveKind::Arc;
      corner.counter_clockwise = sine > 0;
      const Vector2d inward = sine > 0 ? left_of(t1) : Vector2d(-left_of(t1));
      corner.centre = with_plane(first.plane, corner.from,
                                 in_plane(first.plane, corner.from) + first.corner_radius * inward);
      corner.sweep = std::acos(std::min(1.0, std::max(-1.0, t1.dot(t2))));
    }
    first.to = corner.from;
    second.from = corner.to;
    first.chamfer = first.corner_radius = 0;
    next_.move(first);
    next_.move(corner);
  } else {
    first.chamfer = first.corner_radius = 0;
    next_.move(first);
  }
  for (const Function& function : functions_) {
    next_.event(function.word, function.program, function.line, function.alone);
  }
  functions_.clear();
  move(second);  // may itself end in a break
}

void CornerBreak::event(const std::string& word, int program, int line, bool alone) {
  if (held_) {
    functions_.push_back({word, program, line, alone});
  } else {
    next_.event(word, program, line, alone);
  }
}

void CornerBreak::flush() {
  if (!held_) return;
  Segment segment = *held_;
  held_.reset();
  segment.chamfer = segment.corner_radius = 0;
  next_.move(segment);
  for (const Function& function : functions_) {
    next_.event(function.word, function.program, function.line, function.alone);
  }
  functions_.clear();
}

}  // namespace ridgeline::macro
