#pragma once

#include <Eigen/Core>
#include <numbers>
#include <string>
#include <vector>

#include "core/units/region.hpp"

namespace ridgeline::units {

/// Point angle of a twist drill [rad]; document 004, S1108.
constexpr double drill_point_angle = 118 * std::numbers::pi / 180;

/// One stretch of a hole, from the mouth inwards: a cylinder, or a cone when the diameters differ.
struct HoleStep {
  double diameter = 0;      ///< at the end nearer the mouth [mm]
  double end_diameter = 0;  ///< at the other end [mm]
  double length = 0;        ///< along the axis [mm]
};

/// Through: the far end is open too, to the outside or into the bore.
enum class HoleBottom { Flat, Cone, Through };

/// A drilled hole of the product. Frame: turning axis on Z, low end of the product at Z = 0.
struct Hole {
  std::string name;
  Eigen::Vector3d start = Eigen::Vector3d::Zero();       ///< on its axis, on the envelope
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< the way the drill goes, unit
  double diameter = 0;                                   ///< of the narrowest cylinder [mm]
  double depth = 0;  ///< from start to the end of the last cylinder, without the cone [mm]
  HoleBottom bottom = HoleBottom::Through;
  double point_angle = drill_point_angle;  ///< of the cone at the bottom [rad]
  std::vector<HoleStep> steps;
  double volume = 0;  ///< of its material inside the envelope [mm^3]
};

/// A row of the outline of a face: a line, or an arc about a centre, seen against the normal.
struct FaceEdge {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d end = Eigen::Vector3d::Zero();
  bool is_arc = false;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  bool is_clockwise = false;
};

/// A plane bottom that a mill cuts: flat, slot, pocket.
struct MilledFace {
  std::string name;
  std::string form;                                   ///< "flat", "step", "slot", "pocket"
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< out of the product, unit
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< on the bottom
  double depth = 0;          ///< of the removed material above the bottom along the normal [mm]
  double length = 0;         ///< slots: over all, along; 0 otherwise [mm]
  double width = 0;          ///< slots [mm]
  double corner_radius = 0;  ///< least radius of the walls in plan, limits the cutter; 0: none
  std::vector<std::vector<FaceEdge>> outline;  ///< loops of the bottom, the outer one first
  double z0 = 0;                               ///< extent of the bottom
  double z1 = 0;
  double volume = 0;  ///< of its material inside the envelope [mm^3]
};

/// Material between envelope and product that no unit explains.
struct Remainder {
  std::string name;
  std::string why;
  double r0 = 0, r1 = 0, z0 = 0, z1 = 0;  ///< where
  double angle = 0;                       ///< polar angle of its middle [rad]
  double volume = 0;                      ///< [mm^3]
};

/// What planning needs to know of a product; from a STEP file by part/, or given. Frame: turning
/// axis on Z, low end at Z = 0, sense of Z as in the source; millimetres.
struct Product {
  std::string name;
  Region shadow;        ///< S: every (r, z) that some angle of the product reaches
  double volume = 0;    ///< of the product itself [mm^3]
  double x_length = 0;  ///< extents about the axis: 2 max|x|, 2 max|y| [mm]
  double y_length = 0;
  std::vector<Hole> holes;
  std::vector<MilledFace> faces;
  std::vector<Remainder> remainders;
  std::vector<std::string> notes;  ///< what the reader decided
};

}  // namespace ridgeline::units
