#include <cmath>
#include <numbers>
#include <string>

#include "core/base/angle.hpp"
#include "core/macro/nc_executor.hpp"
#include "core/macro/system_variables.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double largest = 1e6;      // a coordinate beyond has too many digits [mm, deg]
constexpr double same_point = 1e-7;  // [mm]
constexpr double no_turn = 1e-12;    // [rad]

double rounded_to(double value, double increment) {
  const double per_unit = std::round(1 / increment);
  return std::round(value * per_unit) / per_unit + 0.0;
}

}  // namespace

double NcExecutor::length_word(char letter) const {
  const double step = increment(state_);
  const double value = words_->is_scaled(letter) ? (*words_)[letter] * step : (*words_)[letter];
  if (!(std::abs(value) < largest)) {
    raise(AlarmNumber::TooManyDigits, std::string(1, letter), words_->column_of(letter));
  }
  return rounded_to(value, step) * unit(state_);
}

double NcExecutor::angle_word(char letter) const {
  const double step = state_.profile.increment;
  const double value = words_->is_scaled(letter) ? (*words_)[letter] * step : (*words_)[letter];
  if (!(std::abs(value) < largest)) {
    raise(AlarmNumber::TooManyDigits, std::string(1, letter), words_->column_of(letter));
  }
  return rounded_to(value, step);
}

double NcExecutor::coordinate(char letter) const {
  return is_rotary(axis_index(letter)) ? angle_word(letter) : length_word(letter);
}

Axes NcExecutor::target() {
  Axes to = state_.position;
  const bool is_absolute = state_.modal.distance == 900;
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (!words_->has(axis_names[i])) continue;
    const double value = coordinate(axis_names[i]);
    to[i] = is_absolute ? value : to[i] + value;
  }
  if (is_absolute) drop_drift();
  if (state_.modal.polar == 160) polar_target(to);
  return to;
}

// The first absolute move after G68 leaves the position at G68 behind.
void NcExecutor::drop_drift() {
  if (!state_.rotation.is_active) return;
  const path::PlaneAxes axes = path::axes_of(state_.rotation.plane);
  if (words_->has(axis_names[axes.first]) || words_->has(axis_names[axes.second])) {
    state_.rotation.drift.setZero();
  }
}

// G16: the plane's first axis is the radius, the second the angle. A radius in G91 begins where the
// tool is, one in G90 at zero, and keeps that for the angles that follow.
void NcExecutor::polar_target(Axes& to) {
  const path::PlaneAxes axes = path::axes_of(plane_of(state_.modal));
  const char radius_name = axis_names[axes.first];
  const char angle_name = axis_names[axes.second];
  if (!words_->has(radius_name) && !words_->has(angle_name)) return;
  const bool is_absolute = state_.modal.distance == 900;
  const auto first = static_cast<std::size_t>(axes.first);
  const auto second = static_cast<std::size_t>(axes.second);
  if (words_->has(radius_name)) {
    state_.polar[0] = length_word(radius_name);
    state_.pole =
        is_absolute ? Vector2d::Zero() : Vector2d(state_.position[first], state_.position[second]);
  }
  if (words_->has(angle_name)) {
    const double angle = angle_word(angle_name);
    state_.polar[1] = is_absolute ? angle : state_.polar[1] + angle;
  }
  const double angle = radians(state_.polar[1]);
  to[first] = state_.pole[0] + state_.polar[0] * std::cos(angle);
  to[second] = state_.pole[1] + state_.polar[0] * std::sin(angle);
}

Segment NcExecutor::segment(MoveKind kind) {
  Segment segment;
  segment.kind = kind;
  segment.plane = plane_of(state_.modal);
  segment.program = program_;
  segment.line = line_;
  segment.from = linear(state_.machine);
  WorkShift shift;
  shift.shift = linear(shift_of(state_));
  shift.local = linear(state_.local) + linear(state_.preset);
  shift.work_offset =
      state_.modal.work_offset == 541 ? 541000 + state_.modal.P : state_.modal.work_offset / 10;
  shift.length_code = state_.modal.length / 10;
  shift.H = state_.modal.H;
  segment.shift = shift.shift;
  segment.shift_index = recorder_.shift_index(shift);
  segment.offset = kind == MoveKind::Dwell ? 0 : side_offset();
  return segment;
}

// To the left of the path under G41; mirror images change sides.
double NcExecutor::side_offset() const {
  if (state_.modal.compensation == 400) return 0;
  const double radius = radius_offset(state_, state_.modal.D);
  if (radius != 0 && state_.rotation.is_active && state_.rotation.plane != plane_of(state_.modal)) {
    raise(AlarmNumber::PlaneMismatch, "cutter compensation");
  }
  const double side = state_.modal.compensation == 410 ? 1 : -1;
  return reverses_arcs(state_, plane_of(state_.modal)) ? -side * radius : side * radius;
}

double NcExecutor::feed_of(double length) const {
  const Modal& modal = state_.modal;
  if (!(modal.F > 0)) raise(AlarmNumber::NoFeedrate);
  if (modal.feed_mode == 930) return modal.F * length;
  const double feed = modal.F * unit(state_);
  return modal.feed_mode == 950 && modal.S > 0 ? feed * modal.S : feed;
}

void NcExecutor::send(const Segment& segment) {
  corner_break_.move(segment);
}

// Completes a segment whose `to` is the machine position of `to`, and stands there.
void NcExecutor::move_to(Segment segment, const Axes& to) {
  const Axes machine = to_machine(state_, to);
  segment.to = linear(machine);
  if (segment.kind == MoveKind::Line) {
    segment.feed = feed_of((segment.to - segment.from).norm());
  }
  bool turns = false;
  for (std::size_t i = 3; i < axis_count; ++i) turns = turns || machine[i] != state_.machine[i];
  if (turns) finish();  // an axis outside X, Y, Z ends look-ahead
  send(segment);
  for (std::size_t i = 3; i < axis_count; ++i) {
    if (machine[i] != state_.machine[i]) recorder_.axis(axis_names[i], to[i]);
  }
  state_.position = to;
  state_.machine = machine;
  moved_ = moved_ || has_axis_word();
}

void NcExecutor::straight(MoveKind kind, const Axes& to) {
  Segment line = segment(kind);
  if (kind == MoveKind::Line) {
    if (words_->has('c')) line.chamfer = length_word('c');
    if (words_->has('r')) line.corner_radius = length_word('r');
  }
  const Axes machine = to_machine(state_, to);
  if (!has_axis_word() && machine == state_.machine) return;  // G43 without any change
  move_to(line, to);
}

// G02 G03 in the selected plane; motion of the third axis makes a helix.
void NcExecutor::arc(const Axes& to) {
  const path::ArcPlane plane = plane_of(state_.modal);
  const path::PlaneAxes axes = path::axes_of(plane);
  if (state_.rotation.is_active && state_.rotation.plane != plane) {
    raise(AlarmNumber::PlaneMismatch, "arc");
  }
  if (switches_compensation_) raise(AlarmNumber::ArcAtStartOrCancel);  // also with D 0
  const bool is_left = state_.modal.motion == 30;
  const Vector2d start = in_plane(plane, linear(state_.position));
  const Vector2d end = in_plane(plane, linear(to));
  if (!words_->has('R') && !words_->has("IJK"[axes.first]) && !words_->has("IJK"[axes.second])) {
    raise(AlarmNumber::NoArcRadius);
  }
  if (words_->has('R') && (end - start).norm() < same_point) {  // no arc is defined: no motion
    straight(MoveKind::Line, to);
    return;
  }
  const Vector2d centre = arc_centre(start, end, is_left);
  Segment arc = segment(MoveKind::Arc);
  const double angle = std::atan2(end.y() - centre.y(), end.x() - centre.x()) -
                       std::atan2(start.y() - centre.y(), start.x() - centre.x());
  double sweep = std::fmod(is_left ? angle : -angle, 2 * std::numbers::pi);
  if (sweep < 0) sweep += 2 * std::numbers::pi;
  const bool is_full = (end - start).norm() < same_point;
  arc.sweep = is_full || sweep < no_turn ? 2 * std::numbers::pi : sweep;
  arc.counter_clockwise = is_left != reverses_arcs(state_, plane);
  if (state_.scaling.is_active &&
      std::abs(state_.scaling.factor[axes.first]) != std::abs(state_.scaling.factor[axes.second])) {
    raise(AlarmNumber::ImproperCommand, "an arc scaled unequally in its plane");
  }
  arc.centre = transformed(state_, with_plane(plane, linear(state_.position), centre)) + arc.shift;
  const double radius = (end - centre).norm();
  arc.feed = feed_of(
      std::hypot(radius * arc.sweep, to[static_cast<std::size_t>(axes.third)] -
                                         state_.position[static_cast<std::size_t>(axes.third)]));
  move_to(arc, to);
}

// Centre from R (minus: the major arc) or from I J K, the way from start to centre.
Vector2d NcExecutor::arc_centre(const Vector2d& from, const Vector2d& to,
                                bool counter_clockwise) const {
  const path::PlaneAxes axes = path::axes_of(plane_of(state_.modal));
  if (!words_->has('R')) {
    const auto way = [&](int axis) {
      const char letter = "IJK"[axis];
      return words_->has(letter) ? length_word(letter) : 0.0;
    };
    Vector2d centre = from + Vector2d(way(axes.first), way(axes.second));
    const double start_radius = (from - centre).norm();
    const double end_radius = (to - centre).norm();
    if (start_radius < same_point) raise(AlarmNumber::NoArcRadius, "radius 0");
    if (std::abs(start_radius - end_radius) > state_.profile.arc_tolerance) {
      raise(AlarmNumber::ArcRadiusDifference,
            "start " + number_text(start_radius) + " mm, end " + number_text(end_radius) +
                " mm, limit " + number_text(state_.profile.arc_tolerance) + " mm");
    }
    return centre;
  }
  const double R = length_word('R');
  const Vector2d chord = to - from;
  const double half = chord.norm() / 2;
  if (std::abs(R) < half - state_.profile.arc_tolerance) {
    raise(AlarmNumber::ArcRadiusDifference,
          "R " + number_text(R) + " mm, the ends are " + number_text(2 * half) + " mm apart",
          words_->column_of('R'));
  }
  const double height = std::sqrt(std::max(0.0, R * R - half * half));
  const Vector2d left = Vector2d(-chord.y(), chord.x()) / (2 * half);
  const double side = counter_clockwise == (R > 0) ? 1 : -1;
  return (from + to) / 2 + side * height * left;
}

// G53: machine coordinates, absolute, this block only, without cutter compensation.
void NcExecutor::machine_move() {
  if (!has_axis_word()) return;
  Segment move = segment(state_.modal.motion == 0 ? MoveKind::Rapid : MoveKind::Line);
  move.offset = 0;
  move.machine_fixed = true;
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (words_->has(axis_names[i])) state_.machine[i] = coordinate(axis_names[i]);
  }
  move.to = linear(state_.machine);
  if (move.kind == MoveKind::Line) move.feed = feed_of((move.to - move.from).norm());
  send(move);
  follow_machine(state_);
  moved_ = true;
}

// G27: goes to the point as G00 and looks whether it is the reference position.
void NcExecutor::reference_check() {
  straight(MoveKind::Rapid, target());
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (!words_->has(axis_names[i])) continue;
    const double reference = i < 3 ? state_.profile.references[0][static_cast<int>(i)] : 0.0;
    if (std::abs(state_.machine[i] - reference) < state_.profile.increment / 2) continue;
    raise(AlarmNumber::NotAtReference,
          axis_names[i] + number_text(state_.machine[i]) + " mm instead of " +
              number_text(reference) + " mm in machine coordinates",
          words_->column_of(axis_names[i]));
  }
}

// G28, G30 P2..P4: through the given point to the reference position, the named axes only.
void NcExecutor::reference_return(int code) {
  if (!has_axis_word()) return;
  const int number = code == 280 || !words_->has('P')
                         ? (code == 280 ? 1 : 2)
                         : static_cast<int>(rounded_integer((*words_)['P'], 0));
  if (number < 1 || number > 4) raise(AlarmNumber::ArgumentRange, "G30 P2 to P4");
  const int compensation = state_.modal.compensation;
  state_.modal.compensation = 400;  // both moves go without
  intermediate_ = target();
  if (to_machine(state_, intermediate_) != state_.machine) {
    move_to(segment(MoveKind::Rapid), intermediate_);
  }
  Segment home = segment(MoveKind::Rapid);
  home.machine_fixed = true;
  const Vector3d& reference = state_.profile.references[static_cast<std::size_t>(number - 1)];
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (!words_->has(axis_names[i])) continue;
    state_.machine[i] = i < 3 ? reference[static_cast<int>(i)] : 0;
  }
  home.to = linear(state_.machine);
  send(home);
  follow_machine(state_);
  state_.modal.compensation = compensation;
  moved_ = true;
}

// G29: from the reference position through the point of the last G28 to the target; in G91 the way
// begins at that point.
void NcExecutor::from_reference() {
  Axes to = target();
  Axes through = state_.position;
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (!words_->has(axis_names[i])) continue;
    through[i] = intermediate_[i];
    if (state_.modal.distance == 910) to[i] += through[i] - state_.position[i];
  }
  move_to(segment(MoveKind::Rapid), through);
  move_to(segment(MoveKind::Rapid), to);
}

// G31: there is no probe here, so the move ends at its target and #5061.. hold that.
void NcExecutor::skip_move() {
  straight(MoveKind::Line, target());
  Axes shift = shift_of(state_);
  shift[2] -= state_.length;
  for (std::size_t i = 0; i < axis_count; ++i) state_.skip[i] = state_.machine[i] - shift[i];
}

}  // namespace ridgeline::macro
