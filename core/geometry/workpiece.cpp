#include "core/geometry/workpiece.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"
#include "core/base/text.hpp"

namespace ridgeline::geometry {
namespace {

const double max_tilt_sine = std::sin(radians(80));  // of A2 towards A1 (design: section 1)

Eigen::Vector3d unit(const Eigen::Vector3d& axis, const char* what) {
  const double length = axis.norm();
  if (!(std::isfinite(length) && length > 0)) {
    throw Error(ErrorCode::BadInput,
                std::string(what) + ": the direction must be finite and not zero",
                {.field = "/axis"});
  }
  return axis / length;
}

// x' of the hole frame.
Eigen::Vector3d across(const Eigen::Vector3d& A1, const Eigen::Vector3d& A2) {
  const double tilt_sine = A1.dot(A2);
  if (!(std::abs(tilt_sine) < max_tilt_sine)) {
    const std::string tilt = text(degrees(std::asin(std::clamp(tilt_sine, -1., 1.))), "deg");
    throw Error(ErrorCode::BadInput,
                "penetration angle: the hole axis is tilted " + tilt +
                    " towards the workpiece axis; it must be below 80 deg",
                {.field = "/penetration_angle", .value = tilt, .limit = "80 deg"});
  }
  return A1.cross(A2).normalized();
}

}  // namespace

Frame hole_frame(const Workpiece& workpiece, const Hole& hole) {
  const Eigen::Vector3d A1 = unit(workpiece.axis, "workpiece axis");
  const Eigen::Vector3d z = unit(hole.axis, "hole axis");
  const Eigen::Vector3d x = across(A1, z);
  const Eigen::Vector3d y = z.cross(x);
  // The foot on A2: from the hole position along A2 until the way to A1 is square to y' too, for A1
  // spans y' and z' with the y' part cos(beta) > 0.
  const Eigen::Vector3d to_axis = workpiece.position - hole.position;
  const double along = to_axis.dot(y) / A1.dot(y);  // of A1, to height y' = 0
  Frame frame;
  frame.axes << x, y, z;
  frame.origin = hole.position + (to_axis.dot(z) - along * A1.dot(z)) * z;
  return frame;
}

double eccentric_distance(const Workpiece& workpiece, const Hole& hole) {
  const Frame frame = hole_frame(workpiece, hole);
  return (hole.position - workpiece.position).dot(frame.axes.col(0));
}

Eigen::Vector3d position_of(const Workpiece& workpiece, const Eigen::Vector3d& hole_axis,
                            double f) {
  return workpiece.position +
         f * across(unit(workpiece.axis, "workpiece axis"), unit(hole_axis, "hole axis"));
}

Frame block_frame(const Workpiece& workpiece) {
  const Eigen::Vector3d y = unit(workpiece.axis, "workpiece axis");
  const Eigen::Vector3d flat = y.cross(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d X = Eigen::Vector3d::UnitX();
  const bool upright = flat.norm() < 1e-9;
  const Eigen::Vector3d x = (upright ? Eigen::Vector3d(X - X.dot(y) * y) : flat).normalized();
  Frame frame;
  frame.axes << x, y, x.cross(y);
  frame.origin = workpiece.position;
  return frame;
}

}  // namespace ridgeline::geometry
