#include "core/path/arc_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/base/error.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::path {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// tan(sweep / 4) of half a turn: the longest arc that is tried.
constexpr double largest_bulge = 1;
/// An arc that leaves its chord by less than this is a straight move [mm].
constexpr double straight_sagitta = 1e-6;
/// Deviations to both sides that differ by no more are equal [mm].
constexpr double balance = 1e-9;

struct Interval {
  double low = -infinity, high = infinity;
  bool is_empty() const { return !(low <= high); }
};

/// The points from i to j in the plane, from the chord's start: x along it, y to its left.
struct Span {
  double chord = 0;
  std::vector<double> x, y;
};

/// Circle through the chord's ends that passes bulge * chord / 2 to the right of its middle, so
/// that it turns counter-clockwise for a positive bulge.
struct Circle {
  double bulge = 0;
  double half = 0;    ///< of the chord
  double radius = 0;  ///< infinite for the chord itself

  Circle(double b, double chord) : bulge(b), half(chord / 2), radius(infinity) {
    if (bulge != 0) radius = half * (1 + b * b) / (2 * std::abs(b));
  }
  double sagitta() const { return std::abs(bulge) * half; }
  bool is_straight() const { return sagitta() < straight_sagitta; }
  double sweep() const { return 4 * std::atan(bulge); }
  /// Left of the chord's middle [mm].
  double centre_y() const { return half * (1 - bulge * bulge) / (2 * bulge); }
  /// Signed distance of a point to the circle, positive to the left.
  double deviation(double x, double y) const {
    if (is_straight()) return y;
    const double dx = x - half, dy = y - centre_y();
    // hypot - radius without cancellation: (|d|^2 - r^2) / (|d| + r), r^2 = half^2 + cy^2.
    const double power = x * (x - 2 * half) + y * (y - 2 * centre_y());
    const double outward = power / (std::hypot(dx, dy) + radius);
    return bulge > 0 ? -outward : outward;
  }
  /// Share of the sweep (of the chord) at a point.
  double share(double x, double y) const {
    if (is_straight()) return x / (2 * half);
    const double cy = centre_y();
    // Angle from the direction of the start (-half, -cy) to that of the point.
    const double ax = -half, ay = -cy, bx = x - half, by = y - cy;
    return std::atan2(ax * by - ay * bx, ax * bx + ay * by) / sweep();
  }
};

class Fitter {
public:
  Fitter(const std::vector<Eigen::Vector3d>& points, double tolerance, double curve_error,
         ArcPlane plane, const Eigen::Matrix3d& axes, const Progress& progress)
      : plane_(plane),
        axes_(axes),
        room_(tolerance - curve_error),
        curve_error_(curve_error),
        progress_(progress) {
    const auto [i, j, k] = axes_of(plane);
    points_.reserve(points.size());
    for (std::size_t n = 0; n < points.size(); ++n) {
      if (n % 1024 == 0) progress.at(0, "arcs");
      const Eigen::Vector3d& point = points[n];
      points_.emplace_back(point.dot(axes.col(i)), point.dot(axes.col(j)), point.dot(axes.col(k)));
    }
  }

  ArcFit run() {
    // Forwards: from each joint as far as any height of it allows.
    joints_.push_back({0, std::nullopt, {0, 0}});
    while (joints_.back().at + 1 < points_.size()) {
      done_ = static_cast<double>(joints_.back().at) / static_cast<double>(points_.size());
      joints_.push_back(farthest(joints_.back()));
    }
    // Backwards: the heights, the last one on the curve.
    heights_.assign(joints_.size(), 0);
    for (std::size_t n = joints_.size() - 1; n > 0; --n) {
      const Link& link = *joints_[n].link;
      const Interval from = start_heights(link, heights_[n], joints_[n - 1].heights);
      heights_[n - 1] = n == 1 ? 0 : (from.low + from.high) / 2;
    }
    return result();
  }

private:
  /// An arc from one point to another, and what its heights must keep:
  /// |z_k - (1 - t_k) a - t_k b| <= w_k, with a and b the heights of its ends above the points.
  struct Link {
    std::size_t from = 0, to = 0;
    Circle circle;
    std::vector<double> t, z, w;  ///< of the points between; z above the line through both ends
    double gap = 0;               ///< largest distance of arc to chord between neighbours
  };
  struct Joint {
    std::size_t at = 0;
    std::optional<Link> link;  ///< that leads here
    Interval heights;          ///< that the joint can have
  };

  Span span(std::size_t from, std::size_t to) const {
    const Eigen::Vector2d start = points_[from].head<2>();
    const Eigen::Vector2d chord = points_[to].head<2>() - start;
    Span span{chord.norm(), {}, {}};
    const Eigen::Vector2d along = chord / span.chord;
    for (std::size_t k = from + 1; k < to; ++k) {
      const Eigen::Vector2d d = points_[k].head<2>() - start;
      span.x.push_back(d.dot(along));
      span.y.push_back(along.x() * d.y() - along.y() * d.x());
    }
    return span;
  }

  /// Bulge whose largest deviations to both sides are equal; they grow steadily with the bulge.
  Circle balanced(const Span& span) const {
    const auto unbalance = [&](double bulge) {
      progress_.at(done_, "arcs");
      const Circle circle(bulge, span.chord);
      Interval seen{infinity, -infinity};
      for (std::size_t k = 0; k < span.x.size(); ++k) {
        const double d = circle.deviation(span.x[k], span.y[k]);
        seen.low = std::min(seen.low, d);
        seen.high = std::max(seen.high, d);
      }
      return seen.low + seen.high;
    };
    double low = -largest_bulge, high = largest_bulge;
    // Start from the middle point's circle, which is nearly right.
    const std::size_t middle = span.x.size() / 2;
    double bulge = std::clamp(-2 * span.y[middle] / span.chord, low, high);
    for (int n = 0; n < 60 && high - low > 1e-13; ++n) {
      const double f = unbalance(bulge);
      if (std::abs(f) <= balance) break;
      (f < 0 ? low : high) = bulge;
      // Raising the bulge by h moves the middle by h chord / 2.
      double next = bulge - f / span.chord;
      if (!(next > low && next < high)) next = (low + high) / 2;
      if (std::abs(next - bulge) < 1e-15) break;
      bulge = next;
    }
    return {bulge, span.chord};
  }

  /// The link from one point to another; nullopt when it leaves the curve in the plane.
  std::optional<Link> link(std::size_t from, std::size_t to) const {
    const Span plane = span(from, to);
    if (!(plane.chord > 0)) return std::nullopt;
    if (plane.x.empty()) return Link{from, to, Circle(0, plane.chord), {}, {}, {}, 0};
    Link link{from, to, balanced(plane), {}, {}, {}, 0};
    const double z0 = points_[from].z(), rise = points_[to].z() - z0;
    double before = 0;
    for (std::size_t k = 0; k < plane.x.size(); ++k) {
      const double t = link.circle.share(plane.x[k], plane.y[k]);
      if (!(t > before && t < 1)) return std::nullopt;  // turns back
      widen_gap(link, t - before);
      before = t;
      const double d = link.circle.deviation(plane.x[k], plane.y[k]);
      link.t.push_back(t);
      link.z.push_back(points_[from + 1 + k].z() - z0 - t * rise);
      link.w.push_back(d * d);
    }
    widen_gap(link, 1 - before);
    const double room = room_ - link.gap;
    if (!(room > 0)) return std::nullopt;
    for (double& w : link.w) {
      const double left = room * room - w;
      if (!(left >= 0)) return std::nullopt;
      w = std::sqrt(left);
    }
    return link;
  }

  /// Arc and chord at equal shares are at most r step^2 / 8 apart.
  static void widen_gap(Link& link, double share) {
    if (link.circle.is_straight()) return;
    const double step = share * link.circle.sweep();
    link.gap = std::max(link.gap, link.circle.radius * step * step / 8);
  }

  /// Heights b of the end that some height a of `from` allows.
  Interval end_heights(const Link& link, const Interval& from) const {
    const double room = room_ - link.gap;
    const Interval a{std::max(from.low, -room), std::min(from.high, room)};
    // U(a) = min (z + w - (1-t) a) / t falls with a, L(a) likewise; U - L is concave.
    const auto upper = [&](double at) {
      double bound = room;
      for (std::size_t k = 0; k < link.t.size(); ++k) {
        bound = std::min(bound, (link.z[k] + link.w[k] - (1 - link.t[k]) * at) / link.t[k]);
      }
      return bound;
    };
    const auto lower = [&](double at) {
      double bound = -room;
      for (std::size_t k = 0; k < link.t.size(); ++k) {
        bound = std::max(bound, (link.z[k] - link.w[k] - (1 - link.t[k]) * at) / link.t[k]);
      }
      return bound;
    };
    const auto width = [&](double at) { return upper(at) - lower(at); };
    if (a.is_empty()) return {1, -1};
    const std::optional<double> inside = inside_of(a, width);
    if (!inside) return {1, -1};
    return {lower(crossing(width, *inside, a.high)), upper(crossing(width, *inside, a.low))};
  }

  /// A place where the concave function is not negative.
  template <typename F>
  static std::optional<double> inside_of(Interval a, const F& f) {
    constexpr double golden = 0.381966011250105;
    double p = a.low + golden * (a.high - a.low), q = a.high - golden * (a.high - a.low);
    double fp = f(p), fq = f(q);
    for (int n = 0; n < 60; ++n) {
      if (fp >= 0) return p;
      if (fq >= 0) return q;
      if (!(a.high - a.low > 1e-12)) return std::nullopt;
      if (fp > fq) {
        a.high = q;
        q = p;
        fq = fp;
        p = a.low + golden * (a.high - a.low);
        fp = f(p);
      } else {
        a.low = p;
        p = q;
        fp = fq;
        q = a.high - golden * (a.high - a.low);
        fq = f(q);
      }
    }
    return std::nullopt;
  }

  /// The last place from `inside` towards `end` where the concave function is not negative.
  template <typename F>
  static double crossing(const F& f, double inside, double end) {
    if (f(end) >= 0) return end;
    double outside = end;
    for (int n = 0; n < 50; ++n) {
      const double middle = (inside + outside) / 2;
      (f(middle) >= 0 ? inside : outside) = middle;
    }
    return inside;
  }

  /// Heights a of the start that lead to the height b of the end.
  Interval start_heights(const Link& link, double b, const Interval& allowed) const {
    const double room = room_ - link.gap;
    Interval a{std::max(allowed.low, -room), std::min(allowed.high, room)};
    for (std::size_t k = 0; k < link.t.size(); ++k) {
      const double t = link.t[k];
      a.low = std::max(a.low, (link.z[k] - link.w[k] - t * b) / (1 - t));
      a.high = std::min(a.high, (link.z[k] + link.w[k] - t * b) / (1 - t));
    }
    // The way there was found in the same numbers: only rounding can cross the ends.
    if (a.is_empty()) a.low = a.high = (a.low + a.high) / 2;
    return a;
  }

  std::optional<Joint> joint(const Joint& before, std::size_t to) const {
    std::optional<Link> way = link(before.at, to);
    if (!way) return std::nullopt;
    Interval heights = end_heights(*way, before.heights);
    const bool is_last = to + 1 == points_.size();
    if (is_last && !(heights.low <= 0 && heights.high >= 0)) return std::nullopt;
    if (is_last) heights = {0, 0};
    if (heights.is_empty()) return std::nullopt;
    return Joint{to, std::move(way), heights};
  }

  /// Doubling, then halving: the reach of an arc is nearly a matter of its length alone.
  Joint farthest(const Joint& before) const {
    const std::size_t last = points_.size() - 1;
    std::size_t step = 1;
    std::optional<Joint> best;
    std::size_t refused = last + 1;
    while (true) {
      const std::size_t to = std::min(before.at + step, last);
      std::optional<Joint> tried = joint(before, to);
      if (!tried) {
        refused = to;
        break;
      }
      best = std::move(tried);
      if (to == last) break;
      step *= 2;
    }
    if (!best) {
      throw Error(ErrorCode::NotConverged, "the points are too sparse to fit arcs: point " +
                                               std::to_string(before.at + 1) +
                                               " is not reached from the one before");
    }
    while (best->at + 1 < refused) {
      const std::size_t to = best->at + (refused - best->at) / 2;
      std::optional<Joint> tried = joint(before, to);
      if (tried) {
        best = std::move(tried);
      } else {
        refused = to;
      }
    }
    return std::move(*best);
  }

  Eigen::Vector3d world(const Eigen::Vector3d& local) const {
    const auto [i, j, k] = axes_of(plane_);
    return local.x() * axes_.col(i) + local.y() * axes_.col(j) + local.z() * axes_.col(k);
  }

  ArcFit result() const {
    ArcFit fit;
    for (std::size_t n = 1; n < joints_.size(); ++n) {
      progress_.step(n, joints_.size(), "arcs");
      const Link& link = *joints_[n].link;
      Eigen::Vector3d to = points_[link.to];
      to.z() += heights_[n];
      Move move{MoveKind::Cut, world(to), 0, std::nullopt};
      if (!link.circle.is_straight()) {
        const Eigen::Vector2d start = points_[link.from].head<2>();
        const Eigen::Vector2d along = (to.head<2>() - start).normalized();
        const Eigen::Vector2d left(-along.y(), along.x());
        Eigen::Vector3d centre = points_[link.from];
        centre.head<2>() = start + link.circle.half * along + link.circle.centre_y() * left;
        const ArcSense sense =
            link.circle.bulge > 0 ? ArcSense::CounterClockwise : ArcSense::Clockwise;
        move.arc = Arc{world(centre), plane_, sense, axes_};
      }
      fit.moves.push_back(move);
      fit.index.push_back(link.to);
      fit.error = std::max(fit.error, curve_error_ + error_of(link, heights_[n - 1], heights_[n]));
    }
    return fit;
  }

  /// Largest distance at a point, and what the arc can leave its chord by between two.
  double error_of(const Link& link, double a, double b) const {
    const double room = room_ - link.gap;
    double error = std::max(std::abs(a), std::abs(b));
    for (std::size_t k = 0; k < link.t.size(); ++k) {
      const double t = link.t[k];
      const double across = std::sqrt(std::max(0.0, room * room - link.w[k] * link.w[k]));
      error = std::max(error, std::hypot(across, link.z[k] - (1 - t) * a - t * b));
    }
    return error + link.gap;
  }

  ArcPlane plane_;
  Eigen::Matrix3d axes_;
  double room_;  ///< of the tolerance, for the distance of the moves to the polyline
  double curve_error_;
  const Progress& progress_;
  std::vector<Eigen::Vector3d> points_;  ///< first, second, third axis of the plane
  std::vector<Joint> joints_;
  std::vector<double> heights_;
  double done_ = 0;  ///< share of the points
};

}  // namespace

ArcFit fit_arcs(const std::vector<Eigen::Vector3d>& points, double tolerance, double curve_error,
                ArcPlane plane, const Eigen::Matrix3d& axes, const Progress& progress) {
  if (!(curve_error >= 0 && tolerance > curve_error && tolerance < infinity)) {
    throw Error(ErrorCode::BadInput, "arcs: tolerance " + std::to_string(tolerance) +
                                         " mm must be greater than the error of the points, " +
                                         std::to_string(curve_error) + " mm");
  }
  if (points.size() < 2) throw Error(ErrorCode::BadInput, "arcs need two points or more");
  for (std::size_t n = 1; n < points.size(); ++n) {
    if (n % 1024 == 0) progress.at(0, "arcs");
    if (!((points[n] - points[n - 1]).norm() > 0)) {
      throw Error(ErrorCode::BadInput, "point " + std::to_string(n) + " coincides with the last");
    }
  }
  return Fitter(points, tolerance, curve_error, plane, axes, progress).run();
}

}  // namespace ridgeline::path
