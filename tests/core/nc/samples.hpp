#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <random>
#include <string>

#include "core/nc/program.hpp"
#include "core/path/arc.hpp"

/// Programs for the tests of nc.
namespace ridgeline::nc {

using Eigen::Vector3d;
using path::MoveKind;

/// Motions of every kind of move, with coordinates that do not fit the decimals.
class RandomPrograms {
public:
  explicit RandomPrograms(unsigned seed) : random_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution(low, high)(random_);
  }
  int pick(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  Vector3d vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }

  Program program(Dialect dialect, int most_moves = 40) {
    Program program;
    program.dialect = dialect;
    program.number = pick(1, 9999);
    program.decimals = pick(1, 6);
    program.positioning = pick(0, 1) == 0 ? Positioning::Absolute : Positioning::Incremental;
    program.tool_number = pick(0, 1) * 12;
    program.spindle_speed = pick(0, 1) * 8000;
    program.coolant = static_cast<Coolant>(pick(0, 2));
    if (pick(0, 1) == 1) program.block_number_step = pick(1, 10);
    program.comments = {"random (" + std::to_string(pick(0, 999)) + ")",
                        "width 0.5 mm; \xC3\xB8 6"};
    set_axis(program);
    set_motion(program, most_moves);
    return program;
  }

private:
  void set_axis(Program& program) {
    const int choice = pick(0, 4);
    if (choice == 1) program.tool_axis = Vector3d::UnitX();
    if (choice == 2) program.tool_axis = -Vector3d::UnitY();
    if (choice < 3) return;
    program.tool_axis = (vector(1) + Vector3d(0, 0, 0.1)).normalized();
    const bool in_frame = choice == 4 || program.dialect == Dialect::LinuxCnc;
    program.tilted = in_frame ? TiltedOutput::WorkFrame : TiltedOutput::WorkPlane;
  }

  void set_motion(Program& program, int most_moves) {
    const Eigen::Matrix3d axes = plane_axes(program);
    path::Motion& motion = program.motion;
    Vector3d at = vector(50);
    motion.start = axes * at;
    const int moves = pick(1, most_moves);
    for (int n = 0; n < moves; ++n) {
      path::Move move = step(program, at);
      at = move.to;
      move.to = axes * move.to;
      if (move.arc) {
        move.arc->centre = axes * move.arc->centre;
        move.arc->axes = axes;
      }
      motion.moves.push_back(move);
    }
    // Closed: back to the start.
    motion.moves.push_back({MoveKind::Retract, motion.start, 0, std::nullopt});
  }

  /// A move from `at`, in the printed axes.
  path::Move step(const Program& program, const Vector3d& at) {
    static constexpr double sizes[] = {30, 3, 0.1, 0.003, 1e-5};
    const double size = sizes[pick(0, 4)];
    const int choice = pick(0, 9);
    if (choice == 0) return {MoveKind::Rapid, at + vector(size), 0, std::nullopt};
    if (choice == 1) return {MoveKind::Retract, at + vector(size), 0, std::nullopt};
    const MoveKind kind = static_cast<MoveKind>(pick(1, 4));
    const double feed = pick(0, 1) == 0 ? 5 : uniform(0.01, 100);
    if (choice < 5) return {kind, at + vector(size), feed, std::nullopt};
    return arc(program, at, kind, feed);
  }

  path::Move arc(const Program& program, const Vector3d& at, MoveKind kind, double feed) {
    path::Arc arc;
    arc.plane = static_cast<path::ArcPlane>(pick(0, 2));
    arc.sense = static_cast<path::ArcSense>(pick(0, 1));
    const auto [i, j, k] = path::axes_of(arc.plane);
    const double radius = pick(0, 3) == 0 ? uniform(0.2, 1) : uniform(1, 50);
    const double begin = uniform(0, 2 * std::numbers::pi);
    const bool is_full = pick(0, 5) == 0;
    const double sign = arc.sense == path::ArcSense::CounterClockwise ? 1 : -1;
    // A nearly closed arc on a coarse grid is refused: not here.
    const double turn = is_full ? 0 : sign * uniform(0.02, program.decimals < 3 ? 4.5 : 6.26);
    arc.centre = at;
    arc.centre[i] -= radius * std::cos(begin);
    arc.centre[j] -= radius * std::sin(begin);
    Vector3d to = at;
    if (!is_full) {
      to[i] = arc.centre[i] + radius * std::cos(begin + turn);
      to[j] = arc.centre[j] + radius * std::sin(begin + turn);
    }
    // HEIDENHAIN has helices in the working plane only.
    const bool may_rise = program.dialect != Dialect::Heidenhain || k == axis_index(program);
    if (pick(0, 1) == 1 && may_rise) to[k] += uniform(-3, 3);
    return {kind, to, feed, arc};
  }

  static int axis_index(const Program& program) {
    if (std::abs(program.tool_axis.x()) == 1) return 0;
    return std::abs(program.tool_axis.y()) == 1 ? 1 : 2;
  }

  std::mt19937 random_;
};

inline std::string dialect_name(Dialect dialect) {
  switch (dialect) {
    case Dialect::Fanuc: return "fanuc";
    case Dialect::Siemens: return "siemens";
    case Dialect::Heidenhain: return "heidenhain";
    default: return "linuxcnc";
  }
}

/// A chamfer of a plain hole by hand: in over the hole, down, out to the edge along an arc, around
/// in quarters, back to the middle and up.
inline Program hand_made_program(Dialect dialect) {
  using enum path::ArcSense;
  Program program;
  program.dialect = dialect;
  program.number = 9101;
  program.tool_number = 12;
  program.spindle_speed = 8000;
  program.comments = {"Ridgeline chamfer: tube-40 H1 (inner, entry)",
                      "width 0.5 mm, tolerance 0.002 mm, tool 12 \xC3\xB8"
                      "6 lollipop"};
  const path::Arc around{{0, 0, 0}, path::ArcPlane::XY, CounterClockwise};
  program.motion.start = {0, 0, 60};
  program.motion.moves = {
      {MoveKind::Rapid, {0, 0, 30}, 0, std::nullopt},
      {MoveKind::Approach, {0, 0, 17.65018172}, 1000 / 60.0, std::nullopt},
      {MoveKind::LeadIn,
       {2.78963415, 0, 17.65018172},
       2.5,
       path::Arc{{1.394817075, 0, 0}, path::ArcPlane::XY, CounterClockwise}},
      {MoveKind::Cut, {0, 3.06283466, 18.06283466}, 5, std::nullopt},
      {MoveKind::Cut, {-3.06283466, 0, 17.65018172}, 5, around},
      {MoveKind::Cut, {0, -3.06283466, 18.06283466}, 4.87654321, around},
      {MoveKind::Cut, {2.78963415, 0, 17.65018172}, 5, std::nullopt},
      {MoveKind::LeadOut, {0, 0, 17.65018172}, 10, std::nullopt},
      {MoveKind::Retract, {0, 0, 60}, 0, std::nullopt},
  };
  return program;
}

}  // namespace ridgeline::nc
