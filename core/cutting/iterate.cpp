#include "core/cutting/iterate.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "core/cutting/require.hpp"

namespace ridgeline::cutting {
namespace {

// A deflection of any number of samples, read at n.
Deflections resampled(const Deflections& from, int n) {
  if (from.empty()) return Deflections(static_cast<std::size_t>(n), Eigen::Vector2d::Zero());
  if (from.size() == static_cast<std::size_t>(n)) return from;
  Deflections to;
  const double step = static_cast<double>(from.size()) / n;
  for (int i = 0; i < n; ++i) {
    const double at = i * step;
    const auto below = static_cast<std::size_t>(at);
    const Eigen::Vector2d& next = from[(below + 1) % from.size()];
    to.push_back(from[below] + (at - static_cast<double>(below)) * (next - from[below]));
  }
  return to;
}

double squared_sum(const Deflections& D) {
  double sum = 0;
  for (const Eigen::Vector2d& d : D) sum += d.squaredNorm();
  return sum;
}

// Where in its period a force is: the angle of its first harmonic. nullopt: all round, or none.
std::optional<double> middle(const Forces& F) {
  std::complex<double> sum = 0;
  double total = 0;
  const double turn = 2 * std::numbers::pi / static_cast<double>(F.size());
  for (std::size_t i = 0; i < F.size(); ++i) {
    if (F[i].isZero(0)) continue;
    const double size = F[i].norm();
    sum += std::polar(size, turn * static_cast<double>(i));
    total += size;
  }
  constexpr double clear = 0.1;
  if (!(std::abs(sum) > clear * total)) return {};
  return std::arg(sum) / turn;
}

// (1)
double residual(const Deflections& D4, const Deflections& D1) {
  double A = 0;
  for (std::size_t i = 0; i < D4.size(); ++i) A += (D4[i] - D1[i]).squaredNorm();
  return A;
}

// (3)..(5) with w2 = 1.
void average(Deflections& D1, const Deflections& D4, double w1) {
  for (std::size_t i = 0; i < D1.size(); ++i) D1[i] = (w1 * D1[i] + D4[i]) / (w1 + 1);
}

// Step S311 and the table of figure 14. The minimum starts anew after a change, or the old one
// would call the next loop divergent at once.
class Weights {
public:
  explicit Weights(const IterateOptions& options) : options_(options) {}

  double w1() const { return options_.weights[used_]; }

  /// Takes the residual of one loop; true when it changed the weight. The last weight stays.
  bool changed_by(double A) {
    const bool diverges = A > options_.beta * least_ || since_least_ >= options_.stall;
    since_least_ = A < least_ ? 0 : since_least_ + 1;
    least_ = std::min(least_, A);
    if (!options_.adapt || !diverges || used_ + 1 == options_.weights.size()) return false;
    ++used_;
    least_ = A;
    since_least_ = 0;
    return true;
  }

private:
  const IterateOptions& options_;
  std::size_t used_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
  int since_least_ = 0;
};

// How far the deflection may still go from where it has come to: as far as it has come from where
// the chips before were searched, at most this much of its greatest.
constexpr double margin = 0.6;

// kappa / tc, which must leave the tool its resonances: at 1.4 fn the error moves by 0.8 um, at 2
// fn by 0.1 um (design: section 5). nullopt: it does not, and the cut goes without.
std::optional<double> checked_cutoff(const IterateOptions& options, double tc,
                                     const Compliance& compliance) {
  constexpr double least_ratio = 2;
  if (!options.kappa || !(tc > 0)) return {};
  const double cutoff = *options.kappa / tc;
  const std::vector<double> fn = natural_frequencies(compliance);
  const double least = fn.empty() ? 0 : least_ratio * fn.back();
  if (cutoff >= least) return cutoff;
  if (options.guard == LowPassGuard::Off) return {};
  require_between("/options/kappa", cutoff, least, std::numeric_limits<double>::max(),
                  "Hz, where the low-pass kappa / tc cuts; twice the highest natural frequency");
  return {};
}

}  // namespace

Iteration::Iteration(const Compliance& compliance, double S, IterateOptions options)
    : compliance_(compliance), S_(S), options_(std::move(options)) {}

// Searches the chips for the deflection in use; the memory of the table before serves again. Of
// equal teeth that begin from a deflection, only the chips round that, which may still change by
// `change`: by nothing in the first loop, which along a path is often the only one. The rigid
// method needs those that a tool cuts which does not give way, and no others.
void Iteration::make_room(const Cut& cut, const Deflections& D, double change) {
  constexpr double least_reach = 0.02;
  constexpr double further = 1.5;
  const double used = greatest_deflection(cut, D);
  Around around;
  if (is_rigid_) {
    around.reach = cut.cutter.offset;
    around.is_still = around.reach == 0;
  } else if (is_centred_) {
    around = {std::min(change, margin * used), D};
  } else {
    around.reach = std::max(least_reach, further * used);
  }
  table_ = chip_table(cut, std::move(around), std::move(table_));
  scale_forces(table_, cut_scale_, edge_scale_);
}

Prediction Iteration::solve(const Cut& cut, const Eigen::Matrix2d& axes, const Deflections& start,
                            const Progress& progress) {
  const int z = options_.span == Span::Pitch ? teeth(cut.cutter) : 1;
  if (!response_ || samples_ != cut.samples / z) {
    samples_ = cut.samples / z;
    response_.emplace(compliance_, samples_, S_ * z);
  }
  response_->turn(axes);
  constexpr double turned = 0.5;  // 20 degrees: the differences are of another cut
  if ((axes - axes_).norm() > turned) {
    secants_.clear();
    last_place_.reset();
  }
  axes_ = axes;
  cut_scale_ = edge_scale_ = 1;
  Deflections D1 = resampled(start, samples_);
  is_rigid_ = start.empty() && options_.max_loops == 1;
  is_centred_ = !start.empty() && options_.span == Span::Pitch && is_periodic(cut.cutter) &&
                cut.samples % teeth(cut.cutter) == 0;
  make_room(cut, D1, 0);
  Prediction out = loops(std::move(D1), progress);
  place_.reset();
  if (options_.span == Span::Pitch) place_ = middle(out.F);
  return out;
}

Deflections Iteration::next_start(const Deflections& start) {
  constexpr double furthest = 0.05;  // of a tooth period: beyond it the cut is another one
  const std::optional<double> before = std::exchange(last_place_, place_);
  if (!before || !place_ || start.empty()) return start;
  const double later = std::remainder(*place_ - *before, samples_);
  if (std::abs(later) > furthest * samples_) return start;
  secants_.move_on(later);
  return moved_on(start, later);
}

void Iteration::adopt(const Cut& cut, Deflections D) {
  cut_scale_ = edge_scale_ = 1;
  is_centred_ = is_rigid_ = false;
  place_.reset();
  make_room(cut, D, 0);
  span_ = Span::Revolution;
  revolution_ = revolution_force(table_, D, span_);
  D_ = std::move(D);
}

Prediction Iteration::scaled(double cut_scale, double edge_scale) {
  Deflections D = D_;  // of a whole revolution, if another method found it
  D.resize(static_cast<std::size_t>(samples_));
  if (is_rigid_) D.assign(D.size(), Eigen::Vector2d::Zero());
  const double cut_change = cut_scale / cut_scale_;
  const double edge_change = edge_scale / edge_scale_;
  cut_scale_ = cut_scale;
  edge_scale_ = edge_scale;
  const bool has_room =
      is_rigid_ || greatest_deflection(table_.cut, D, table_.around.centre) <= table_.around.reach;
  if (!has_room) {
    make_room(Cut(table_.cut), D, std::numeric_limits<double>::infinity());
  } else {
    scale_forces(table_, cut_change, edge_change);
  }
  return loops(std::move(D), {});
}

std::optional<double> Iteration::error_towards(const Eigen::Vector3d& n) const {
  return machining_error(table_, revolution_, D_, span_, n);
}

Prediction Iteration::loops(Deflections D1, const Progress& progress) {
  const int z = options_.span == Span::Pitch ? teeth(table_.cut.cutter) : 1;
  const int N = table_.cut.samples;
  span_ = options_.span;
  secants_.begin_cut();
  Weights weights(options_);
  Prediction out;
  double cutoff = std::numeric_limits<double>::infinity();
  while (true) {
    progress.at(static_cast<double>(out.loops) / options_.max_loops, "iteration");
    revolution_ = revolution_force(table_, D1, options_.span);
    if (out.loops++ == 0) {
      out.contact_time = revolution_.cut_steps / (N * S_);
      out.cutoff = checked_cutoff(options_, out.contact_time, compliance_);
      if (out.cutoff) cutoff = *out.cutoff;
    }
    D_ = response_->deflections(revolution_.F, cutoff);
    out.A.push_back(residual(D_, D1) * z);
    if (options_.keeps_history) {
      out.e_history.push_back(
          machining_error(table_, revolution_, D_, options_.span, table_.cut.n));
    }
    const double lambda = options_.alpha * squared_sum(D_) * z;  // (2)
    out.converged = out.A.back() < lambda || out.A.back() == 0;
    if (out.converged || out.loops >= options_.max_loops) break;
    if (options_.mixing == Mixing::Secants) {
      D1 = secants_.next(D1, D_);
    } else {
      if (weights.changed_by(out.A.back())) {
        out.weight_changes.push_back({out.loops, weights.w1()});
      }
      average(D1, D_, weights.w1());
    }
    const Around& around = table_.around;
    const double away = greatest_deflection(table_.cut, D1, around.centre);
    if (away > around.reach) {
      if (greatest_deflection(table_.cut, D1) > options_.largest) break;
      make_room(Cut(table_.cut), D1, away);
    }
  }
  out.e = machining_error(table_, revolution_, D_, options_.span, table_.cut.n);
  out.cut_points = revolution_.cut_points;
  out.F = revolution_.F;
  out.D = D_;
  if (options_.mixing == Mixing::Secants && out.converged) out.ahead = secants_.ahead(D1, D_);
  out.w1 = weights.w1();
  out.reach = table_.around.reach;
  return out;
}

Prediction iterate(const Cut& cut, const Compliance& compliance, double S,
                   const IterateOptions& options, const Deflections& start,
                   const Progress& progress) {
  return Iteration(compliance, S, options).solve(cut, compliance.axes, start, progress);
}

Prediction rigid(const Cut& cut, const Compliance& compliance, double S, Span span) {
  IterateOptions once;
  once.max_loops = 1;
  once.span = span;
  return iterate(cut, compliance, S, once);
}

}  // namespace ridgeline::cutting
