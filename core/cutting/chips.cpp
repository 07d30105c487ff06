#include "core/cutting/chips.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cutting/boundary.hpp"

namespace ridgeline::cutting {
namespace {

using std::numbers::pi;

// What the whole table shares.
struct Scene {
  const Cut& cut;
  const Around& around;
  double largest = 0;       // deflection that may be [mm]
  std::vector<double> way;  // of the centre, from sample to sample, added up [mm]
  Eigen::Vector3d fd;
  double cos_phi = 1;
  std::vector<Element> elements;
  std::vector<double> sin_theta, cos_theta;  // of each sample
  std::vector<Boundary> boundaries;
};

// One edge element of one tooth.
struct Edge {
  const Element* element = nullptr;
  double r = 0;
  double ahead = 0;             // angle of the tooth
  double sin_k = 0, cos_k = 0;  // of theta_n - theta
  double base = 0;
};

// An element at a sample that may cut.
struct Found {
  std::int32_t sample = 0;
  std::int32_t element = 0;
};

// Direction of an element at a sample.
struct Aim {
  double s = 0;  // sin theta_n
  double c = 0;  // cos theta_n
  Eigen::Vector3d N;
};

// A centre that goes round: how far it has gone by each sample of its period and to the end of it.
std::vector<double> way_of(const Deflections& centre) {
  std::vector<double> way;
  if (centre.empty()) return way;
  way.push_back(0);
  for (std::size_t i = 0; i < centre.size(); ++i)
    way.push_back(way.back() + (centre[i + 1 < centre.size() ? i + 1 : 0] - centre[i]).norm());
  return way;
}

Scene scene(const Cut& cut, const Around& around) {
  Scene scene{.cut = cut,
              .around = around,
              .largest = around.reach,
              .way = way_of(around.centre),
              .fd = feed_direction(cut),
              .cos_phi = std::cos(cut.phi),
              .elements = elements(cut.cutter),
              .sin_theta = {},
              .cos_theta = {},
              .boundaries = boundaries(cut.stock)};
  double furthest = 0;
  for (const Eigen::Vector2d& U : around.centre) furthest = std::max(furthest, U.squaredNorm());
  scene.largest += std::sqrt(furthest);
  for (int i = 0; i < cut.samples; ++i) {
    const double theta = 2 * pi * i / cut.samples;
    scene.sin_theta.push_back(std::sin(theta));
    scene.cos_theta.push_back(std::cos(theta));
  }
  return scene;
}

Edge edge_of(const Cut& cut, const Element& element, int tooth) {
  const double ahead = tooth_angle(cut.cutter, tooth);
  return {.element = &element,
          .r = tooth_radius(cut.cutter, tooth),
          .ahead = ahead,
          .sin_k = std::sin(ahead - element.psi),
          .cos_k = std::cos(ahead - element.psi),
          .base = cut.cutter.kind == CutterKind::Square ? element.z : 0};
}

Aim aim(const Scene& scene, const Edge& edge, std::int32_t sample) {
  const double s = scene.sin_theta[static_cast<std::size_t>(sample)];
  const double c = scene.cos_theta[static_cast<std::size_t>(sample)];
  Aim aim;
  aim.s = s * edge.cos_k + c * edge.sin_k;
  aim.c = c * edge.cos_k - s * edge.sin_k;
  const double sin_q = edge.element->sin_q;
  aim.N = {-sin_q * aim.c, sin_q * aim.s, -edge.element->cos_q};
  return aim;
}

Eigen::Vector3d point(const Edge& edge, const Aim& aim) {
  return edge.r * aim.N + Eigen::Vector3d(0, 0, edge.base);
}

double wrapped(double sample, int N) {
  const double w = sample - N * std::floor(sample / N);
  return w < N ? w : 0;
}

// The tooth m before this one: how far ahead it is, what it left behind.
struct Before {
  double ahead = 0;  // angle from this tooth
  double f = 0;      // feed since it was here [mm]
  double r = 0;
};

Before before(const Cut& cut, int tooth, int m) {
  const double ahead = tooth_angle(cut.cutter, tooth + m) - tooth_angle(cut.cutter, tooth);
  return {.ahead = ahead,
          .f = cut.feed * teeth(cut.cutter) * ahead / (2 * pi),
          .r = tooth_radius(cut.cutter, tooth + m)};
}

// Previous-tooth geometry: the line from O' through the element meets the surface that the centre
// of an earlier tooth swept, f behind along the feed.
//   ts = r + f b - sqrt(f^2 (b^2 - 1) + r_o^2)                                         (6), (17)
//   theta_on - theta_n = atan2(f cos phi cos theta_n, (r - ts) sin q + f cos phi sin theta_n)  (11)
//   theta_o = theta_on + psi(q_o) - angle of the earlier tooth    without "- psi(q_n)" of the
//   print:
// theta_n = theta - psi has it already; cos q_o from (13).
Earlier earlier_at(const Scene& scene, const Edge& edge, const Aim& aim, std::int32_t sample,
                   const Before& before) {
  const int samples = scene.cut.samples;
  const double f = before.f;
  const double b = aim.N.dot(scene.fd);  // (7)
  const double root = f * f * (b * b - 1) + before.r * before.r;

  Earlier earlier;
  earlier.ts = edge.r + f * b - std::sqrt(std::max(root, 0.0));
  const double along = edge.r - earlier.ts;
  const double across = f * scene.cos_phi;
  const double turn = std::atan2(across * aim.c, along * edge.element->sin_q + across * aim.s);
  const Eigen::Vector3d from_earlier = (along * aim.N + f * scene.fd) / before.r;
  const double sin_q_o = std::sqrt(from_earlier.head<2>().squaredNorm());
  const double psi_o = lag(scene.cut.cutter, sin_q_o, -from_earlier.z(), edge.element->z);
  earlier.delay = (before.ahead + edge.element->psi - psi_o - turn) * samples / (2 * pi);

  const double place = wrapped(sample - earlier.delay, samples);
  const double below = std::floor(place);
  earlier.before = static_cast<std::int32_t>(below);
  earlier.frac = place - below;
  if (scene.cut.lookup == Lookup::Nearest) earlier.frac = earlier.frac < 0.5 ? 0 : 1;
  return earlier;
}

// Feed side: ts + w > 0 with w = sin q times how far the edge may have moved since theta_o is
// (r + w + f b)^2 > f^2 (b^2 - 1) + r_o^2, which is linear in b.
double least_b(const Edge& edge, const Before& before, double moved) {
  const double rim = edge.r + moved * edge.element->sin_q;
  return (before.r * before.r - before.f * before.f - rim * rim) / (2 * before.f * rim);
}

// A tooth period, give or take this many samples, lies between theta_o and theta: twice what (11)
// and the lag at q_o (12) can add, since q_o is within 2 f / r of q.
int slip(const Scene& scene, const Edge& edge, const Before& before) {
  const double f = before.f;
  const double along = (edge.r - 2 * f) * edge.element->sin_q - f;
  const double turn = f / std::max(along, 1e-9 * edge.r);  // atan2 of (11) is less
  const double tan_beta = std::abs(std::tan(scene.cut.cutter.helix));
  const double cos_q = std::max(edge.element->cos_q - 2 * f / edge.r, -1 + 1e-9);
  const double lag = scene.cut.cutter.kind == CutterKind::Square
                         ? 0
                         : 2 * f / edge.r * tan_beta * std::max(1.0, 1 / (1 + cos_q));
  const double samples = 2 * (turn + lag) * scene.cut.samples / (2 * pi) + 2;
  return static_cast<int>(std::min(samples, static_cast<double>(scene.cut.samples)));
}

// How far the centre may have moved within so many samples of one: no further than it went.
double moved_within(const Scene& scene, int sample, int slip) {
  const auto period = static_cast<int>(scene.around.centre.size());
  if (slip >= period) return 2 * scene.largest;
  const auto way = [&](int i) {
    const int turns = i < 0 ? -1 : i / period;
    return turns * scene.way.back() + scene.way[static_cast<std::size_t>(i - turns * period)];
  };
  const int at = sample % period;
  return std::max(way(at + slip) - way(at), way(at) - way(at - slip));
}

bool is_in_stock(const Scene& scene, const Eigen::Vector3d& P) {
  const double reach = scene.around.reach;
  const Stock& stock = scene.cut.stock;
  const std::size_t faces = stock.faces.size();
  for (std::size_t i = faces; i < scene.boundaries.size(); ++i) {
    if (!is_near(scene.boundaries[i], P, reach)) return false;
  }
  const bool all = stock.combine == Combine::All;
  bool inside = all || faces == 0;
  for (std::size_t i = 0; i < faces; ++i) {
    const bool near = is_near(scene.boundaries[i], P, reach);
    if (all && !near) return false;
    inside = inside || near;
  }
  if (!inside || !stock.map) return inside;
  const Eigen::Vector3d p = stock.map_origin + stock.map_axes * P;
  const double sunk = reach * stock.map_axes.row(2).head<2>().norm();  // of a tilted tool
  return p.z() - sunk <= greatest_height(*stock.map, p.x(), p.y(), reach);
}

// Samples from first to last, not wrapped.
struct Window {
  int first = 0;
  int last = -1;
};

// Where an element can meet the narrowest plane:
// -sin q r (n_x cos - n_y sin)(theta_n) <= h + reach |n_xy| - z n_z.
Window window(const Scene& scene, const Edge& edge) {
  const int N = scene.cut.samples;
  const Stock& stock = scene.cut.stock;
  if (stock.combine == Combine::Any && stock.faces.size() > 1) return {0, N - 1};
  const double z = edge.base - edge.r * edge.element->cos_q;
  double middle = 0;
  double half = pi;
  for (const Face& face : stock.faces) {
    const auto* plane = std::get_if<HalfSpace>(&face);
    if (plane == nullptr) continue;
    const double level = std::hypot(plane->n.x(), plane->n.y());
    const double room = plane->h + scene.largest * level - z * plane->n.z();
    const double swing = edge.r * edge.element->sin_q * level;
    if (room >= swing) continue;   // inside all round
    if (room < -swing) return {};  // never inside
    const double half_here = std::acos(-room / swing);
    if (half_here >= half) continue;
    half = half_here;
    middle = std::atan2(-plane->n.y(), plane->n.x());
  }
  if (half >= pi) return {0, N - 1};
  const double per_sample = 2 * pi / N;
  const double centre = middle - edge.ahead + edge.element->psi;
  const int first = static_cast<int>(std::floor((centre - half) / per_sample));
  const int last = static_cast<int>(std::ceil((centre + half) / per_sample));
  return {first, std::min(last, first + N - 1)};
}

void search(const Scene& scene, const Edge& edge, const Before& before, std::int32_t element,
            std::vector<Found>& found) {
  const int N = scene.cut.samples;
  const Deflections& centre = scene.around.centre;
  const double spread = 2 * scene.around.reach;
  const double least = least_b(edge, before, 2 * scene.largest);
  const double surely = least_b(edge, before, spread);
  const int slipped = centre.empty() ? 0 : slip(scene, edge, before);
  const auto cuts_deeper = [&](double b, int sample) {  // than the tooth before, perhaps
    if (b > surely) return true;
    return b > least && b > least_b(edge, before, spread + moved_within(scene, sample, slipped));
  };
  const auto [first, last] = window(scene, edge);
  std::int32_t sample = ((first % N) + N) % N;
  for (int i = first; i <= last; ++i) {
    const Aim at = aim(scene, edge, sample);
    if (cuts_deeper(at.N.dot(scene.fd), sample)) {
      Eigen::Vector3d P = point(edge, at);
      if (!centre.empty()) P.head<2>() += centre[static_cast<std::size_t>(sample) % centre.size()];
      if (is_in_stock(scene, P)) found.push_back({sample, element});
    }
    sample = sample + 1 < N ? sample + 1 : 0;
  }
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

Chip chip_at(const Scene& scene, const Edge& edge, const Aim& at) {
  const tool::Coefficients& k = scene.cut.coefficients;
  const double sin_q = edge.element->sin_q;
  const double cos_q = edge.element->cos_q;
  const double t_w = edge.element->width;
  const Eigen::Vector3d e_t(-at.s, -at.c, 0);                      // against the cutting velocity
  const Eigen::Vector3d e_r = -at.N;                               // towards O'
  const Eigen::Vector3d e_a(cos_q * at.c, -cos_q * at.s, -sin_q);  // towards the tip
  Chip chip;
  chip.N = at.N;
  chip.Fe = t_w * (k.Kte * e_t + k.Kre * e_r + k.Kae * e_a);  // (14)..(16) at t = 0
  chip.Fc = t_w * (k.Ktc * e_t + k.Krc * e_r + k.Kac * e_a);  // per t
  chip.r = edge.r;
  chip.base = edge.base;
  chip.depth = scene.cut.cutter.r + edge.r * at.N.dot(scene.cut.n);  // (25)..(27) without U
  return chip;
}

// Is an element of these terms in the stock wherever the deflection may be?
bool is_far_inside(const Scene& scene, const Term* terms, std::int32_t sample) {
  const Stock& stock = scene.cut.stock;
  if (stock.map) return false;
  const Deflections& centre = scene.around.centre;
  const Eigen::Vector2d U = centre.empty()
                                ? Eigen::Vector2d::Zero().eval()
                                : centre[static_cast<std::size_t>(sample) % centre.size()];
  const std::size_t faces = stock.faces.size();
  std::size_t inside = 0;
  for (std::size_t i = 0; i < scene.boundaries.size(); ++i) {
    const bool is_in = is_far_inside(scene.boundaries[i], terms[i], U, scene.around.reach);
    if (!is_in && i >= faces) return false;
    inside += is_in && i < faces ? 1 : 0;
  }
  return faces == 0 || (stock.combine == Combine::All ? inside == faces : inside > 0);
}

ToothChips tooth_chips(const Scene& scene, int tooth, ToothChips out) {
  const Cut& cut = scene.cut;
  std::vector<Edge> edges;
  for (const Element& element : scene.elements) edges.push_back(edge_of(cut, element, tooth));
  std::vector<Before> befores;
  for (int m = 1; m <= cut.earlier_teeth; ++m) befores.push_back(before(cut, tooth, m));

  std::vector<Found> found;
  for (std::size_t j = 0; j < edges.size(); ++j) {
    search(scene, edges[j], befores.front(), static_cast<std::int32_t>(j), found);
  }
  out.first = sort_by_sample(found, cut.samples);
  out.chips.clear();
  out.terms.clear();
  out.earlier.clear();
  out.chips.reserve(found.size());
  out.terms.reserve(found.size() * scene.boundaries.size());
  for (const auto& [sample, element] : found) {
    const Edge& edge = edges[static_cast<std::size_t>(element)];
    const Aim at = aim(scene, edge, sample);
    out.chips.push_back(chip_at(scene, edge, at));
    out.chips.back().element = element;
    out.chips.back().earlier = earlier_at(scene, edge, at, sample, befores.front());
    for (std::size_t m = 1; m < befores.size(); ++m) {
      out.earlier.push_back(earlier_at(scene, edge, at, sample, befores[m]));
    }
    for (const Boundary& boundary : scene.boundaries) {
      out.terms.push_back(term_at(boundary, point(edge, at)));
    }
    out.chips.back().is_inside =
        is_far_inside(scene, out.terms.data() + out.terms.size() - scene.boundaries.size(), sample);
  }
  return out;
}

}  // namespace

ChipTable chip_table(const Cut& cut, Around around, ChipTable spent) {
  const Scene view = scene(cut, around);
  const int z = teeth(cut.cutter);
  const bool one_for_all = is_periodic(cut.cutter) && cut.samples % z == 0;
  ChipTable table = std::move(spent);
  table.cut = cut;
  table.pitch_samples = one_for_all ? cut.samples / z : 0;
  table.curves.clear();
  for (const Boundary& boundary : view.boundaries) {
    table.curves.push_back({boundary.sign, boundary.a.x(), boundary.a.y()});
  }
  table.teeth.resize(one_for_all ? 1 : static_cast<std::size_t>(z));
  for (std::size_t k = 0; k < table.teeth.size(); ++k) {
    table.teeth[k] = tooth_chips(view, static_cast<int>(k), std::move(table.teeth[k]));
  }
  table.around = std::move(around);
  return table;
}

}  // namespace ridgeline::cutting
