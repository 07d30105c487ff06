#pragma once

#include <optional>
#include <string>

namespace ridgeline::tool {

enum class ToolShape { Ball, Lollipop };
enum class SpindleSense { Clockwise, CounterClockwise };  ///< seen from the spindle towards the tip

/// A rotating tool on its axis. Heights are measured from the tip towards the spindle. mm, rad.
/// The body above the ball: neck (neck_radius) from the ball centre to neck_length, shank
/// (shank_radius) from neck_length to stickout, holder (holder_radius) above stickout. A part whose
/// radius is absent is not known, is not checked, and the result says so.
struct Tool {
  int number = 0;
  std::string name;
  ToolShape shape = ToolShape::Ball;
  double radius = 0;  ///< D of document 000: radius of the ball
  double wear = 0;    ///< added to the radius; negative for a worn tool
  std::optional<double> neck_radius;
  std::optional<double> neck_length;
  std::optional<double> shank_radius;
  std::optional<double> stickout;
  std::optional<double> holder_radius;
  int flutes = 2;
  double helix_angle = 0;
  SpindleSense spindle = SpindleSense::Clockwise;
  int length_offset = 0;  ///< H number; 0: the tool number
};

/// Radius that cuts: radius + wear [mm].
inline double cutting_radius(const Tool& tool) {
  return tool.radius + tool.wear;
}

}  // namespace ridgeline::tool
