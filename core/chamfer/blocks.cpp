#include "core/chamfer/blocks.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/path/arc.hpp"
#include "core/path/arc_fit.hpp"

namespace ridgeline::chamfer {
namespace {

constexpr double widening = 2;      ///< of the tolerance, until one arc reaches over a step
constexpr int most_widenings = 40;  ///< then there is no arc over it: a line

/// What an arc may be about.
struct ArcAxes {
  path::ArcPlane plane = path::ArcPlane::XY;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

constexpr path::ArcPlane plane_across(int axis) {
  if (axis == 0) return path::ArcPlane::YZ;
  return axis == 1 ? path::ArcPlane::ZX : path::ArcPlane::XY;
}

std::vector<ArcAxes> possible_axes(const ArcWish& wish) {
  if (const std::optional<int> axis = path::machine_axis(wish.tool_axis)) {
    return {{plane_across(*axis)}};
  }
  if (wish.frame == ArcFrame::WorkPlane) {
    return {{path::ArcPlane::XY, path::tilted_axes(wish.tool_axis)}};
  }
  if (wish.frame == ArcFrame::WorkFrameXY) return {{path::ArcPlane::XY}};
  return {{path::ArcPlane::XY}, {path::ArcPlane::ZX}, {path::ArcPlane::YZ}};
}

CutBlock block_over(std::span<const CutPoint> points, std::size_t from, std::size_t to) {
  CutBlock block{.end = points[to].C, .contact = 0, .centre = 0, .arc = {}};
  for (std::size_t i = from + 1; i <= to; ++i) {
    block.contact += (middle(points[i]) - middle(points[i - 1])).norm();
    block.centre += (points[i].C - points[i - 1].C).norm();
  }
  return block;
}

/// Largest distance of the points to the chord between the first and the last.
double line_error(const std::vector<Eigen::Vector3d>& C) {
  const Eigen::Vector3d chord = C.back() - C.front();
  double error = 0;
  for (const Eigen::Vector3d& c : C) {
    const double t = std::clamp((c - C.front()).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
    error = std::max(error, (C.front() + t * chord - c).norm());
  }
  return error;
}

/// One block from the first point to the last, as near as an arc comes.
path::ArcFit single(const std::vector<Eigen::Vector3d>& C, const ArcWish& wish, const ArcAxes& axes,
                    const Progress& progress) {
  double tolerance = std::max(wish.tolerance, widening * wish.sampling_error);
  for (int i = 0; i < most_widenings; ++i, tolerance *= widening) {
    path::ArcFit fit =
        path::fit_arcs(C, tolerance, wish.sampling_error, axes.plane, axes.axes, progress);
    if (fit.moves.size() == 1) return fit;
  }
  return {.moves = {{path::MoveKind::Cut, C.back(), 0, std::nullopt}},
          .index = {C.size() - 1},
          .error = wish.sampling_error + line_error(C)};
}

path::ArcFit stepped(const std::vector<Eigen::Vector3d>& C, const ArcWish& wish,
                     const ArcAxes& axes, const Progress& progress) {
  path::ArcFit all;
  for (std::size_t from = 0; from + 1 < C.size(); from += wish.step) {
    progress.at(static_cast<double>(from) / static_cast<double>(C.size()), "arcs");
    const std::size_t to = std::min(from + wish.step, C.size() - 1);
    const std::vector<Eigen::Vector3d> part(C.begin() + static_cast<std::ptrdiff_t>(from),
                                            C.begin() + static_cast<std::ptrdiff_t>(to) + 1);
    const path::ArcFit one =
        single(part, wish, axes, Progress{.report = {}, .stop = progress.stop});
    all.moves.push_back(one.moves.front());
    all.index.push_back(to);
    all.error = std::max(all.error, one.error);
  }
  return all;
}

}  // namespace

std::vector<CutBlock> straight_blocks(const std::vector<CutPoint>& points,
                                      const Progress& progress) {
  std::vector<CutBlock> blocks;
  blocks.reserve(points.size());
  for (std::size_t i = 1; i < points.size(); ++i) {
    progress.step(i, points.size(), "blocks");
    blocks.push_back(block_over(points, i - 1, i));
  }
  return blocks;
}

Blocks arc_blocks(std::span<const CutPoint> points, const ArcWish& wish, const Progress& progress) {
  Blocks result;
  if (points.size() < 2) return result;
  std::vector<Eigen::Vector3d> C;
  C.reserve(points.size());
  const Progress copying = progress.part(0, 0.05);
  for (std::size_t i = 0; i < points.size(); ++i) {
    copying.step(i, points.size(), "arcs");
    C.push_back(points[i].C);
  }
  std::optional<path::ArcFit> best;
  const std::vector<ArcAxes> all = possible_axes(wish);
  const double each = 0.85 / static_cast<double>(all.size());
  double done = 0.05;
  for (const ArcAxes& axes : all) {
    const Progress part = progress.part(done, done + each);
    done += each;
    path::ArcFit fit = wish.step > 0 ? stepped(C, wish, axes, part)
                                     : path::fit_arcs(C, wish.tolerance, wish.sampling_error,
                                                      axes.plane, axes.axes, part);
    const bool is_better = !best || fit.moves.size() < best->moves.size() ||
                           (fit.moves.size() == best->moves.size() && fit.error < best->error);
    if (is_better) best = std::move(fit);
  }
  const Progress rest = progress.part(0.9, 1);
  std::size_t from = 0;
  for (std::size_t n = 0; n < best->moves.size(); ++n) {
    rest.step(n, best->moves.size(), "blocks");
    CutBlock block = block_over(points, from, best->index[n]);
    block.end = best->moves[n].to;
    block.arc = best->moves[n].arc;
    result.blocks.push_back(std::move(block));
    from = best->index[n];
  }
  result.index = std::move(best->index);
  result.error = best->error;
  return result;
}

}  // namespace ridgeline::chamfer
