#pragma once

#include "core/geometry/workpiece.hpp"

namespace ridgeline::tests {

/// The case of document 000: A1 along Y, hole along Z, so that work and hole frame are parallel.
struct SourceEdge {
  double R1 = 20, R2 = 5, f = 0;
  double along = 0, across = 0;
  geometry::EdgeKind kind = geometry::EdgeKind::Inner;
  geometry::Side side = geometry::Side::Entry;
  double beta = 0;
};

inline geometry::Edge source_edge(const SourceEdge& s) {
  geometry::Workpiece workpiece;
  const bool inner = s.kind == geometry::EdgeKind::Inner;
  workpiece.inner_radius = inner ? s.R1 : s.R1 / 2;
  workpiece.outer_radius = inner ? 2 * s.R1 : s.R1;
  workpiece.length = 100 * s.R1;
  geometry::Hole hole;
  hole.profile = {.R2 = s.R2, .straight_along = s.along, .straight_across = s.across};
  hole.position = {s.f, 0, 0};
  hole.axis = {0, std::sin(s.beta), std::cos(s.beta)};
  hole.eccentric_distance = s.f;
  return geometry::edge_of(workpiece, hole, s.kind, s.side);
}

}  // namespace ridgeline::tests
