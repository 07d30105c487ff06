#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

/// LinuxCNC's stand-alone interpreter, run as a program of its own.
namespace ridgeline::nc {

struct CanonMove {
  std::string call;    ///< STRAIGHT_TRAVERSE, STRAIGHT_FEED or ARC_FEED
  Eigen::Vector3d to;  ///< work coordinates, as printed: 4 decimals
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< in the plane; only of arcs
  int turns = 0;                                     ///< > 0 counter-clockwise
  char plane = 'Z';                                  ///< its normal
  double feed = 0;                                   ///< [mm/min]
};

struct CanonRun {
  int exit_code = -1;
  std::string output;  ///< canonical calls and messages
  std::vector<CanonMove> moves;
  std::vector<Eigen::Vector3d> length_offsets;  ///< of each USE_TOOL_LENGTH_OFFSET
};

/// Runs a program text with tool 12 of length 100 mm and tools 1 to 8 of none in a directory of its
/// own, 20 s at most.
CanonRun run_rs274(const std::string& program);

}  // namespace ridgeline::nc
