#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "core/macro/profile.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::macro {

/// Axes in the order of the system variables: #5001 is X.
constexpr int axis_count = 9;
constexpr char axis_names[axis_count + 1] = "XYZABCUVW";
using Axes = std::array<double, axis_count>;

/// -1 when the address is no axis.
constexpr int axis_index(char letter) {
  for (int i = 0; i < axis_count; ++i) {
    if (axis_names[i] == letter) return i;
  }
  return -1;
}
constexpr bool is_rotary(int axis) {
  return axis >= 3 && axis <= 5;
}
inline Eigen::Vector3d linear(const Axes& axes) {
  return {axes[0], axes[1], axes[2]};
}

/// G codes in force, by group, in tenths (G54.1 is 541), and the last value of other addresses.
struct Modal {
  int motion = 0;       ///< G00 G01 G02 G03 G33
  int plane = 170;      ///< G17 G18 G19
  int distance = 900;   ///< G90 G91
  int stroke = 230;     ///< G22 G23
  int feed_mode = 940;  ///< G93 G94 G95
  int units = 210;      ///< G20 G21
  int compensation = 400;
  int length = 490;
  int canned = 800;
  int return_level = 980;
  int scaling = 500;
  int surface_speed = 970;
  int work_offset = 540;
  int cutting_mode = 640;
  int modal_call = 670;
  int rotation = 690;
  int polar = 150;
  int mirror = 501;  ///< G50.1 G51.1
  int D = 0, H = 0, M = 0, N = 0, O = 0, T = 0, P = 0;
  double F = 0;  ///< as programmed, in the units of then [mm/min or inch/min]
  double S = 0;
  double B = 0, E = 0;
};

/// Offset memory and work offsets. mm, deg.
struct Offsets {
  static constexpr int registers = 1000;
  static constexpr int work_offsets = 7 + 300;  ///< external, G54..G59, G54.1 P1..P300
  std::vector<double> length_geometry = std::vector<double>(registers);
  std::vector<double> length_wear = std::vector<double>(registers);
  std::vector<double> radius_geometry = std::vector<double>(registers);
  std::vector<double> radius_wear = std::vector<double>(registers);
  std::vector<Axes> work = std::vector<Axes>(work_offsets, Axes{});
};

/// G68: turns about `centre` in `plane`. `drift`: what keeps incremental moves going on from the
/// position at G68 until an absolute one (design section 2.5).
struct Rotation {
  bool is_active = false;
  path::ArcPlane plane = path::ArcPlane::XY;
  double cosine = 1, sine = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d drift = Eigen::Vector3d::Zero();
};

/// G51 and G51.1: factors about a centre.
struct Scaling {
  bool is_active = false;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d factor = Eigen::Vector3d::Ones();
};

/// Everything that a control remembers besides variables and the program. mm, deg.
struct State {
  explicit State(const Profile& control) : profile(control) {}
  const Profile& profile;
  Modal modal;
  Offsets offsets;
  Axes position{};      ///< programmed, in the local coordinate system (#5001..)
  Axes machine{};       ///< programmed, before cutter compensation
  Axes local{};         ///< G52
  Axes preset{};        ///< G92
  Axes skip{};          ///< #5061.., in work coordinates
  int work_offset = 1;  ///< index into Offsets::work
  double length = 0;    ///< tool length offset in force, along Z
  Rotation rotation;
  Scaling scaling, mirror;
  Eigen::Vector2d polar = Eigen::Vector2d::Zero();  ///< G16: radius and angle [deg] in force
  Eigen::Vector2d pole = Eigen::Vector2d::Zero();   ///< G16: where the radius begins
  int main_program = 0;                             ///< #4000
  int spindle_tool = -1;                            ///< after M06; -1: no tool change yet
  std::map<int, double> plain;  ///< #1100.., #3003, #3004 and others that only store
};

/// mm of one programmed length unit: 1, or 25.4 under G20.
inline double unit(const State& state) {
  return state.modal.units == 200 ? 25.4 : 1.0;
}
/// Least input increment in programmed units.
inline double increment(const State& state) {
  return state.modal.units == 200 ? state.profile.inch_increment : state.profile.increment;
}
path::ArcPlane plane_of(const Modal& modal);

/// Machine minus work coordinates: work offset, external, G52, G92; with tool length on Z.
Axes shift_of(const State& state);
/// Programmed coordinates through mirror and scaling.
Eigen::Vector3d imaged(const State& state, const Eigen::Vector3d& programmed);
/// Programmed coordinates through mirror, scaling and rotation, still in the local system.
Eigen::Vector3d transformed(const State& state, const Eigen::Vector3d& programmed);
Eigen::Vector3d untransformed(const State& state, const Eigen::Vector3d& point);
/// Machine position of a programmed one.
Axes to_machine(const State& state, const Axes& programmed);
/// After a change of offsets or rotation: the machine stands still, `position` follows.
void follow_machine(State& state);
/// Do mirror images turn arcs of the plane round?
bool reverses_arcs(const State& state, path::ArcPlane plane);

}  // namespace ridgeline::macro
