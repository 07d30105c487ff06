#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/macro/cycle.hpp"

namespace ridgeline::macro {

/// A straight piece of the way of the tool's tip [mm].
struct Segment {
  Eigen::Vector3d from, to;
};

/// The motion of a cycle, its arcs as chords within 1e-4 mm.
std::vector<Segment> segments_of(const Result& motion);

/// Distance of a point to everything that the tool of a cycle sweeps along the segments [mm];
/// negative: cut away.
double swept_distance(const Cycle& cycle, const std::vector<Segment>& segments,
                      const Eigen::Vector3d& p);

/// The segments that may bring the tool within `reach` of a point.
std::vector<Segment> within(const Cycle& cycle, const std::vector<Segment>& segments,
                            const Eigen::Vector3d& p, double reach);

}  // namespace ridgeline::macro
