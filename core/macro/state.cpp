#include "core/macro/state.hpp"

#include <utility>

namespace ridgeline::macro {

namespace {

using Eigen::Vector3d;

Vector3d scaled(const Scaling& scaling, const Vector3d& p) {
  if (!scaling.is_active) return p;
  return scaling.centre + scaling.factor.cwiseProduct(p - scaling.centre);
}
Vector3d unscaled(const Scaling& scaling, const Vector3d& p) {
  if (!scaling.is_active) return p;
  return scaling.centre + (p - scaling.centre).cwiseQuotient(scaling.factor);
}

// X' = X cos - Y sin, Y' = X sin + Y cos about the centre, in the plane of G68 (design section
// 1.3). direction -1 turns back.
Vector3d turned(const Rotation& rotation, Vector3d p, double direction) {
  const path::PlaneAxes axes = path::axes_of(rotation.plane);
  const double sine = direction * rotation.sine;
  const double x = p[axes.first] - rotation.centre[axes.first];
  const double y = p[axes.second] - rotation.centre[axes.second];
  p[axes.first] = rotation.centre[axes.first] + x * rotation.cosine - y * sine;
  p[axes.second] = rotation.centre[axes.second] + x * sine + y * rotation.cosine;
  return p;
}

}  // namespace

path::ArcPlane plane_of(const Modal& modal) {
  if (modal.plane == 180) return path::ArcPlane::ZX;
  if (modal.plane == 190) return path::ArcPlane::YZ;
  return path::ArcPlane::XY;
}

Axes shift_of(const State& state) {
  Axes shift{};
  const Axes& external = state.offsets.work[0];
  const Axes& work = state.offsets.work[static_cast<std::size_t>(state.work_offset)];
  for (std::size_t i = 0; i < axis_count; ++i) {
    shift[i] = external[i] + work[i] + state.local[i] + state.preset[i];
  }
  shift[2] += state.length;
  return shift;
}

Vector3d imaged(const State& state, const Vector3d& programmed) {
  return scaled(state.scaling, scaled(state.mirror, programmed));
}

Vector3d transformed(const State& state, const Vector3d& programmed) {
  Vector3d p = imaged(state, programmed);
  if (!state.rotation.is_active) return p;
  return turned(state.rotation, p, 1) + state.rotation.drift;
}

Vector3d untransformed(const State& state, const Vector3d& point) {
  Vector3d p = point;
  if (state.rotation.is_active) p = turned(state.rotation, p - state.rotation.drift, -1);
  return unscaled(state.mirror, unscaled(state.scaling, p));
}

Axes to_machine(const State& state, const Axes& programmed) {
  Axes machine = shift_of(state);
  const Vector3d p = transformed(state, linear(programmed));
  for (std::size_t i = 0; i < axis_count; ++i) {
    machine[i] += i < 3 ? p[static_cast<int>(i)] : programmed[i];
  }
  return machine;
}

void follow_machine(State& state) {
  const Axes shift = shift_of(state);
  for (std::size_t i = 0; i < axis_count; ++i) state.position[i] = state.machine[i] - shift[i];
  const Vector3d p = untransformed(state, linear(state.position));
  for (int i = 0; i < 3; ++i) state.position[static_cast<std::size_t>(i)] = p[i];
}

bool reverses_arcs(const State& state, path::ArcPlane plane) {
  const path::PlaneAxes axes = path::axes_of(plane);
  const auto sign = [&](const Scaling& scaling) {
    if (!scaling.is_active) return 1.0;
    return scaling.factor[axes.first] * scaling.factor[axes.second];
  };
  return sign(state.scaling) * sign(state.mirror) < 0;
}

}  // namespace ridgeline::macro
