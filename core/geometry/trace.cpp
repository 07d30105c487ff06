#include "core/geometry/trace.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ridgeline::geometry {
namespace {

constexpr double largest_turn = std::numbers::pi / 12;  ///< of one spiral piece [rad]
constexpr int newton_steps = 40;

struct Derivatives {
  Eigen::Vector3d c, c1, c2;  ///< point, first and second derivative by t
};

Derivatives derivatives(const Spiral& s, double t) {
  const double dr = s.r1 - s.r0;
  const double dw = s.w1 - s.w0;
  const double r = s.r0 + dr * t;
  const double w = s.w0 + dw * t;
  const Eigen::Vector3d radial = std::cos(w) * s.x + std::sin(w) * s.y;
  const Eigen::Vector3d along = std::cos(w) * s.y - std::sin(w) * s.x;
  return {.c = s.centre + r * radial + (s.h0 + (s.h1 - s.h0) * t) * s.z,
          .c1 = dr * radial + r * dw * along + (s.h1 - s.h0) * s.z,
          .c2 = 2 * dr * dw * along - r * dw * dw * radial};
}

Foot foot_at(const Piece& piece, const Eigen::Vector3d& p, double t) {
  Foot foot;
  foot.t = t;
  foot.point = at(piece, t);
  foot.distance = (foot.point - p).norm();
  return foot;
}

// (c(t) - p) . c'(t) = 0. On so short a piece it has one sign change at most, from - to +, unless p
// is beyond the centre, where the nearer end is nearest.
Foot nearest_on_spiral(const Piece& piece, const Eigen::Vector3d& p) {
  const Spiral& s = *piece.spiral;
  const auto slope = [&](double t) {
    const Derivatives d = derivatives(s, t);
    return (d.c - p).dot(d.c1);
  };
  if (!(slope(0) < 0 && slope(1) > 0)) {
    const Foot first = foot_at(piece, p, 0);
    const Foot last = foot_at(piece, p, 1);
    return first.distance <= last.distance ? first : last;
  }
  double low = 0, high = 1, t = 0.5;
  for (int i = 0; i < newton_steps; ++i) {
    const Derivatives d = derivatives(s, t);
    const double g = (d.c - p).dot(d.c1);
    (g < 0 ? low : high) = t;
    const double g1 = d.c1.squaredNorm() + (d.c - p).dot(d.c2);
    const double step = t - g / g1;
    const double next = step > low && step < high ? step : (low + high) / 2;
    const bool settled = std::abs(next - t) < 1e-15;
    t = next;
    if (settled) break;
  }
  return foot_at(piece, p, t);
}

double distance_to_chord(const Stretch& stretch, const Eigen::Vector3d& p) {
  const Eigen::Vector3d ab = stretch.b - stretch.a;
  const double square = ab.squaredNorm();
  const double t = square > 0 ? std::clamp((p - stretch.a).dot(ab) / square, 0.0, 1.0) : 0;
  return (p - stretch.a - t * ab).norm();
}

double box_distance2(const Stretch& stretch, const Eigen::Vector3d& p) {
  const Eigen::Array3d out =
      (stretch.low - p).cwiseMax(p - stretch.high).cwiseMax(Eigen::Vector3d::Zero());
  return out.square().sum();
}

/// Nothing of the stretch is nearer. The box is quick; the chord is close where a fine path runs
/// all but square to the way there, as a cutter's does.
bool is_beyond(const Stretch& stretch, const Eigen::Vector3d& p, double distance) {
  return box_distance2(stretch, p) >= distance * distance ||
         distance_to_chord(stretch, p) - stretch.deviation >= distance;
}

}  // namespace

Eigen::Vector3d at(const Piece& piece, double t) {
  if (t == 0) return piece.a;
  if (t == 1) return piece.b;
  if (piece.spiral) return derivatives(*piece.spiral, t).c;
  return piece.a + t * (piece.b - piece.a);
}

Foot nearest(const Piece& piece, const Eigen::Vector3d& p) {
  if (piece.spiral) return nearest_on_spiral(piece, p);
  const Eigen::Vector3d ab = piece.b - piece.a;
  const double t = std::clamp((p - piece.a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return foot_at(piece, p, t);
}

Trace::Trace(std::vector<Piece> pieces, const Progress& progress) : pieces_(std::move(pieces)) {
  if (pieces_.empty()) return;
  nodes_.reserve(2 * pieces_.size() - 1);
  build(0, 0, pieces_.size(), progress);
}

std::size_t Trace::right(std::size_t node) const {
  const std::size_t n = nodes_[node].last - nodes_[node].first;
  return node + 2 * ((n + 1) / 2);
}

// A subtree of n leaves takes 2 n - 1 places in a row: node, left subtree, right subtree.
void Trace::build(std::size_t node, std::size_t first, std::size_t last, const Progress& progress) {
  nodes_.emplace_back();  // in the order of the nodes
  Stretch& stretch = nodes_[node];
  stretch.first = first;
  stretch.last = last;
  stretch.a = pieces_[first].a;
  stretch.b = pieces_[last - 1].b;
  if (last - first == 1) {
    progress.step(first, pieces_.size(), "tree");
    const double sag = pieces_[first].bend / 8;
    stretch.deviation = sag;
    stretch.low = stretch.a.cwiseMin(stretch.b).array() - sag;
    stretch.high = stretch.a.cwiseMax(stretch.b).array() + sag;
    return;
  }
  build(left(node), first, first + (last - first + 1) / 2, progress);
  build(right(node), first + (last - first + 1) / 2, last, progress);
  const Stretch& one = nodes_[left(node)];
  const Stretch& two = nodes_[right(node)];
  stretch.low = one.low.cwiseMin(two.low);
  stretch.high = one.high.cwiseMax(two.high);
  for (const Stretch* child : {&one, &two}) {
    const double ends =
        std::max(distance_to_chord(stretch, child->a), distance_to_chord(stretch, child->b));
    stretch.deviation = std::max(stretch.deviation, ends + child->deviation);
  }
}

Foot Trace::nearest(const Eigen::Vector3d& p, std::size_t hint, double within) const {
  Foot best;
  best.distance = within;
  const auto offer = [&](std::size_t piece) {
    const Foot foot = geometry::nearest(pieces_[piece], p);
    if (!(foot.distance < best.distance)) return;
    best = foot;
    best.piece = piece;
  };
  if (hint < pieces_.size()) offer(hint);
  std::array<std::size_t, 128> stack;  // one waiting node a level; 2^126 pieces fit no memory
  std::size_t top = 0;
  if (!nodes_.empty()) stack[top++] = 0;
  while (top > 0) {
    const std::size_t node = stack[--top];
    const Stretch& stretch = nodes_[node];
    if (is_beyond(stretch, p, best.distance)) continue;
    if (stretch.last - stretch.first == 1) {
      offer(stretch.first);
      continue;
    }
    const std::size_t one = left(node);
    const std::size_t two = right(node);
    const bool one_first = box_distance2(nodes_[one], p) <= box_distance2(nodes_[two], p);
    stack[top++] = one_first ? two : one;
    stack[top++] = one_first ? one : two;
  }
  return best;
}

void add_spiral(std::vector<Piece>& pieces, const Spiral& whole, const Piece& ends) {
  const int n =
      std::max(1, static_cast<int>(std::ceil(std::abs(whole.w1 - whole.w0) / largest_turn)));
  for (int i = 0; i < n; ++i) {
    const double t0 = static_cast<double>(i) / n;
    const double t1 = static_cast<double>(i + 1) / n;
    const auto part = [&](double v0, double v1, double t) { return v0 + (v1 - v0) * t; };
    Spiral s = whole;
    s.r0 = part(whole.r0, whole.r1, t0);
    s.r1 = part(whole.r0, whole.r1, t1);
    s.w0 = part(whole.w0, whole.w1, t0);
    s.w1 = part(whole.w0, whole.w1, t1);
    s.h0 = part(whole.h0, whole.h1, t0);
    s.h1 = part(whole.h0, whole.h1, t1);
    const double dw = std::abs(s.w1 - s.w0);
    Piece piece;
    piece.a = i == 0 ? ends.a : derivatives(s, 0).c;
    piece.b = i == n - 1 ? ends.b : derivatives(s, 1).c;
    piece.owner = ends.owner;
    piece.bend = 2 * std::abs(s.r1 - s.r0) * dw + std::max(s.r0, s.r1) * dw * dw;
    piece.spiral = std::make_shared<const Spiral>(s);
    pieces.push_back(piece);
  }
}

}  // namespace ridgeline::geometry
