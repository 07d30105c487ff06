#include "core/cutting/chips.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ridgeline::cutting {
namespace {

using std::numbers::pi;

// What the whole table shares.
struct Scene {
  const Cut& cut;
  Eigen::Vector3d fd;
  double cos_phi = 1;
  double reach = 0;
  std::vector<Element> elements;
  std::vector<double> sin_theta, cos_theta;  // of each sample
  std::vector<Face> boundaries;              // faces, then grooves
};

// One edge element and its direction at one sample.
struct Place {
  int tooth = 0;
  const Element* element = nullptr;
  double s = 0;  // sin theta_n
  double c = 0;  // cos theta_n
  double r = 0;
  int sample = 0;
};

struct Found {
  std::int32_t sample = 0;
  Chip chip;
};

// A row under construction: chips in the order found, sorted by sample at the end.
struct Gathered {
  std::vector<Found> found;
  std::vector<Term> terms;
  std::vector<Earlier> earlier;
};

Scene scene(const Cut& cut, double reach) {
  Scene scene{cut, feed_direction(cut), std::cos(cut.phi), reach, elements(cut.cutter), {}, {}, {}};
  for (int i = 0; i < cut.samples; ++i) {
    const double theta = 2 * pi * i / cut.samples;
    scene.sin_theta.push_back(std::sin(theta));
    scene.cos_theta.push_back(std::cos(theta));
  }
  scene.boundaries = cut.stock.faces;
  for (const Round& groove : cut.stock.grooves) scene.boundaries.emplace_back(groove);
  return scene;
}

double wrapped(double sample, int N) {
  const double w = sample - N * std::floor(sample / N);
  return w < N ? w : 0;
}

// Previous-tooth geometry, m teeth back: the line from O' through the element meets the surface
// that the centre of tooth k + m swept, f_m behind along the feed.
//   ts = r + f b - sqrt(f^2 (b^2 - 1) + r_o^2)                                   (6), (17)
//   theta_on - theta_n = atan2(f cos phi cos theta_n, (r - ts) sin q + f cos phi sin theta_n)  (11)
//   theta_o = theta_on + psi(q_o) - angle of tooth k + m      without "- psi(q_n)" of the print:
// theta_n = theta - psi has it already; cos q_o from (13).
Earlier earlier_at(const Scene& scene, const Place& at, const Eigen::Vector3d& N, int m) {
  const Cutter& cutter = scene.cut.cutter;
  const int samples = scene.cut.samples;
  const double ahead = tooth_angle(cutter, at.tooth + m) - tooth_angle(cutter, at.tooth);
  const double f = scene.cut.feed * teeth(cutter) * ahead / (2 * pi);
  const double r_o = tooth_radius(cutter, at.tooth + m);
  const double b = N.dot(scene.fd);  // (7)
  const double root = f * f * (b * b - 1) + r_o * r_o;

  Earlier earlier;
  earlier.ts = at.r + f * b - std::sqrt(std::max(root, 0.0));
  const double along = at.r - earlier.ts;
  const double across = f * scene.cos_phi;
  const double turn =
      std::atan2(across * at.c, along * at.element->sin_q + across * at.s);  // theta_on - theta_n
  const Eigen::Vector3d from_earlier = (along * N + f * scene.fd) / r_o;
  const double sin_q_o = std::hypot(from_earlier.x(), from_earlier.y());
  const double psi_o = lag(cutter, sin_q_o, -from_earlier.z(), at.element->z);
  earlier.delay = (ahead + at.element->psi - psi_o - turn) * samples / (2 * pi);

  const double place = wrapped(at.sample - earlier.delay, samples);
  const double below = std::floor(place);
  earlier.before = static_cast<std::int32_t>(below);
  earlier.frac = place - below;
  if (scene.cut.lookup == Lookup::Nearest) earlier.frac = earlier.frac < 0.5 ? 0 : 1;
  return earlier;
}

Eigen::Vector3d across_axis(const Round& round, const Eigen::Vector3d& v) {
  return v - v.dot(round.axis) * round.axis;
}

// g(U) of a face at P + U: g0 + g.U + curve |U_perp|^2.
Term term_at(const Face& face, const Eigen::Vector3d& P) {
  if (const auto* plane = std::get_if<HalfSpace>(&face)) {
    return {P.dot(plane->n) - plane->h, plane->n.x(), plane->n.y()};
  }
  const Round& round = std::get<Round>(face);
  const Eigen::Vector3d b = across_axis(round, P - round.centre);
  const double sign = round.material == MaterialSide::Inside ? 1 : -1;
  return {sign * (b.squaredNorm() - round.R * round.R), sign * 2 * b.x(), sign * 2 * b.y()};
}

Curve curve_of(const Face& face) {
  const auto* round = std::get_if<Round>(&face);
  if (round == nullptr) return {};
  const double sign = round->material == MaterialSide::Inside ? 1 : -1;
  return {sign, round->axis.x(), round->axis.y()};
}

// May the element be inside for some |U| <= reach?
bool is_within_reach(const Term& term, const Curve& curve, double reach) {
  const double gain = std::hypot(term.gx, term.gy) * reach;
  const double bend = curve.sign < 0 ? reach * reach : 0;
  return term.g0 - gain - bend <= 0;
}

bool is_candidate(const Scene& scene, const std::vector<Curve>& curves, const Term* terms,
                  const Eigen::Vector3d& P) {
  const Stock& stock = scene.cut.stock;
  const std::size_t faces = stock.faces.size();
  const auto near = [&](std::size_t i) {
    return is_within_reach(terms[i], curves[i], scene.reach);
  };
  for (std::size_t i = faces; i < curves.size(); ++i) {
    if (!near(i)) return false;
  }
  std::size_t inside = 0;
  for (std::size_t i = 0; i < faces; ++i) inside += near(i) ? 1U : 0U;
  if (faces > 0 && (stock.combine == Combine::All ? inside < faces : inside == 0)) return false;
  if (!stock.map) return true;
  const Eigen::Vector2d p =
      stock.map_origin.head<2>() + stock.map_axes * Eigen::Vector2d(P.head<2>());
  const double height = P.z() + stock.map_origin.z();
  return height <= greatest_height(*stock.map, p.x(), p.y(), scene.reach);
}

Chip chip_at(const Scene& scene, const Place& at, const Eigen::Vector3d& N) {
  const tool::Coefficients& k = scene.cut.coefficients;
  const double sq = at.element->sin_q;
  const double cq = at.element->cos_q;
  const double t_w = at.element->width;
  const Eigen::Vector3d e_t(-at.s, -at.c, 0);             // against the cutting velocity
  const Eigen::Vector3d e_r = -N;                         // towards O'
  const Eigen::Vector3d e_a(cq * at.c, -cq * at.s, -sq);  // towards the tip
  Chip chip;
  chip.N = N;
  chip.Fe = t_w * (k.Kte * e_t + k.Kre * e_r + k.Kae * e_a);  // (14)..(16) at t = 0
  chip.Fc = t_w * (k.Ktc * e_t + k.Krc * e_r + k.Kac * e_a);  // per t
  chip.r = at.r;
  chip.depth = scene.cut.cutter.r + at.r * N.dot(scene.cut.n);  // (25)..(27) without U
  return chip;
}

void gather(const Scene& scene, const std::vector<Curve>& curves, const Place& at, Gathered& row) {
  const Eigen::Vector3d N(-at.element->sin_q * at.c, at.element->sin_q * at.s, -at.element->cos_q);
  Eigen::Vector3d P = at.r * N;
  const double base = scene.cut.cutter.kind == CutterKind::Square ? at.element->z : 0;
  P.z() += base;

  const std::size_t first_term = row.terms.size();
  for (const Face& face : scene.boundaries) row.terms.push_back(term_at(face, P));
  if (!is_candidate(scene, curves, row.terms.data() + first_term, P)) {
    row.terms.resize(first_term);
    return;
  }
  Chip chip = chip_at(scene, at, N);
  chip.base = base;
  chip.earlier = earlier_at(scene, at, N, 1);
  if (chip.earlier.ts + 2 * scene.reach * at.element->sin_q <= 0) {
    row.terms.resize(first_term);
    return;
  }
  row.found.push_back({at.sample, chip});
  for (int m = 2; m <= scene.cut.earlier_teeth; ++m) {
    row.earlier.push_back(earlier_at(scene, at, N, m));
  }
}

// Samples from first to last, not wrapped, in which an element can meet the narrowest plane:
// -sin q r (n_x cos - n_y sin)(theta_n) <= h + reach + r cos q n_z.
struct Window {
  int first = 0;
  int last = -1;
};

Window window(const Scene& scene, const Element& element, double r, double ahead) {
  const int N = scene.cut.samples;
  const Stock& stock = scene.cut.stock;
  double middle = 0;
  double half = pi;
  for (const Face& face : stock.faces) {
    const auto* plane = std::get_if<HalfSpace>(&face);
    if (plane == nullptr || (stock.combine == Combine::Any && stock.faces.size() > 1)) continue;
    const double level = std::hypot(plane->n.x(), plane->n.y());
    const double z = scene.cut.cutter.kind == CutterKind::Square ? element.z : -r * element.cos_q;
    const double room = plane->h + scene.reach * level - z * plane->n.z();
    const double swing = r * element.sin_q * level;
    if (room >= swing) continue;   // inside all round
    if (room < -swing) return {};  // never inside
    const double reach_angle = std::acos(-room / swing);
    if (reach_angle >= half) continue;
    half = reach_angle;
    middle = std::atan2(-plane->n.y(), plane->n.x());
  }
  if (half >= pi) return {0, N - 1};
  const double per_sample = 2 * pi / N;
  const double centre = middle - ahead + element.psi;
  const int first = static_cast<int>(std::floor((centre - half) / per_sample));
  const int last = static_cast<int>(std::ceil((centre + half) / per_sample));
  return {first, std::min(last, first + N - 1)};
}

ToothChips sorted(const Gathered& row, const Cut& cut, std::size_t terms) {
  const auto N = static_cast<std::size_t>(cut.samples);
  const auto back = static_cast<std::size_t>(cut.earlier_teeth - 1);
  ToothChips tooth;
  tooth.first.assign(N + 1, 0);
  for (const Found& found : row.found) ++tooth.first[static_cast<std::size_t>(found.sample) + 1];
  for (std::size_t i = 0; i < N; ++i) tooth.first[i + 1] += tooth.first[i];
  std::vector<std::int32_t> next(tooth.first.begin(), tooth.first.end() - 1);
  tooth.chips.resize(row.found.size());
  tooth.terms.resize(row.terms.size());
  tooth.earlier.resize(row.earlier.size());
  for (std::size_t i = 0; i < row.found.size(); ++i) {
    const auto to = static_cast<std::size_t>(next[static_cast<std::size_t>(row.found[i].sample)]++);
    tooth.chips[to] = row.found[i].chip;
    for (std::size_t b = 0; b < terms; ++b) tooth.terms[to * terms + b] = row.terms[i * terms + b];
    for (std::size_t m = 0; m < back; ++m) tooth.earlier[to * back + m] = row.earlier[i * back + m];
  }
  return tooth;
}

ToothChips tooth_chips(const Scene& scene, const std::vector<Curve>& curves, int tooth) {
  const int N = scene.cut.samples;
  const double r = tooth_radius(scene.cut.cutter, tooth);
  const double ahead = tooth_angle(scene.cut.cutter, tooth);
  Gathered row;
  for (const Element& element : scene.elements) {
    const double sin_k = std::sin(ahead - element.psi);
    const double cos_k = std::cos(ahead - element.psi);
    const auto [first, last] = window(scene, element, r, ahead);
    for (int i = first; i <= last; ++i) {
      const int sample = ((i % N) + N) % N;
      const double s = scene.sin_theta[static_cast<std::size_t>(sample)];
      const double c = scene.cos_theta[static_cast<std::size_t>(sample)];
      gather(scene, curves,
             {.tooth = tooth,
              .element = &element,
              .s = s * cos_k + c * sin_k,
              .c = c * cos_k - s * sin_k,
              .r = r,
              .sample = sample},
             row);
    }
  }
  return sorted(row, scene.cut, curves.size());
}

}  // namespace

ChipTable chip_table(const Cut& cut, double reach) {
  const Scene view = scene(cut, reach);
  ChipTable table{.cut = cut, .reach = reach, .pitch_samples = 0, .teeth = {}, .curves = {}};
  for (const Face& face : view.boundaries) table.curves.push_back(curve_of(face));
  const int z = teeth(cut.cutter);
  const bool one_for_all = is_periodic(cut.cutter) && cut.samples % z == 0;
  if (one_for_all) table.pitch_samples = cut.samples / z;
  for (int k = 0; k < (one_for_all ? 1 : z); ++k) {
    table.teeth.push_back(tooth_chips(view, table.curves, k));
  }
  return table;
}

}  // namespace ridgeline::cutting
