#pragma once

#include <cmath>
#include <numbers>

#include "core/verify/measure.hpp"

/// A hole of radius R2 along Z through a block, its top at z = 10, chamfered by a ball whose centre
/// runs on the circle of radius r at height z: everything has a closed form.
namespace ridgeline::verify {

struct Countersink {
  double R2 = 5, D = 3, r = 3, z = 12;
};

/// G1 lies on the top where the ball ends: D^2 = (rho - r)^2 + (z - 10)^2; G2 on the wall,
/// likewise.
inline double width_of(const Countersink& c) {
  const double rho = c.r + std::sqrt(c.D * c.D - (c.z - 10) * (c.z - 10));
  const double height = c.z - std::sqrt(c.D * c.D - (c.R2 - c.r) * (c.R2 - c.r));
  return std::hypot(rho - c.R2, 10 - height);
}

inline Subject subject_of(const Countersink& c) {
  Subject subject;
  subject.workpiece.shape = geometry::BodyShape::ManifoldBlock;
  subject.workpiece.inner_radius = 2;
  subject.workpiece.size = {60, 80, 20};
  geometry::Hole hole;
  hole.name = "H1";
  hole.profile.R2 = c.R2;
  subject.workpiece.holes = {hole};
  subject.edge =
      geometry::edge_of(subject.workpiece, hole, geometry::EdgeKind::Outer, geometry::Side::Entry);
  subject.tool.radius = c.D;
  subject.width = width_of(c);
  return subject;
}

inline Eigen::Vector3d on_circle(const Countersink& c, double phi) {
  return {c.r * std::cos(phi), c.r * std::sin(phi), c.z};
}

inline void add_line(path::Motion& motion, path::MoveKind kind, const Eigen::Vector3d& to) {
  motion.moves.push_back({kind, to, kind == path::MoveKind::Rapid ? 0.0 : 5.0, {}});
}

/// From 20 above, a polygon of `count` chords.
inline path::Motion polygon(const Countersink& c, int count) {
  path::Motion motion;
  motion.start = on_circle(c, 0) + Eigen::Vector3d(0, 0, 20);
  add_line(motion, path::MoveKind::LeadIn, on_circle(c, 0));
  for (int i = 1; i <= count; ++i) {
    add_line(motion, path::MoveKind::Cut, on_circle(c, 2 * std::numbers::pi * (i % count) / count));
  }
  add_line(motion, path::MoveKind::LeadOut, motion.start);
  return motion;
}

/// The same as one full circle.
inline path::Motion circle(const Countersink& c) {
  path::Motion motion = polygon(c, 1);
  motion.moves[1].arc = path::Arc{.centre = {0, 0, c.z}};
  return motion;
}

}  // namespace ridgeline::verify
