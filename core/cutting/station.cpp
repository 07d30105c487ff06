#include "core/cutting/station.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace ridgeline::cutting {
namespace {

Face in_frame(const Face& face, const Eigen::Matrix3d& axes, const Eigen::Vector3d& origin) {
  if (const auto* plane = std::get_if<HalfSpace>(&face)) {
    return HalfSpace{axes.transpose() * plane->n, plane->h - plane->n.dot(origin)};
  }
  const Round& round = std::get<Round>(face);
  return Round{axes.transpose() * (round.centre - origin), axes.transpose() * round.axis, round.R,
               round.material};
}

// First direction of the machine across the tool axis.
Eigen::Vector3d machine_x(const Eigen::Vector3d& axis) {
  const Eigen::Vector3d along_x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d seed = std::abs(axis.x()) < 0.9 ? along_x : Eigen::Vector3d::UnitY();
  return (seed - seed.dot(axis) * axis).normalized();
}

}  // namespace

Eigen::Matrix3d cut_axes(const Course& course, const Eigen::Vector3d& direction) {
  constexpr double plunging = 1e-9;  // a feed along the axis has no side: any will do
  const Eigen::Vector3d Z = course.tool_axis;
  const Eigen::Vector3d level = direction - direction.dot(Z) * Z;
  const Eigen::Vector3d Y = level.norm() > plunging ? level.normalized() : machine_x(Z);
  const double side = course.spindle == tool::SpindleSense::Clockwise ? 1 : -1;
  Eigen::Matrix3d axes;
  axes.col(0) = side * Y.cross(Z);
  axes.col(1) = Y;
  axes.col(2) = Z;
  return axes;
}

Cut cut_at(const Course& course, const Station& station) {
  const Eigen::Matrix3d axes = cut_axes(course, station.direction);
  Cut cut;
  cut.cutter = course.cutter;
  cut.coefficients = course.coefficients;
  cut.samples = course.samples;
  cut.earlier_teeth = course.earlier_teeth;
  cut.chip_end = course.chip_end;
  cut.n = axes.transpose() * station.n;
  cut.feed = station.feed;
  cut.phi = std::asin(std::clamp(-station.direction.dot(course.tool_axis), -1.0, 1.0));
  cut.stock.combine = station.stock.combine;
  for (const Face& face : station.stock.faces) {
    cut.stock.faces.push_back(in_frame(face, axes, station.centre));
  }
  for (const Round& groove : station.stock.grooves) {
    cut.stock.grooves.push_back(std::get<Round>(in_frame(groove, axes, station.centre)));
  }
  if (station.stock.map) {
    cut.stock.map = station.stock.map;
    cut.stock.map_origin = station.centre + station.stock.map_origin;
    cut.stock.map_axes = axes;
  }
  return cut;
}

Eigen::Matrix2d machine_axes(const Course& course, const Eigen::Vector3d& direction) {
  const Eigen::Matrix3d axes = cut_axes(course, direction);
  const Eigen::Vector3d mx = machine_x(course.tool_axis);
  const Eigen::Vector3d my = course.tool_axis.cross(mx);
  Eigen::Matrix2d turned;
  turned.col(0) = (axes.transpose() * mx).head<2>();
  turned.col(1) = (axes.transpose() * my).head<2>();
  return turned;
}

}  // namespace ridgeline::cutting
