#include "core/cutting/iterate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

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
    const Eigen::Vector2d next = from[(below + 1) % from.size()];
    to.push_back(from[below] + (at - static_cast<double>(below)) * (next - from[below]));
  }
  return to;
}

double squared_sum(const Deflections& D) {
  double sum = 0;
  for (const Eigen::Vector2d& d : D) sum += d.squaredNorm();
  return sum;
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

// kappa / tc, which must leave the tool its resonances: at 1.4 fn the error moves by 0.8 um, at 2
// fn by 0.1 um (design: section 5).
double checked_cutoff(double kappa, double tc, const Compliance& compliance) {
  constexpr double least_ratio = 2;
  const double cutoff = kappa / tc;
  const std::vector<double> fn = natural_frequencies(compliance);
  if (!fn.empty()) {
    require_between("/options/kappa", cutoff, least_ratio * fn.back(),
                    std::numeric_limits<double>::max(),
                    "Hz, where the low-pass kappa / tc cuts; twice the highest natural frequency");
  }
  return cutoff;
}

}  // namespace

Prediction iterate(const Cut& cut, const Compliance& compliance, double S,
                   const IterateOptions& options, const Deflections& start,
                   const Progress& progress) {
  const int z = options.span == Span::Pitch ? teeth(cut.cutter) : 1;
  const int samples = cut.samples / z;
  const Response response(compliance, samples, S * z);
  Deflections D1 = resampled(start, samples);
  constexpr double first_reach = 0.05;
  ChipTable table = chip_table(cut, first_reach);
  if (const double used = greatest_deflection(table, D1); used > table.reach) {
    table = chip_table(cut, 1.5 * used);
  }
  Weights weights(options);
  Prediction out;
  double cutoff = std::numeric_limits<double>::infinity();
  while (true) {
    progress.at(static_cast<double>(out.loops) / options.max_loops, "iteration");
    const Revolution revolution = revolution_force(table, D1, options.span);
    if (out.loops++ == 0) {
      out.contact_time = revolution.cut_steps / (cut.samples * S);
      if (options.kappa && revolution.cut_steps > 0) {
        cutoff = checked_cutoff(*options.kappa, out.contact_time, compliance);
        out.cutoff = cutoff;
      }
    }
    const Deflections D4 = response.deflections(revolution.F, cutoff);
    out.A.push_back(residual(D4, D1) * z);
    out.e = machining_error(table, revolution, D4, options.span);
    out.e_history.push_back(out.e);
    out.cut_points = revolution.cut_points;
    const double lambda = options.alpha * squared_sum(D4) * z;  // (2)
    out.converged = out.A.back() < lambda || out.A.back() == 0;
    const bool is_last = out.converged || out.loops >= options.max_loops;
    if (!is_last && weights.changed_by(out.A.back())) {
      out.weight_changes.push_back({out.loops, weights.w1()});
    }
    if (is_last) {
      out.F = revolution.F;
      out.D = D4;
      break;
    }
    average(D1, D4, weights.w1());
    if (const double used = greatest_deflection(table, D1); used > table.reach) {
      table = chip_table(cut, 1.5 * used);
    }
  }
  out.w1 = weights.w1();
  out.reach = table.reach;
  return out;
}

Prediction rigid(const Cut& cut, const Compliance& compliance, double S, Span span) {
  IterateOptions once;
  once.max_loops = 1;
  once.span = span;
  return iterate(cut, compliance, S, once);
}

}  // namespace ridgeline::cutting
