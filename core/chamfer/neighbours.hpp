#pragma once

#include <string>
#include <vector>

#include "core/chamfer/motion.hpp"

namespace ridgeline::chamfer {

/// Another hole beside the chamfer.
struct Neighbour {
  std::string hole;
  double distance = 0;  ///< of the chamfer's borders to its cavity [mm]; < 0: they run into it
  CutPoint at;          ///< where it is least
};

/// The other holes that come nearer than `within` to the borders of a chamfer. Bounds from below:
/// beyond the end of a hole the true distance is more.
std::vector<Neighbour> neighbours(const Job& job, const std::vector<CutPoint>& borders,
                                  double within, const Progress& progress = {});

/// Throws Error{WidthTooLarge} when the chamfer runs into one of them.
void require_clear(const std::vector<Neighbour>& neighbours, double width);

/// That a chamfer as wide round the edge of a neighbour would meet this one.
std::string warning(const Neighbour& neighbour);

}  // namespace ridgeline::chamfer
