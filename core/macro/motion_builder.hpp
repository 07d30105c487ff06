#pragma once

#include <Eigen/Core>

#include "core/macro/recorder.hpp"
#include "core/macro/segment.hpp"

namespace ridgeline::macro {

/// Builds a motion move by move, as the blocks of a program would.
class MotionBuilder {
public:
  explicit MotionBuilder(Result& result);

  void rapid(const Eigen::Vector3d& to);
  void line(const Eigen::Vector3d& to, double feed);
  /// Arc about `centre` (its third component has no meaning); a full circle when `to` is where the
  /// motion is. No move when the radius vanishes.
  void arc(const Eigen::Vector3d& to, const Eigen::Vector3d& centre, path::ArcPlane plane,
           bool counter_clockwise, double feed);
  const Eigen::Vector3d& at() const { return at_; }

private:
  Recorder recorder_;
  Eigen::Vector3d at_ = Eigen::Vector3d::Zero();
};

}  // namespace ridgeline::macro
