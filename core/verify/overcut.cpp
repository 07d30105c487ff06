#include "core/verify/overcut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "core/verify/extreme.hpp"

namespace ridgeline::verify {
namespace {

using geometry::at;
using geometry::Edge;
using geometry::Face;
using geometry::Foot;
using geometry::Piece;
using geometry::SeamPart;
using geometry::Solid;
using geometry::Trace;

constexpr double step_of_radius = 1.0 / 25;
constexpr double on_surface = 1e-7;  ///< [mm]
constexpr double seam_doubt = 1e-3;  ///< a seam this near to being cut is measured exactly [mm]
constexpr double peak_worth = 1e-9;  ///< [mm]
constexpr double golden_settled = 1e-9;
constexpr double hidden = 1e-5;         ///< deeper than what is found is nothing by more [mm]
constexpr int looked_at = 64;           ///< steps, and halvings, between two looks for a cancel
constexpr int most_halvings = 500'000;  ///< then the bound itself is the depth

/// The ridge as a closed polyline, to find the u of a point.
Trace ridge_trace(const Edge& edge, const std::vector<BandSection>& sections) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    Piece piece;
    piece.a = geometry::to_outer(edge.frame, sections[i].P);
    piece.b = geometry::to_outer(edge.frame, sections[(i + 1) % sections.size()].P);
    piece.owner = i;
    pieces.push_back(piece);
  }
  return Trace(pieces);
}

class Search {
public:
  Search(const Edge& edge, const Solid& solid, const Trace& path, const Band& band,
         const std::vector<BandSection>& sections, double D, const Progress& progress)
      : progress_(progress),
        edge_(edge),
        solid_(solid),
        path_(path),
        band_(band),
        count_(static_cast<double>(sections.size())),
        D_(D),
        margin_(D * step_of_radius),
        ridge_(ridge_trace(edge, sections)),
        seams_(other_seams()) {}

  Overcut run();

private:
  struct Step {
    std::size_t piece;
    double from, to;        ///< t
    bool is_clear = false;  ///< no boundary within D all the way
  };
  /// A stretch of a step with the depths at both ends and what none between them exceeds.
  struct Stretch {
    std::size_t step;
    double low, high;  ///< share of the step
    double low_depth, high_depth;
    double bound;
    friend bool operator<(const Stretch& a, const Stretch& b) { return a.bound < b.bound; }
  };
  void walk();
  Stretch stretch(std::size_t step, double low, double high, double low_depth,
                  double high_depth) const;
  Extreme certified(Extreme best) const;
  Eigen::Vector3d centre(double index) const;
  double depth(const Eigen::Vector3d& c) const;
  double seam_depth(const Eigen::Vector3d& c) const;
  bool is_in_band(const Eigen::Vector3d& q) const;
  bool is_on_ridge(const Eigen::Vector3d& q) const;
  Trace other_seams() const;

  const Progress& progress_;
  const Edge& edge_;
  const Solid& solid_;
  const Trace& path_;
  const Band& band_;
  double count_, D_;
  double margin_;  ///< depths below -margin_ are not told apart
  Trace ridge_;    ///< the edge's own ridge
  Trace seams_;    ///< all other seams
  std::vector<Step> steps_;
  std::vector<double> depths_;
};

bool Search::is_on_ridge(const Eigen::Vector3d& q) const {
  const Eigen::Vector3d p = geometry::to_local(edge_.frame, q);
  if (std::abs(geometry::signed_distance(edge_.body, p).value) > on_surface) return false;
  if (std::abs(geometry::plane_distance(edge_.profile, p.x(), p.y())) > on_surface) return false;
  const Foot near = ridge_.nearest(q);
  const Piece& piece = ridge_.pieces()[near.piece];
  return near.distance < (piece.b - piece.a).norm();
}

Trace Search::other_seams() const {
  std::vector<Piece> pieces;
  const std::vector<Piece>& seams = solid_.seams().pieces();
  for (std::size_t i = 0; i < seams.size(); ++i) {
    if (i % looked_at == 0) progress_.at(0, "overcut");
    const Piece& piece = seams[i];
    if (!(is_on_ridge(piece.a) && is_on_ridge(piece.b))) pieces.push_back(piece);
  }
  return Trace(pieces);
}

// The section VP(u) through q: (q - P(u)) . t(u) = 0 near the nearest place of the ridge.
bool Search::is_in_band(const Eigen::Vector3d& q) const {
  const Eigen::Vector3d p = geometry::to_local(edge_.frame, q);
  const bool on_body = std::abs(geometry::signed_distance(edge_.body, p).value) <= on_surface;
  const bool on_wall =
      std::abs(geometry::plane_distance(edge_.profile, p.x(), p.y())) <= on_surface;
  if (!on_body && !on_wall) return false;
  const Foot near = ridge_.nearest(q);
  const Piece& piece = ridge_.pieces()[near.piece];
  const double speed = (piece.b - piece.a).norm() * count_;  // of P by u
  double u = (static_cast<double>(near.piece) + near.t) / count_;
  for (int i = 0; i < 3; ++i) {
    const geometry::RidgePoint ridge = geometry::ridge_at(edge_, u - std::floor(u));
    u += (p - ridge.P).dot(ridge.t) / speed;
  }
  const BandSection section = band_.at(u - std::floor(u));
  const double far = (p - section.P).norm();
  return (on_body && far <= (section.G1 - section.P).norm() + on_surface) ||
         (on_wall && far <= (section.G2 - section.P).norm() + on_surface);
}

double Search::seam_depth(const Eigen::Vector3d& c) const {
  const Foot near = seams_.nearest(c, 0, D_ + margin_);
  double depth = D_ - near.distance;
  if (depth < -seam_doubt) return depth;
  const SeamPart& part = solid_.seam_parts()[seams_.pieces()[near.piece].owner];
  const double width = part.to - part.from;
  const Extreme nearest = golden_maximum(
      [&](double w) {
        const std::optional<Eigen::Vector3d> q = solid_.seam_at(part, w);
        return q && solid_.is_on_seam(part, *q) ? -(*q - c).norm()
                                                : -std::numeric_limits<double>::infinity();
      },
      part.from - width, part.to + width, golden_settled * width);
  return std::isfinite(nearest.value) ? D_ + nearest.value : depth;
}

double Search::depth(const Eigen::Vector3d& c) const {
  const double air = geometry::distance(solid_.material(), c);
  // In the tip of an acute edge, which the chamfer removes, the centre is as good as in the air.
  if (air < 0 && !is_in_band(solid_.nearest(c).point)) return D_ - air;
  double deepest = std::max(-margin_, seam_depth(c));
  for (const Face& face : solid_.faces()) {
    solid_.feet(face, c, D_ - deepest, [&](const Eigen::Vector3d& q) {
      const double here = D_ - (q - c).norm();
      if (here > deepest && !is_in_band(q)) deepest = here;
    });
  }
  return deepest;
}

Eigen::Vector3d Search::centre(double index) const {
  const auto i = static_cast<std::size_t>(std::ceil(index));
  const Step& step = steps_[i];
  const double back = static_cast<double>(i) - index;
  return at(path_.pieces()[step.piece], step.to + back * (step.from - step.to));
}

// Far from the material the ball can go as far as it is clear before anything can happen.
void Search::walk() {
  steps_.push_back({0, 0, 0});
  depths_.push_back(depth(path_.pieces().front().a));
  const Progress walking = progress_.part(0, 0.5);
  for (std::size_t i = 0; i < path_.pieces().size(); ++i) {
    const Piece& piece = path_.pieces()[i];
    const double speed = (piece.b - piece.a).norm() + piece.bend;  // no faster, by t
    double t = 0;
    while (t < 1) {
      if (steps_.size() % looked_at == 0) {
        walking.at(static_cast<double>(i) / static_cast<double>(path_.pieces().size()), "overcut");
      }
      const double clear = geometry::distance(solid_.material(), at(piece, t)) - D_;
      const double next = std::min(1.0, t + std::max(margin_, clear - margin_) / speed);
      steps_.push_back({i, t, next, clear - margin_ > 0 && clear >= (next - t) * speed});
      depths_.push_back(depth(at(piece, next)));
      t = next;
    }
  }
}

// Let d(c) be the distance of c to the boundary outside the band: a fixed set of points q. For each
// of them and c = (1 - s) a + s b, with l = |b - a|,
//   |c - q|^2 = (1 - s) |a - q|^2 + s |b - q|^2 - s (1 - s) l^2,
// so that d(c)^2 >= min(d(a), d(b))^2 - l^2 / 4. A depth below 0 counts as 0, as the border of the
// band, which no foot tells of, is D or more away from every centre.
Search::Stretch Search::stretch(std::size_t step, double low, double high, double low_depth,
                                double high_depth) const {
  const double at_step = static_cast<double>(step) - 1;
  const double l = (centre(at_step + high) - centre(at_step + low)).norm();
  const Step& here = steps_[step];
  const double turn = (here.to - here.from) * (high - low);
  const double sag = path_.pieces()[here.piece].bend * turn * turn / 8;
  const double least = std::max(0.0, D_ - std::max({0.0, low_depth, high_depth}));
  const double d = std::sqrt(std::max(0.0, least * least - l * l / 4));
  const Eigen::Vector3d middle = centre(at_step + (low + high) / 2);
  const double in_air =
      geometry::distance(solid_.material(), middle) - l / 2;  // the distance to all
  return {step, low, high, low_depth, high_depth, D_ - std::max(d, in_air) + sag};
}

// Halves the stretch with the greatest bound until none can hide more than `hidden`.
Extreme Search::certified(Extreme best) const {
  std::priority_queue<Stretch> open;
  const Progress bounds = progress_.part(0.5, 0.7), halving = progress_.part(0.7, 1);
  for (std::size_t i = 1; i < steps_.size(); ++i) {
    bounds.step(i, steps_.size(), "overcut");
    if (steps_[i].is_clear) continue;
    open.push(stretch(i, 0, 1, depths_[i - 1], depths_[i]));
  }
  for (int n = 0; !open.empty(); ++n) {
    if (n % looked_at == 0) halving.at(static_cast<double>(n) / most_halvings, "overcut");
    const Stretch top = open.top();
    const double found = std::max(0.0, best.value);
    if (top.bound <= found + hidden) break;
    if (n == most_halvings) return {top.bound, static_cast<double>(top.step) - 1 + top.high};
    open.pop();
    const double middle = (top.low + top.high) / 2;
    const double at = static_cast<double>(top.step) - 1 + middle;
    const double here = depth(centre(at));
    if (here > best.value) best = {here, at};
    open.push(stretch(top.step, top.low, middle, top.low_depth, here));
    open.push(stretch(top.step, middle, top.high, here, top.high_depth));
  }
  return best;
}

Overcut Search::run() {
  walk();
  const Extreme peak = sampled_maximum(
      depths_, [this](double index) { return depth(centre(index)); }, Ends::Open, peak_worth);
  const Extreme deepest = certified(peak);
  if (!(deepest.value > 0)) return {};
  return {.depth = deepest.value,
          .piece = steps_[static_cast<std::size_t>(std::ceil(deepest.at))].piece,
          .centre = centre(deepest.at)};
}

}  // namespace

Overcut overcut(const Edge& edge, const Solid& solid, const Trace& path, const Band& band,
                const std::vector<BandSection>& sections, double D, const Progress& progress) {
  return Search(edge, solid, path, band, sections, D, progress).run();
}

}  // namespace ridgeline::verify
