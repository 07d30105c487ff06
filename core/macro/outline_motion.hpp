#pragma once

#include <vector>

#include "core/macro/cycle.hpp"

namespace ridgeline::macro {

/// An outline made ready for compensated passes: closed ones begin in the middle of their longest
/// straight move, and a way to and from `lead` stands square to the ends.
struct OutlinePath {
  Eigen::Vector2d lead_in = Eigen::Vector2d::Zero();
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  std::vector<OutlineMove> moves;
  Eigen::Vector2d lead_out = Eigen::Vector2d::Zero();
};

/// Throws Error{BadInput} (field "outline") for an outline without moves or with moves of no
/// length. `offset`: the greatest compensation value that the passes use.
OutlinePath outline_path(const Cycle& cycle, double offset);

/// Passes along the outline, each with its compensation value and height. Throws Error{BadInput}
/// with the alarm's text when an offset does not fit the outline.
void outline_motion(const Cycle& cycle, const std::vector<OffsetPass>& passes, Result& result,
                    const Progress& progress);

}  // namespace ridgeline::macro
