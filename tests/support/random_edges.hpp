#pragma once

#include <cmath>
#include <numbers>
#include <ostream>
#include <random>

#include "core/geometry/workpiece.hpp"

namespace ridgeline::tests {

/// A hole edge of random shape, size and place that edge_of() must accept.
struct RandomEdge {
  geometry::Workpiece workpiece;
  geometry::Hole hole;
  geometry::EdgeKind kind = geometry::EdgeKind::Inner;
  geometry::Side side = geometry::Side::Entry;
  double R1 = 0;  ///< of the surface that the edge lies on; 0: a plane
  double f = 0;
  double beta = 0;  ///< tilt of A2 towards A1
};

inline void PrintTo(const RandomEdge& e, std::ostream* out) {
  *out << (e.kind == geometry::EdgeKind::Inner ? "inner" : "outer")
       << (e.side == geometry::Side::Entry ? " entry" : " exit") << " R1 " << e.R1 << " R2 "
       << e.hole.profile.R2 << " along " << e.hole.profile.straight_along << " across "
       << e.hole.profile.straight_across << " f " << e.f << " beta "
       << e.beta * 180 / std::numbers::pi << " deg";
}

/// How far the random edges go.
struct Spread {
  double max_tilt = 60 * std::numbers::pi / 180;
  double max_eccentricity = 0.9;  ///< of what the body leaves beside the hole
  bool round_only = false;
  bool blocks = true;
};

inline RandomEdge random_edge(std::mt19937& random, const Spread& spread = {}) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * unit(random); };
  const auto direction = [&] {
    std::normal_distribution<double> normal;
    return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
  };

  RandomEdge e;
  const bool block = spread.blocks && unit(random) < 0.25;
  e.kind = unit(random) < 0.5 ? geometry::EdgeKind::Inner : geometry::EdgeKind::Outer;
  e.side = unit(random) < 0.5 ? geometry::Side::Entry : geometry::Side::Exit;
  e.beta = spread.max_tilt * between(-1, 1);

  const double bore = between(5, 40);
  const double outer = bore * between(1.2, 2);
  e.workpiece.inner_radius = bore;
  e.R1 = e.kind == geometry::EdgeKind::Inner ? bore : block ? 0 : outer;
  const double half_width = bore * between(0.15, 0.7);  // of the hole, across
  const double shape = unit(random);
  e.hole.profile.R2 = half_width;
  if (!spread.round_only && shape < 0.3) {
    e.hole.profile.straight_along = half_width * between(0.1, 4);
  } else if (!spread.round_only && shape < 0.6) {
    e.hole.profile.R2 = half_width * between(0.25, 0.9);
    e.hole.profile.straight_across = 2 * (half_width - e.hole.profile.R2);
    e.hole.profile.straight_along = half_width * between(0.1, 4);
  }
  e.f = spread.max_eccentricity * (bore - half_width) * between(-1, 1);

  // Axes at the tilt beta, any way round; the part is long enough for every tilt below 80 degrees.
  const Eigen::Vector3d A1 = direction();
  e.workpiece.axis = A1;
  Eigen::Vector3d square = A1.cross(direction()).normalized();
  if (block) {  // A2 leaves well within one face
    const double turn = between(-1, 1) * std::numbers::pi / 6;
    const Eigen::Matrix3d axes = geometry::block_frame(e.workpiece).axes;
    square = std::sin(turn) * axes.col(0) + std::cos(turn) * axes.col(2);
  }
  e.hole.axis = std::sin(e.beta) * A1 + std::cos(e.beta) * square;
  e.workpiece.position = 100 * direction();
  e.hole.position = position_of(e.workpiece, e.hole.axis, e.f) + between(-20, 20) * e.hole.axis;
  const double length = 2 * (outer + 5 * half_width + 4 * outer) / std::cos(e.beta);
  if (block) {
    e.workpiece.shape = geometry::BodyShape::ManifoldBlock;
    e.workpiece.size = {length, 3 * length, length};
  } else {
    e.workpiece.outer_radius = outer;
    e.workpiece.length = length;
  }
  return e;
}

inline geometry::Edge edge_of(const RandomEdge& e) {
  return geometry::edge_of(e.workpiece, e.hole, e.kind, e.side);
}

}  // namespace ridgeline::tests
