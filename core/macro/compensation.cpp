#include "core/macro/compensation.hpp"

#include <cmath>
#include <numbers>

#include "core/macro/alarm.hpp"
#include "core/macro/corner.hpp"

namespace ridgeline::macro {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A block may run backwards by this much: rounding of the programmed ends [mm].
constexpr double backwards = 2e-3;

Segment displaced(Segment segment, const Vector2d& vector) {
  const auto move = [&](Vector3d& p) {
    p = with_plane(segment.plane, p, in_plane(segment.plane, p) + vector);
  };
  move(segment.from);
  move(segment.to);
  return segment;
}

double angle_of(const Vector2d& radius) {
  return std::atan2(radius.y(), radius.x());
}

// Angle that the arc sweeps between other ends on its offset circle, in its own sense.
double offset_sweep(const Segment& arc, const Vector3d& from, const Vector3d& to) {
  const auto angle = [&](const Vector3d& p) {
    return angle_of(in_plane(arc.plane, p) - in_plane(arc.plane, arc.centre));
  };
  const double sign = arc.counter_clockwise ? 1 : -1;
  const auto wrapped = [](double difference) {
    return std::remainder(difference, 2 * std::numbers::pi);
  };
  return arc.sweep +
         sign * (wrapped(angle(to) - angle(arc.to)) - wrapped(angle(from) - angle(arc.from)));
}

}  // namespace

void Compensation::move(const Segment& segment) {
  if (!active_) {
    if (segment.offset == 0 || !moves_in_plane(segment)) {
      recorder_.move(segment);
    } else {
      start(segment);
    }
    return;
  }
  if (!moves_in_plane(segment)) {
    if (segment.offset == 0) flush();  // G40 was commanded: the vector stays until the next move
    hold(segment, true);
  } else if (segment.offset == 0) {
    cancel(segment);
  } else {
    turn_corner(segment);
  }
}

void Compensation::event(const std::string& word, int program, int line, bool alone) {
  if (!active_ || !pending_) {
    recorder_.event(word, program, line);
    return;
  }
  hold(Function{word, program, line}, alone);
}

void Compensation::hold(Held held, bool counts) {
  if (!pending_) {
    if (const Segment* segment = std::get_if<Segment>(&held)) {
      recorder_.move(displaced(*segment, vector_));
    }
    return;
  }
  held_.push_back(std::move(held));
  if (counts && ++blind_ >= profile_.blind_blocks) flush();
}

void Compensation::start(const Segment& segment) {
  if (segment.kind == MoveKind::Arc) raise(AlarmNumber::ArcAtStartOrCancel);
  active_ = true;
  starting_ = true;
  pending_ = segment;
  from_ = segment.from;
  vector_ = Vector2d::Zero();
  blind_ = 0;
}

void Compensation::cancel(const Segment& segment) {
  if (segment.kind == MoveKind::Arc) raise(AlarmNumber::ArcAtStartOrCancel);
  flush();
  Segment last = segment;
  last.from = displaced(segment, vector_).from;
  recorder_.move(last);
  active_ = false;
  vector_ = Vector2d::Zero();
}

void Compensation::flush() {
  if (!pending_) return;
  const Vector2d normal = left_of(end_tangent(*pending_));
  finish_pending(in_plane(pending_->plane, pending_->to) + pending_->offset * normal);
  pending_.reset();
}

void Compensation::turn_corner(const Segment& next) {
  const Vector2d corner = in_plane(next.plane, next.from);
  CornerPath path;
  if (!pending_) {  // too few blocks were seen ahead: begins where the tool is
    path.begin = corner + vector_;
    path.end = path.begin;
    if (next.kind == MoveKind::Arc) {
      path.begin = corner + next.offset * left_of(start_tangent(next));
      path.extra = {path.begin};
    }
  } else if (starting_) {
    path.end = corner + next.offset * left_of(start_tangent(next));
    path.begin = path.end;
  } else {
    path = corner_path(*pending_, next);
  }
  if (pending_) finish_pending(path.end);
  for (const Vector2d& point : path.extra) {
    record_line(next, with_plane(next.plane, next.from, point));
  }
  vector_ = path.begin - corner;
  from_ = with_plane(next.plane, next.from, path.begin);
  pending_ = next;
  starting_ = false;
  blind_ = 0;
}

void Compensation::finish_pending(const Vector2d& end) {
  Segment segment = *pending_;
  const Vector3d to = with_plane(segment.plane, segment.to, end);
  if (!starting_) check_direction(segment, from_, to);
  if (segment.kind == MoveKind::Arc) segment.sweep = offset_sweep(segment, from_, to);
  segment.from = from_;
  segment.to = to;
  recorder_.move(segment);
  vector_ = end - in_plane(segment.plane, pending_->to);
  starting_ = false;
  for (Held& held : held_) {
    if (const Segment* move = std::get_if<Segment>(&held)) {
      recorder_.move(displaced(*move, vector_));
    } else {
      Function& function = std::get<Function>(held);
      recorder_.event(std::move(function.word), function.program, function.line);
    }
  }
  held_.clear();
}

void Compensation::record_line(const Segment& like, const Vector3d& to) {
  Segment line = like;
  if (line.kind == MoveKind::Arc) line.kind = MoveKind::Line;
  line.from = recorder_.machine();
  line.to = to;
  recorder_.move(line);
}

void Compensation::check_direction(const Segment& segment, const Vector3d& from,
                                   const Vector3d& to) const {
  if (!profile_.interference_check) return;
  double along = 0;
  if (segment.kind == MoveKind::Arc) {
    const double radius =
        (in_plane(segment.plane, to) - in_plane(segment.plane, segment.centre)).norm();
    along = offset_sweep(segment, from, to) * radius;
  } else {
    along =
        (in_plane(segment.plane, to) - in_plane(segment.plane, from)).dot(start_tangent(segment));
  }
  if (along < -backwards) {
    raise(AlarmNumber::Interference, "the compensated block runs backwards");
  }
}

}  // namespace ridgeline::macro
