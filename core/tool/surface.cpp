#include "core/tool/surface.hpp"

#include <algorithm>
#include <cmath>

namespace ridgeline::tool {

Surface ball_of(const Tool& tool) {
  return {.ball = cutting_radius(tool)};
}

std::vector<Surface> neck_of(const Tool& tool, double top) {
  const double D = cutting_radius(tool);
  const double end = tool.stickout ? std::min(*tool.stickout - D, top) : top;
  const double step = tool.neck_length   ? std::clamp(*tool.neck_length - D, 0.0, end)
                      : tool.neck_radius ? end
                                         : 0;
  std::vector<Surface> surfaces;
  const auto add = [&](double radius, double from, double to) {
    const double out = radius < D ? std::sqrt(D * D - radius * radius) : 0;  // of the ball
    const double low = std::max(from, out);
    if (to > low) {
      surfaces.push_back({.low = low, .high = to, .inner = radius, .outer = radius, .ball = 0});
    }
  };
  const auto add_ring = [&](double one, double two, double height) {
    const double out = height < D ? std::sqrt(D * D - height * height) : 0;  // of the ball
    const double inner = std::max(std::min(one, two), out);
    const double outer = std::max(one, two);
    if (outer > inner) {
      surfaces.push_back(
          {.low = height, .high = height, .inner = inner, .outer = outer, .ball = 0});
    }
  };
  if (tool.neck_radius) {
    add(*tool.neck_radius, 0, step);
    add_ring(0, *tool.neck_radius, 0);
  }
  if (tool.shank_radius) {
    add(*tool.shank_radius, step, end);
    if (end > step) add_ring(tool.neck_radius.value_or(0), *tool.shank_radius, step);
  }
  return surfaces;
}

std::vector<Surface> holder_of(const Tool& tool, double top) {
  if (!tool.holder_radius || !tool.stickout) return {};
  const double low = *tool.stickout - cutting_radius(tool);
  const double radius = *tool.holder_radius;
  return {{.low = low,
           .high = std::max(top, low + radius),
           .inner = radius,
           .outer = radius,
           .ball = 0},
          {.low = low, .high = low, .inner = 0, .outer = radius, .ball = 0}};
}

}  // namespace ridgeline::tool
