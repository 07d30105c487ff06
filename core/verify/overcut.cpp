#include "core/verify/overcut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
         const std::vector<BandSection>& sections, double D)
      : edge_(edge),
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
    double from, to;  ///< t
  };
  void walk();
  Eigen::Vector3d centre(double index) const;
  double depth(const Eigen::Vector3d& c) const;
  double seam_depth(const Eigen::Vector3d& c) const;
  bool is_in_band(const Eigen::Vector3d& q) const;
  bool is_on_ridge(const Eigen::Vector3d& q) const;
  Trace other_seams() const;

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
  for (const Piece& piece : solid_.seams().pieces()) {
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
  for (std::size_t i = 0; i < path_.pieces().size(); ++i) {
    const Piece& piece = path_.pieces()[i];
    const double speed = (piece.b - piece.a).norm() + piece.bend;  // no faster, by t
    double t = 0;
    while (t < 1) {
      const double clear = geometry::distance(solid_.material(), at(piece, t)) - D_;
      const double next = std::min(1.0, t + std::max(margin_, clear - margin_) / speed);
      steps_.push_back({i, t, next});
      depths_.push_back(depth(at(piece, next)));
      t = next;
    }
  }
}

Overcut Search::run() {
  walk();
  const Extreme deepest = sampled_maximum(
      depths_, [this](double index) { return depth(centre(index)); }, Ends::Open, peak_worth);
  if (!(deepest.value > 0)) return {};
  return {.depth = deepest.value,
          .piece = steps_[static_cast<std::size_t>(std::ceil(deepest.at))].piece,
          .centre = centre(deepest.at)};
}

}  // namespace

Overcut overcut(const Edge& edge, const Solid& solid, const Trace& path, const Band& band,
                const std::vector<BandSection>& sections, double D) {
  return Search(edge, solid, path, band, sections, D).run();
}

}  // namespace ridgeline::verify
