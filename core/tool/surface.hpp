#pragma once

#include <vector>

#include "core/tool/tool.hpp"

namespace ridgeline::tool {

/// A piece of the tool's surface of revolution about the tool axis: heights above the ball centre
/// and radii. A cylinder has one radius, a flat ring one height. `ball`: that many mm of material
/// all round each point (the ball itself is the point 0, 0 with ball = D). mm.
struct Surface {
  double low = 0, high = 0;
  double inner = 0, outer = 0;
  double ball = 0;
};

/// The ball alone.
Surface ball_of(const Tool& tool);

/// Neck and shank, as far as they are described: cylinders, with the rings where they step out.
/// The neck begins where it comes out of the ball. `top`: height above the ball centre at which
/// the highest part ends when nothing says where.
std::vector<Surface> neck_of(const Tool& tool, double top);

/// The holder from stickout to `top`; empty when its radius or the stickout is not given.
std::vector<Surface> holder_of(const Tool& tool, double top);

}  // namespace ridgeline::tool
