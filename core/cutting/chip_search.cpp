#include "core/cutting/chip_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace ridgeline::cutting {
namespace {

using std::numbers::pi;

// Of a whole revolution, with as much before and after as a tooth period.
Deflections round_and_round(const Deflections& centre, int samples) {
  Deflections out;
  if (centre.empty()) return out;
  const std::size_t size = static_cast<std::size_t>(samples) + 2 * centre.size();
  out.reserve(size);
  while (out.size() < size) out.insert(out.end(), centre.begin(), centre.end());
  return out;
}

double greatest_step(const Deflections& centre) {
  double greatest = 0;
  for (std::size_t i = 0; i < centre.size(); ++i) {
    greatest =
        std::max(greatest, (centre[i + 1 < centre.size() ? i + 1 : 0] - centre[i]).squaredNorm());
  }
  return std::sqrt(greatest);
}

// Feed side: ts + w > 0 with w how far the edge may have moved into the material since theta_o is
// (r + w + f b)^2 > f^2 (b^2 - 1) + r_o^2, which is linear in b.
double least_b(const Edge& edge, const Before& before, double moved) {
  const double rim = edge.r + moved;
  return (before.r * before.r - before.f * before.f - rim * rim) / (2 * before.f * rim);
}

// theta_o is a tooth period before theta, and as many samples later as
//   f cos phi cos theta_n / (r sin q) + psi'(q) f (cos q cos phi sin theta_n -
//   sin q sin phi) / r,
// the first order of (11) and of the lag at q_o (12), (13) in f / r, give or
// take `unsure`.
struct Later {
  double by_cos = 0, by_sin = 0, always = 0;  // samples
  double unsure = 0;                          // samples
};

// nullopt near the tip, where the first order says nothing. What is left out
// was looked for in random cutters, feeds and elements up to f = r / 3: it is
// at most 0.91 of `unsure` without its margin.
std::optional<Later> later(const Scene& scene, const Edge& edge, const Before& before) {
  constexpr double margin = 1.25;
  constexpr double tip = 0.5;  // of f over the radius of the element's circle
  const Cutter& cutter = scene.cut.cutter;
  const double f = before.f;
  const double r = edge.r;
  const double runout = std::abs(r - before.r);
  const double sin_q = edge.element->sin_q;
  const double cos_q = edge.element->cos_q;
  const double circle = (r - (f + f * f / r + runout)) * sin_q;
  if (!(f < tip * circle)) return std::nullopt;
  const bool is_square = cutter.kind == CutterKind::Square;
  const double slope =
      cutter.lag == LagLaw::ConstantLead ? sin_q * scene.tan_helix : scene.tan_helix / (1 + cos_q);
  const double lean = is_square ? 0 : slope * f / r;
  constexpr double least_lowest = 5e-5;  // 1 + cos q, 0.01 from the shank
  const double lowest =
      std::max(1 + cos_q * std::cos(2 * f / r) - sin_q * std::sin(2 * f / r), least_lowest);
  const double bend = is_square ? 0 : std::abs(scene.tan_helix) / (lowest * lowest);
  const double turn = f / circle;
  return Later{scene.per_radian * f * scene.cos_phi / (r * sin_q),
               scene.per_radian * lean * cos_q * scene.cos_phi,
               scene.per_radian * lean * sin_q * scene.fd.z(),
               scene.per_radian * margin * turn * (turn + runout / r) * (1 + bend)};
}

// How far the centre of the deflections has moved into the material since theta_o, at most.
class Moved {
public:
  Moved(const Scene& scene, const Edge& edge, const Before& before)
      : scene_(scene), sin_q_(edge.element->sin_q) {
    if (scene.centre.empty()) return;
    later_ = later(scene, edge, before);
    if (!later_) return;
    slack_ = later_->unsure * scene.step * sin_q_;
    far_ = std::hypot(later_->by_cos, later_->by_sin) + std::abs(later_->always) + later_->unsure;
    if (!(far_ + 2 < static_cast<double>(scene.around.centre.size()))) later_.reset();
  }

  /// At any sample, at most: of no edge more than `largest` there and back.
  double greatest() const {
    if (scene_.centre.empty()) return 0;
    const double there_and_back = 2 * scene_.largest;
    return sin_q_ * (later_ ? std::min(far_ * scene_.step, there_and_back) : there_and_back);
  }

  double at(std::int32_t sample, const Aim& aim) const {
    if (!later_) return 2 * scene_.largest * sin_q_;
    const auto period = static_cast<double>(scene_.around.centre.size());
    const double place =
        sample + period + later_->by_cos * aim.c + later_->by_sin * aim.s + later_->always;  // > 0
    const auto below = static_cast<std::size_t>(place);
    const double frac = place - static_cast<double>(below);
    const Eigen::Vector2d* centre = scene_.centre.data();
    const Eigen::Vector2d was = centre[below] + frac * (centre[below + 1] - centre[below]);
    const Eigen::Vector2d is = scene_.at(sample);
    return sin_q_ * (aim.s * (is.y() - was.y()) - aim.c * (is.x() - was.x())) + slack_;
  }

private:
  const Scene& scene_;
  double sin_q_;
  std::optional<Later> later_;
  double slack_ = 0;  // [mm]
  double far_ = 0;    // theta_o from a tooth period before theta, at most [samples]
};

// The stock as one element meets it.
class Level {
public:
  Level(const Scene& scene, double z) : scene_(scene), z_(z) {
    slices_.reserve(scene.boundaries.size());
    for (const Boundary& boundary : scene.boundaries) slices_.emplace_back(boundary, z);
  }

  /// May the element be in the stock at (x, y), give or take the reach?
  bool is_in_stock(double x, double y) const {
    const double reach = scene_.around.reach;
    const Stock& stock = scene_.cut.stock;
    const std::size_t faces = stock.faces.size();
    for (std::size_t i = faces; i < slices_.size(); ++i) {
      if (!slices_[i].is_near(x, y, reach)) return false;
    }
    const bool all = stock.combine == Combine::All;
    bool inside = all || faces == 0;
    for (std::size_t i = 0; i < faces; ++i) {
      const bool near = slices_[i].is_near(x, y, reach);
      if (all && !near) return false;
      inside = inside || near;
    }
    if (!inside || !stock.map) return inside;
    const Eigen::Vector3d p = stock.map_origin + stock.map_axes * Eigen::Vector3d(x, y, z_);
    const double sunk = reach * stock.map_axes.row(2).head<2>().norm();  // of a tilted tool
    return p.z() - sunk <= greatest_height(*stock.map, p.x(), p.y(), reach);
  }

private:
  const Scene& scene_;
  double z_;
  std::vector<Slice> slices_;
};

// Angles theta_n within `half` of `middle`.
struct Arc {
  double middle = 0;
  double half = pi;
};

// What both have; where that is two pieces, the smaller of them whole. nullopt: nothing.
std::optional<Arc> common(const Arc& one, const Arc& other) {
  const double apart = std::remainder(other.middle - one.middle, 2 * pi);
  const Arc& smaller = one.half < other.half ? one : other;
  if (std::abs(apart) + one.half + other.half >= 2 * pi) return smaller;
  const double from = std::max(-one.half, apart - other.half);
  const double to = std::min(one.half, apart + other.half);
  if (from > to) return {};
  return Arc{one.middle + (from + to) / 2, (to - from) / 2};
}

// Where an element can meet a plane:
// -sin q r (n_x cos - n_y sin)(theta_n) + U.n <= h - z n_z. nullopt: nowhere.
std::optional<Arc> plane_arc(const Boundary& plane, const Extent& U, const Edge& edge) {
  const double room = plane.h - U.least - edge.height * plane.a.z();
  const double swing = edge.circle * std::hypot(plane.a.x(), plane.a.y());
  if (room >= swing) return Arc{};  // inside all round
  if (room < -swing) return {};
  return Arc{std::atan2(-plane.a.y(), plane.a.x()), std::acos(-room / swing)};
}

// Where an element can be beside a groove whose axis has no X: within `half_width` of the axis it
// is in the air, whatever its Y. Of the arcs on both sides those that `arc` has; both: `arc`.
std::optional<Arc> groove_arc(const Boundary& groove, const Extent& Ux, const Extent& Uy,
                              const Edge& edge, const Arc& arc) {
  if (groove.a.x() != 0) return arc;
  const double up = groove.a.y() * (edge.height - groove.c.z());
  const double tilt = std::abs(groove.a.z());
  const double far = std::abs(up) + tilt * (edge.circle + std::abs(groove.c.y()) +
                                            std::max(std::abs(Uy.least), std::abs(Uy.greatest)));
  if (!(far * far < groove.h)) return arc;
  const double half_width = std::sqrt(groove.h - far * far);
  const double low = (Ux.greatest - groove.c.x() - half_width) / edge.circle;  // cos theta_n: air
  const double high = (Ux.least - groove.c.x() + half_width) / edge.circle;    // between these
  if (!(low < high)) return arc;
  std::optional<Arc> one, other;
  if (high < 1) one = high > -1 ? common(arc, {0, std::acos(high)}) : arc;
  if (low > -1) other = low < 1 ? common(arc, {pi, std::acos(-low)}) : arc;
  if (one && other) return arc;
  return one ? one : other;
}

// Where b = sin q cos phi sin theta_n + cos q sin phi is above the least.
std::optional<Arc> feed_arc(const Scene& scene, const Edge& edge, double least) {
  const double swing = edge.element->sin_q * scene.cos_phi;
  const double room = least + edge.element->cos_q * scene.fd.z();
  if (room >= swing) return {};
  if (room <= -swing) return Arc{};
  return Arc{pi / 2, std::acos(room / swing)};
}

// Where an element can be in the stock. nullopt: nowhere.
std::optional<Arc> stock_arc(const Scene& scene, const Edge& edge) {
  const std::size_t faces = scene.cut.stock.faces.size();
  const bool any = scene.cut.stock.combine == Combine::Any && faces > 1;
  std::optional<Arc> arc = Arc{};
  for (std::size_t i = 0; i < scene.boundaries.size() && arc; ++i) {
    const Boundary& boundary = scene.boundaries[i];
    if (boundary.sign == 0 && !any) {
      const std::optional<Arc> met = plane_arc(boundary, scene.along_normal[i], edge);
      arc = met ? common(*arc, *met) : met;
    } else if (boundary.sign < 0 && i >= faces) {
      arc = groove_arc(boundary, scene.along_x, scene.along_y, edge, *arc);
    }
  }
  return arc;
}

// Samples from first to last, not wrapped.
struct Window {
  int first = 0;
  int last = -1;
};

Window window(const Scene& scene, const Edge& edge, const Arc& arc) {
  const int N = scene.cut.samples;
  if (arc.half >= pi) return {0, N - 1};
  const double per_sample = 2 * pi / N;
  const double middle = arc.middle - edge.ahead + edge.element->psi;
  const int first = static_cast<int>(std::floor((middle - arc.half) / per_sample));
  const int last = static_cast<int>(std::ceil((middle + arc.half) / per_sample));
  return {first, std::min(last, first + N - 1)};
}

void search(const Scene& scene, const Edge& edge, const Before& before, std::int32_t element,
            std::vector<Found>& found) {
  const std::optional<Arc> in_stock = stock_arc(scene, edge);
  if (!in_stock) return;
  const Moved moved(scene, edge, before);
  const double spread = 2 * scene.around.reach * edge.element->sin_q;
  const double least = least_b(edge, before, spread + moved.greatest());
  const std::optional<Arc> fed = feed_arc(scene, edge, least);
  const std::optional<Arc> both = fed ? common(*in_stock, *fed) : std::nullopt;
  if (!both) return;

  const Level level(scene, edge.height);
  const int N = scene.cut.samples;
  const bool is_centred = !scene.centre.empty();
  const double by_s = edge.element->sin_q * scene.cos_phi;  // of b
  const double always = -edge.element->cos_q * scene.fd.z();
  const double past = before.r * before.r - before.f * before.f;
  const auto cuts_deeper = [&](double b, std::int32_t sample, const Aim& at) {  // as least_b()
    const double rim = edge.r + spread + moved.at(sample, at);
    return rim * (2 * before.f * b + rim) > past;
  };
  const auto [first, last] = window(scene, edge, *both);
  std::int32_t sample = ((first % N) + N) % N;
  for (int i = first; i <= last; ++i) {
    const Aim at = aim(scene, edge, sample);
    const double b = by_s * at.s + always;
    if (b > least) {  // may cut deeper than the tooth before
      double x = -edge.circle * at.c;
      double y = edge.circle * at.s;
      if (is_centred) {
        x += scene.at(sample).x();
        y += scene.at(sample).y();
      }
      if (level.is_in_stock(x, y) && (!is_centred || cuts_deeper(b, sample, at))) {
        found.push_back({sample, element});
      }
    }
    sample = sample + 1 < N ? sample + 1 : 0;
  }
}

// How far the deflections of a table may go along a direction.
Extent extent(const Scene& scene, const Eigen::Vector2d& along) {
  Extent out;
  const Deflections& centre = scene.around.centre;
  if (!centre.empty()) out.least = out.greatest = centre.front().dot(along);
  for (const Eigen::Vector2d& U : centre) {
    const double u = U.dot(along);
    out.least = std::min(out.least, u);
    out.greatest = std::max(out.greatest, u);
  }
  const double reach = scene.around.reach * along.norm();
  return {out.least - reach, out.greatest + reach};
}

// By sample, elements upwards within one.
std::vector<std::int32_t> sort_by_sample(std::vector<Found>& found, int samples) {
  std::vector<std::int32_t> first(static_cast<std::size_t>(samples) + 1, 0);
  for (const Found& one : found) ++first[static_cast<std::size_t>(one.sample) + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<std::int32_t> next(first.begin(), first.end() - 1);
  std::vector<Found> sorted(found.size());
  for (const Found& one : found) {
    sorted[static_cast<std::size_t>(next[static_cast<std::size_t>(one.sample)]++)] = one;
  }
  found = std::move(sorted);
  return first;
}

}  // namespace

Turn turn(const Cut& cut) {
  Turn turn{elements(cut.cutter), {}, {}};
  for (int i = 0; i < cut.samples; ++i) {
    const double theta = 2 * pi * i / cut.samples;
    turn.sin_theta.push_back(std::sin(theta));
    turn.cos_theta.push_back(std::cos(theta));
  }
  return turn;
}

Scene scene(const Cut& cut, const Around& around, const Turn& turn) {
  Scene scene{.cut = cut,
              .around = around,
              .largest = around.reach,
              .step = greatest_step(around.centre),
              .centre = round_and_round(around.centre, cut.samples),
              .fd = feed_direction(cut),
              .cos_phi = std::cos(cut.phi),
              .tan_helix = std::tan(cut.cutter.helix),
              .per_radian = cut.samples / (2 * pi),
              .turn = turn,
              .boundaries = boundaries(cut.stock),
              .along_normal = {},
              .along_x = {},
              .along_y = {}};
  double furthest = 0;
  for (const Eigen::Vector2d& U : around.centre) furthest = std::max(furthest, U.squaredNorm());
  scene.largest += std::sqrt(furthest);
  scene.along_x = extent(scene, Eigen::Vector2d::UnitX());
  scene.along_y = extent(scene, Eigen::Vector2d::UnitY());
  for (const Boundary& boundary : scene.boundaries) {
    scene.along_normal.push_back(extent(scene, boundary.a.head<2>()));
  }
  return scene;
}

Edge edge_of(const Cut& cut, const Element& element, int tooth) {
  const double ahead = tooth_angle(cut.cutter, tooth);
  const double r = tooth_radius(cut.cutter, tooth);
  const double base = cut.cutter.kind == CutterKind::Square ? element.z : 0;
  return {.element = &element,
          .r = r,
          .ahead = ahead,
          .sin_k = std::sin(ahead - element.psi),
          .cos_k = std::cos(ahead - element.psi),
          .base = base,
          .circle = r * element.sin_q,
          .height = base - r * element.cos_q};
}

Before before(const Cut& cut, int tooth, int m) {
  const double ahead = tooth_angle(cut.cutter, tooth + m) - tooth_angle(cut.cutter, tooth);
  return {.ahead = ahead,
          .f = cut.feed * teeth(cut.cutter) * ahead / (2 * pi),
          .r = tooth_radius(cut.cutter, tooth + m),
          .per_r = 1 / tooth_radius(cut.cutter, tooth + m)};
}

Candidates candidates(const Scene& scene, const std::vector<Edge>& edges, const Before& before) {
  Candidates out;
  for (std::size_t j = 0; j < edges.size(); ++j) {
    search(scene, edges[j], before, static_cast<std::int32_t>(j), out.found);
  }
  out.first = sort_by_sample(out.found, scene.cut.samples);
  return out;
}

}  // namespace ridgeline::cutting
