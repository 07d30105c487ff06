#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/geometry/frame.hpp"
#include "core/geometry/profile.hpp"
#include "core/geometry/surface.hpp"
#include "core/geometry/workpiece.hpp"

namespace ridgeline::geometry {

/// A profile extruded without end along the third axis of its frame. Work frame.
struct Prism {
  Frame frame;
  Profile profile;
};

/// A convex set: inside a prism (when it has one) and behind every plane (normals point outward).
/// Work frame.
struct Cell {
  std::optional<Prism> wall;
  std::vector<Plane> planes;
};

/// The workpiece as material: inside `outside`, in none of the cavities (bore first, then holes).
/// A hole that is not blind runs to both ends of A2; with walls = 1 it ends at the plane through A1
/// square to the part of A2 that is square to A1.
struct Material {
  Cell outside;
  std::vector<Cell> cavities;
};

/// The material of a workpiece. Throws Error: see hole_frame and floor_height.
Material material_of(const Workpiece& workpiece);

/// Signed distance s(x', y') of a profile, value alone: collision search asks it a million times.
double plane_distance(const Profile& profile, double x, double y);

/// Largest of the signed distances of a cell's wall and planes: exact inside, outside never more
/// than the true distance; convex in the point.
double distance(const Cell& cell, const Eigen::Vector3d& point);

/// As material_distance(workpiece, point): max over the outside and the cavities reversed. Changes
/// by no more than the point moves.
double distance(const Material& material, const Eigen::Vector3d& point);

}  // namespace ridgeline::geometry
