#include "core/verify/clearance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "core/verify/extreme.hpp"
#include "core/verify/hull_bound.hpp"

namespace ridgeline::verify {
namespace {

using geometry::at;
using geometry::Piece;
using geometry::Solid;
using geometry::Stretch;
using geometry::Trace;

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Boxes looked at before the search stops and answers its proven bound instead: seconds of work.
constexpr std::size_t most_boxes = 300'000;
constexpr std::size_t boxes_between_looks = 256;
/// How well the depth of a collision is known: it is refused anyway.
constexpr double collision_relative = 0.2;
/// Of the way of a bound to the best distance: a split that gains less was along the wrong side.
constexpr double rise_that_pays = 0.1;
constexpr int projections = 8;
constexpr double polish_settled = 1e-7;  ///< of the reach along the path

/// A stretch of the path (a node of its tree, or an interval of one piece) and a patch of surface.
struct Box {
  std::size_t node = 0;
  double t0 = 0, t1 = 1;    ///< of the piece, when the node is a leaf
  std::size_t surface = 0;  ///< the patch is a part of it
  tool::Surface patch;
  double turn0 = 0, turn1 = 0;  ///< angle about the axis
  double bound = -infinity;     ///< nothing in the box is nearer to the material
  int split = 0;                ///< along which side to split: path, patch, turn
};

struct Nearer {
  bool operator()(const Box& a, const Box& b) const { return a.bound > b.bound; }
};

/// A point of the tool at a place of the path.
struct Station {
  std::size_t piece = 0;
  double t = 0, height = 0, radius = 0, turn = 0;
};

class Search {
public:
  Search(const Solid& solid, const Trace& path, const Eigen::Vector3d& axis)
      : solid_(solid), path_(path), z_(axis), x_(axis.unitOrthogonal()), y_(z_.cross(x_)) {}

  Clearance run(const std::vector<tool::Surface>& surfaces, const Progress& progress);

private:
  Eigen::Vector3d offset(double height, double radius, double turn) const {
    return height * z_ + radius * (std::cos(turn) * x_ + std::sin(turn) * y_);
  }
  Eigen::Vector3d point(const Station& s) const {
    return at(path_.pieces()[s.piece], s.t) + offset(s.height, s.radius, s.turn);
  }
  Stretch stretch(const Box& box) const;
  Station station(const Box& box, double path, double patch, double turn) const;
  std::vector<Corner> corners(const Box& box, const Stretch& path) const;
  void look(Box& box);
  double offer(const Box& box, const Station& s);
  void push(Box box);
  void split(const Box& box);
  Eigen::Vector3d nearest_on(const tool::Surface& surface, const Eigen::Vector3d& p) const;
  void polish(const tool::Surface& surface, const Progress& progress);
  double tolerance() const {
    const double relative = best_ < 0 ? collision_relative : clearance_relative;
    return std::max(clearance_tolerance, relative * std::abs(best_));
  }

  const Solid& solid_;
  const Trace& path_;
  Eigen::Vector3d z_, x_, y_;
  std::priority_queue<Box, std::vector<Box>, Nearer> queue_;
  std::size_t looked_ = 0;
  double best_ = infinity;
  Station best_at_;
  Eigen::Vector3d best_point_;
  std::size_t best_surface_ = 0;
};

Stretch Search::stretch(const Box& box) const {
  Stretch s = path_.nodes()[box.node];
  if (s.last - s.first > 1) return s;
  const Piece& piece = path_.pieces()[s.first];
  const double dt = box.t1 - box.t0;
  s.a = at(piece, box.t0);
  s.b = at(piece, box.t1);
  s.deviation = piece.bend * dt * dt / 8;
  return s;
}

/// The station at fractions (0, 1/2 or 1) of the sides of a box.
Station Search::station(const Box& box, double path, double patch, double turn) const {
  const auto between = [](double a, double b, double w) { return a + (b - a) * w; };
  const Stretch& s = path_.nodes()[box.node];
  Station station;
  if (s.last - s.first == 1) {
    station.piece = s.first;
    station.t = between(box.t0, box.t1, path);
  } else {
    station.piece = path == 0 ? s.first : path == 1 ? s.last - 1 : (s.first + s.last) / 2;
    station.t = path == 1 ? 1 : 0;
  }
  station.height = between(box.patch.low, box.patch.high, patch);
  station.radius = between(box.patch.inner, box.patch.outer, patch);
  station.turn = between(box.turn0, box.turn1, turn);
  return station;
}

std::vector<Corner> Search::corners(const Box& box, const Stretch& path) const {
  std::vector<Corner> all;
  all.reserve(12);
  const double between = (box.turn0 + box.turn1) / 2;
  const double beyond = 1 / std::cos((box.turn1 - box.turn0) / 2);
  const bool has_turn = box.patch.outer > 0;
  for (const int end : {0, 1}) {
    const Eigen::Vector3d& c = end == 0 ? path.a : path.b;
    for (const int side : {0, 1}) {
      const double height = side == 0 ? box.patch.low : box.patch.high;
      const double radius = side == 0 ? box.patch.inner : box.patch.outer;
      all.push_back({c + offset(height, radius, box.turn0), end, side, 0});
      if (!has_turn) continue;
      all.push_back({c + offset(height, radius, box.turn1), end, side, 1});
      all.push_back({c + offset(height, radius * beyond, between), end, side, 2});
    }
  }
  return all;
}

/// How much the bound changes along each side of a box: where splitting it helps most.
int longest_change(const Bound& bound, const std::vector<Corner>& corners, double deviation,
                   double swell) {
  std::array<std::array<double, 3>, 3> sum{}, count{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner& c = corners[i];
    const std::array<int, 3> side = {c.path, c.patch, c.turn};
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k][static_cast<std::size_t>(side[k])] += bound.at[i];
      count[k][static_cast<std::size_t>(side[k])] += 1;
    }
  }
  std::array<double, 3> change{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (count[k][0] > 0 && count[k][1] > 0) {
      change[k] = std::abs(sum[k][0] / count[k][0] - sum[k][1] / count[k][1]);
    }
  }
  change[0] += 2 * deviation;
  change[2] += 2 * swell;
  return static_cast<int>(std::max_element(change.begin(), change.end()) - change.begin());
}

double Search::offer(const Box& box, const Station& s) {
  const Eigen::Vector3d p = point(s);
  const double least = geometry::distance(solid_.material(), p) - box.patch.ball;
  if (least >= best_) return least;
  const double true_distance = solid_.distance(p) - box.patch.ball;
  if (true_distance < best_) {
    best_ = true_distance;
    best_at_ = s;
    best_point_ = p;
    best_surface_ = box.surface;
  }
  return true_distance;
}

void Search::look(Box& box) {
  ++looked_;
  const Stretch path = stretch(box);
  const std::vector<Corner> hull = corners(box, path);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Corner& corner : hull) middle += corner.p / static_cast<double>(hull.size());
  const Bound bound = hull_bound(solid_.material(), middle, hull);

  const std::size_t worst = static_cast<std::size_t>(
      std::min_element(bound.at.begin(), bound.at.begin() + static_cast<long>(hull.size())) -
      bound.at.begin());
  const Corner& corner = hull[worst];
  offer(box, station(box, corner.path, corner.patch, corner.turn == 2 ? 0.5 : corner.turn));
  const Station centre = station(box, 0.5, 0.5, 0.5);
  const double here = offer(box, centre);

  double radius = 0;
  const Eigen::Vector3d p = point(centre);
  for (const Corner& c : hull) radius = std::max(radius, (c.p - p).norm());
  const double by_cell = bound.value - path.deviation - box.patch.ball;
  const double by_middle = here - radius - path.deviation;
  const double before = box.bound;
  box.bound = std::max({box.bound, by_cell, by_middle});
  const bool rises = box.bound - before > rise_that_pays * (best_ - before);
  const double swell = box.patch.outer * (1 / std::cos((box.turn1 - box.turn0) / 2) - 1);
  // The changes of the best cell tell where to split, as long as the bound rises by it: one cell
  // then covers the box. Otherwise it is the widest side.
  const double chord = (path.b - path.a).norm() + path.deviation;
  const double side = box.patch.high - box.patch.low + box.patch.outer - box.patch.inner;
  const double arc = box.patch.outer * (box.turn1 - box.turn0);
  const std::array<double, 3> size = {chord, side, arc};
  box.split = longest_change(bound, hull, path.deviation, swell);
  if (!rises || size[static_cast<std::size_t>(box.split)] == 0) {
    box.split = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
  }
}

void Search::push(Box box) {
  look(box);
  if (box.bound < best_ - tolerance()) queue_.push(box);
}

void Search::split(const Box& box) {
  Box one = box, two = box;
  const Stretch& node = path_.nodes()[box.node];
  if (box.split == 0 && node.last - node.first > 1) {
    one.node = Trace::left(box.node);
    two.node = path_.right(box.node);
  } else if (box.split == 0) {
    one.t1 = two.t0 = (box.t0 + box.t1) / 2;
  } else if (box.split == 1) {
    one.patch.high = two.patch.low = (box.patch.low + box.patch.high) / 2;
    one.patch.outer = two.patch.inner = (box.patch.inner + box.patch.outer) / 2;
  } else {
    one.turn1 = two.turn0 = (box.turn0 + box.turn1) / 2;
  }
  push(one);
  push(two);
}

/// The point of a surface that is nearest to p; ball centre and p relative to it.
Eigen::Vector3d Search::nearest_on(const tool::Surface& surface, const Eigen::Vector3d& p) const {
  const double height = std::clamp(p.dot(z_), surface.low, surface.high);
  const Eigen::Vector3d out = p - p.dot(z_) * z_;
  const double r = out.norm();
  const double radius = std::clamp(r, surface.inner, surface.outer);
  return height * z_ + (r > 0 ? out / r : x_) * radius;
}

/// The bound is coarse, the value is not: downhill from the best station. At each place of the path
/// tool and material are projected onto each other in turn; along it the reach doubles while it
/// pays.
void Search::polish(const tool::Surface& surface, const Progress& progress) {
  if (!(best_ > 0)) return;
  double index = static_cast<double>(best_at_.piece) + best_at_.t;
  Eigen::Vector3d off = offset(best_at_.height, best_at_.radius, best_at_.turn);
  const auto centre = [&](double i) {
    const auto piece = static_cast<std::size_t>(i);
    return at(path_.pieces()[piece], i - static_cast<double>(piece));
  };
  const auto settled = [&](double i) {
    const Eigen::Vector3d c = centre(i);
    Eigen::Vector3d here = off;
    for (int k = 0; k < projections; ++k) {
      here = nearest_on(surface, solid_.nearest(c + here).point - c);
    }
    return here;
  };
  const auto f = [&](double i) {
    progress.at(1, "clearance");
    return surface.ball - solid_.distance(centre(i) + settled(i));
  };
  const double end = static_cast<double>(path_.pieces().size()) - 1e-9;
  for (double reach = 1; reach < 2 * end; reach *= 2) {
    const double low = std::max(0.0, index - reach);
    const double high = std::min(end, index + reach);
    const Extreme peak = golden_maximum(f, low, high, polish_settled * (high - low));
    if (!(-peak.value < best_)) break;
    best_ = -peak.value;
    index = peak.at;
    off = settled(index);
  }
  best_at_.piece = static_cast<std::size_t>(index);
  best_point_ = centre(index) + off;
}

Clearance Search::run(const std::vector<tool::Surface>& surfaces, const Progress& progress) {
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    Box box;
    box.surface = k;
    box.patch = surfaces[k];
    const bool is_round = box.patch.outer > 0;
    for (int i = 0; i < (is_round ? 4 : 1); ++i) {
      box.turn0 = i * std::numbers::pi / 2;
      box.turn1 = is_round ? (i + 1) * std::numbers::pi / 2 : 0;
      push(box);
    }
  }
  double proven = infinity;
  std::size_t next_look = 0;
  while (!queue_.empty()) {
    if (looked_ >= next_look) {
      progress.at(static_cast<double>(looked_) / most_boxes, "clearance");
      next_look = looked_ + boxes_between_looks;
    }
    const Box box = queue_.top();
    if (box.bound >= best_ - tolerance()) break;
    if (looked_ > most_boxes) {
      proven = box.bound;
      break;
    }
    queue_.pop();
    split(box);
  }
  polish(surfaces[best_surface_], progress);
  return {.value = std::min(best_, proven), .piece = best_at_.piece, .point = best_point_};
}

}  // namespace

Clearance clearance(const Solid& solid, const Trace& path, const Eigen::Vector3d& axis,
                    const std::vector<tool::Surface>& surfaces, const Progress& progress) {
  return Search(solid, path, axis).run(surfaces, progress);
}

}  // namespace ridgeline::verify
