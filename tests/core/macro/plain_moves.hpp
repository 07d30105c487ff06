#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/macro/interpreter.hpp"
#include "tests/core/nc/rs274.hpp"

namespace ridgeline::macro {

/// A move of either interpreter. sense: 0 straight, 1 counter-clockwise, -1 clockwise.
struct Plain {
  bool is_rapid = false;
  int sense = 0;
  char normal = ' ';
  Eigen::Vector3d to;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double feed = 0;
};

/// What moves, of our interpreter's result and of LinuxCNC's.
std::vector<Plain> moves_of(const Result& result);
std::vector<Plain> moves_of(const nc::CanonRun& run);

/// Expects equal kinds, and ends and centres within the tolerance [mm].
void expect_same(const std::vector<Plain>& ours, const std::vector<Plain>& theirs,
                 double tolerance);

}  // namespace ridgeline::macro
