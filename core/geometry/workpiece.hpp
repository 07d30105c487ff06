#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/frame.hpp"
#include "core/geometry/profile.hpp"
#include "core/geometry/ridge.hpp"

namespace ridgeline::geometry {

enum class BodyShape { ThickWalledCylinder, ManifoldBlock };

/// A hole as the shop names it, placed in the work frame. mm and unit vectors.
struct Hole {
  std::string name;
  Profile profile;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< a point on the hole axis A2
  Eigen::Vector3d axis =
      Eigen::Vector3d::UnitZ();  ///< direction of A2, out of the mouth on the entry side
  std::optional<double>
      eccentric_distance;       ///< f where given: must agree with the positions to 1e-6 mm
  int walls = 2;                ///< 2: through both walls, 1: only the wall on its + side
  std::optional<double> depth;  ///< blind hole: depth below the entry mouth along A2 [mm]
};

/// A workpiece with its holes, in the work frame.
struct Workpiece {
  std::string name;
  BodyShape shape = BodyShape::ThickWalledCylinder;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the axis A1, middle of the length
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();     ///< direction of A1
  double inner_radius = 0;                             ///< bore (both shapes)
  double outer_radius = 0;                             ///< thick_walled_cylinder
  double length = 0;                                   ///< along A1: thick_walled_cylinder
  Eigen::Vector3d size = Eigen::Vector3d::Zero();      ///< manifold_block: across, along A1, up
  std::vector<Hole> holes;
};

/// Which edge of a hole: the ridge of `hole` with the bore (inner) or the outside (outer), on the
/// side of +A2 (entry) or the other (exit).
enum class EdgeKind { Inner, Outer };

/// The hole frame of two axes (position and direction each): z' along A2, x' along A1 x A2, y' = z'
/// x x', origin on A2 at the foot of the common perpendicular. A1 passes x' = -f.
/// Throws Error{BadInput} when A2 is tilted 80 degrees or more towards A1.
Frame hole_frame(const Workpiece& workpiece, const Hole& hole);

/// f, signed: where A1 passes the hole axis is x' = -f in the hole frame [mm].
double eccentric_distance(const Workpiece& workpiece, const Hole& hole);

/// A point of A2 for a hole that is placed by f alone: the workpiece position moved by f along x'.
Eigen::Vector3d position_of(const Workpiece& workpiece, const Eigen::Vector3d& hole_axis, double f);

/// Frame of a manifold block, centred: x across, y along A1, z up (the part of Z square to A1; for
/// an upright bore x is the work X).
Frame block_frame(const Workpiece& workpiece);

/// Height z' in the hole frame of the floor of a blind hole: `depth` below where A2 leaves the
/// outside on the + side. nullopt: no depth given. Throws Error{HoleMissesBody} when A2 misses.
std::optional<double> floor_height(const Workpiece& workpiece, const Hole& hole);

/// Builds the edge in the hole frame. Throws Error: InconsistentEccentricity, TangentIntersection,
/// HoleMissesBody (no closed edge there, or walls = 1 and exit), BadInput (radii, lengths).
Edge edge_of(const Workpiece& workpiece, const Hole& hole, EdgeKind kind, Side side);

/// Everything that is not air: for collision and overcut. Negative in the material [mm]. Exact in
/// sign; in the air it never exceeds the true distance. Includes every hole of the workpiece and
/// its finite length.
double material_distance(const Workpiece& workpiece, const Eigen::Vector3d& point);

}  // namespace ridgeline::geometry
