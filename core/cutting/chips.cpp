#include "core/cutting/chips.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cutting/chip_search.hpp"

namespace ridgeline::cutting {
namespace {

using std::numbers::pi;

double wrapped(double sample, int N) {
  const double w = sample - N * std::floor(sample / N);
  return w < N ? w : 0;
}

// Previous-tooth geometry: the line from O' through the element meets the
// surface that the centre of an earlier tooth swept, f behind along the feed.
//   ts = r + f b - sqrt(f^2 (b^2 - 1) + r_o^2) (6), (17) theta_on - theta_n =
//   atan2(f cos phi cos theta_n, (r - ts) sin q + f cos phi sin theta_n)  (11)
//   theta_o = theta_on + psi(q_o) - angle of the earlier tooth    without "-
//   psi(q_n)" of the print:
// theta_n = theta - psi has it already; cos q_o from (13).
Earlier earlier_at(const Scene& scene, const Edge& edge, const Aim& aim, std::int32_t sample,
                   const Before& before) {
  const int samples = scene.cut.samples;
  const double f = before.f;
  const double b = aim.N.dot(scene.fd);  // (7)
  const double root = f * f * (b * b - 1) + before.r * before.r;

  Earlier earlier;
  earlier.ts = edge.r + f * b - std::sqrt(std::max(root, 0.0));
  if (scene.around.is_still) return earlier;
  const double along = edge.r - earlier.ts;
  const double across = f * scene.cos_phi;
  const double turn = std::atan2(across * aim.c, along * edge.element->sin_q + across * aim.s);
  const Eigen::Vector3d from_earlier = (along * aim.N + f * scene.fd) / before.r;
  const double sin_q_o = std::sqrt(from_earlier.head<2>().squaredNorm());
  const double psi_o =
      lag(scene.cut.cutter, scene.tan_helix, sin_q_o, -from_earlier.z(), edge.element->z);
  earlier.delay = (before.ahead + edge.element->psi - psi_o - turn) * samples / (2 * pi);

  const double place = wrapped(sample - earlier.delay, samples);
  const double below = std::floor(place);
  earlier.before = static_cast<std::int32_t>(below);
  earlier.frac = place - below;
  if (scene.cut.lookup == Lookup::Nearest) earlier.frac = earlier.frac < 0.5 ? 0 : 1;
  return earlier;
}

Chip chip_at(const Scene& scene, const Edge& edge, const Aim& at) {
  const tool::Coefficients& k = scene.cut.coefficients;
  const double sin_q = edge.element->sin_q;
  const double cos_q = edge.element->cos_q;
  const double t_w = edge.element->width;
  const Eigen::Vector3d e_t(-at.s, -at.c, 0);  // against the cutting velocity
  const Eigen::Vector3d e_r = -at.N;           // towards O'
  const Eigen::Vector3d e_a(cos_q * at.c, -cos_q * at.s,
                            -sin_q);  // towards the tip
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
  const Eigen::Vector2d U =
      scene.centre.empty() ? Eigen::Vector2d::Zero().eval() : scene.at(sample);
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

  auto [first, found] = candidates(scene, edges, befores.front());
  out.first = std::move(first);
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
