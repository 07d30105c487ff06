#include "core/cutting/chips.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cutting/chip_search.hpp"

namespace ridgeline::cutting {
namespace {

using std::numbers::pi;

// atan2(y, x), which for the small angles that nearly all are is a series: the terms left out are
// below the rounding.
double small_atan2(double y, double x) {
  if (!(x > 0 && std::abs(y) < 0.125 * x)) return std::atan2(y, x);
  const double u = y / x;
  const double w = u * u;
  const double w2 = w * w;
  const double low = (1 - w * (1.0 / 3)) + w2 * (1.0 / 5 - w * (1.0 / 7));
  const double high = (1.0 / 9 - w * (1.0 / 11)) + w2 * (1.0 / 13 - w * (1.0 / 15));
  return u * (low + w2 * w2 * high);
}

double wrapped(double sample, int N) {
  if (sample >= 0 && sample < N) return sample;
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
  const double sin_q = edge.element->sin_q;
  const double cos_q = edge.element->cos_q;
  const double f = before.f;
  const double across = f * scene.cos_phi;
  const double b = sin_q * scene.cos_phi * aim.s - cos_q * scene.fd.z();  // (7)
  const double root = f * f * (b * b - 1) + before.r * before.r;

  Earlier earlier;
  earlier.ts = edge.r + f * b - std::sqrt(std::max(root, 0.0));
  if (scene.around.is_still) return earlier;
  const double along = edge.r - earlier.ts;
  const double x = along * sin_q + across * aim.s;
  const double y = across * aim.c;
  const double sin_q_o = std::sqrt(x * x + y * y) * before.per_r;
  const double cos_q_o = (along * cos_q - f * scene.fd.z()) * before.per_r;
  const double psi_o = lag(scene.cut.cutter, scene.tan_helix, sin_q_o, cos_q_o, edge.element->z);
  earlier.delay = (before.ahead + edge.element->psi - psi_o - small_atan2(y, x)) * scene.per_radian;

  const double place = wrapped(sample - earlier.delay, samples);
  earlier.before = static_cast<std::int32_t>(place);
  earlier.frac = place - earlier.before;
  if (scene.cut.lookup == Lookup::Nearest) earlier.frac = earlier.frac < 0.5 ? 0 : 1;
  return earlier;
}

// A force on an element, turned to where it stands: along -e_t, across it in the plane, along Z.
struct Turning {
  double by_t = 0, by_n = 0, by_z = 0;

  // (14)..(16): e_t = (-s, -c, 0) against the cutting velocity; e_r = (sin q c, -sin q s, cos q)
  // towards O'; e_a = (cos q c, -cos q s, -sin q) towards the tip.
  Turning(const Element& element, double Kt, double Kr, double Ka)
      : by_t(element.width * Kt),
        by_n(element.width * (Kr * element.sin_q + Ka * element.cos_q)),
        by_z(element.width * (Kr * element.cos_q - Ka * element.sin_q)) {}

  Eigen::Vector3d at(const Aim& aim) const {
    return {by_n * aim.c - by_t * aim.s, -by_t * aim.c - by_n * aim.s, by_z};
  }
};

// What all chips of an element share.
struct Blade {
  Edge edge;
  Turning Fe;  // at t = 0
  Turning Fc;  // per t
};

Blade blade(const Cut& cut, const Element& element, int tooth) {
  const tool::Coefficients& k = cut.coefficients;
  return {
      edge_of(cut, element, tooth), {element, k.Kte, k.Kre, k.Kae}, {element, k.Ktc, k.Krc, k.Kac}};
}

void put_chip(const Scene& scene, const Blade& blade, const Aim& at, Chip& chip) {
  const Edge& edge = blade.edge;
  chip.N = outward(edge, at);
  chip.Fe = blade.Fe.at(at);
  chip.Fc = blade.Fc.at(at);
  chip.r = edge.r;
  chip.base = edge.base;
  chip.depth = scene.cut.cutter.r + edge.r * chip.N.dot(scene.cut.n);  // (25)..(27) without U
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

// With no reach at all whatever the search found is engaged; a map it looks at less closely.
bool is_exact(const Scene& scene) {
  return scene.around.reach == 0 && !scene.cut.stock.map;
}

// The faces and grooves as a chip meets them; true: whatever the deflection.
bool put_terms(const Scene& scene, const Eigen::Vector3d& P, std::int32_t sample,
               std::vector<Term>& terms) {
  for (const Boundary& boundary : scene.boundaries) terms.push_back(term_at(boundary, P));
  return is_far_inside(scene, terms.data() + (terms.size() - scene.boundaries.size()), sample);
}

ToothChips tooth_chips(const Scene& scene, int tooth, ToothChips out) {
  const Cut& cut = scene.cut;
  std::vector<Blade> blades;
  blades.reserve(scene.turn.elements.size());
  for (const Element& element : scene.turn.elements) blades.push_back(blade(cut, element, tooth));
  std::vector<Edge> edges;
  edges.reserve(blades.size());
  for (const Blade& one : blades) edges.push_back(one.edge);
  std::vector<Before> befores;
  for (int m = 1; m <= cut.earlier_teeth; ++m) befores.push_back(before(cut, tooth, m));

  auto [first, found] = candidates(scene, edges, befores.front());
  out.first = std::move(first);
  out.terms.clear();
  out.earlier.clear();
  out.chips.resize(found.size());
  const bool has_terms = !is_exact(scene) || cut.chip_end == ChipEnd::StockLimited;
  if (has_terms) out.terms.reserve(found.size() * scene.boundaries.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& [sample, element] = found[i];
    const Blade& own = blades[static_cast<std::size_t>(element)];
    const Aim at = aim(scene, own.edge, sample);
    Chip& chip = out.chips[i];
    put_chip(scene, own, at, chip);
    chip.element = element;
    chip.earlier = earlier_at(scene, own.edge, at, sample, befores.front());
    for (std::size_t m = 1; m < befores.size(); ++m) {
      out.earlier.push_back(earlier_at(scene, own.edge, at, sample, befores[m]));
    }
    chip.is_inside = is_exact(scene);
    if (has_terms && put_terms(scene, point(own.edge, at), sample, out.terms)) {
      chip.is_inside = true;
    }
  }
  return out;
}

}  // namespace

ChipTable chip_table(const Cut& cut, Around around, ChipTable spent) {
  const bool has_turn = spent.cut.samples == cut.samples && !spent.turn.elements.empty() &&
                        spent.cut.cutter == cut.cutter;
  if (!has_turn) spent.turn = turn(cut);
  const Scene view = scene(cut, around, spent.turn);
  const int z = teeth(cut.cutter);
  const bool one_for_all = is_periodic(cut.cutter) && cut.samples % z == 0;
  ChipTable& table = spent;
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
  return spent;
}

}  // namespace ridgeline::cutting
