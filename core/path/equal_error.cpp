#include "core/path/equal_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include "core/base/text.hpp"

namespace ridgeline::path {
namespace {

constexpr int even_rounds = 4;  // 1 or 2 do for a smooth curve

// Value at x of a piecewise linear function through (xs, ys), xs ascending.
double interpolated(std::span<const double> xs, std::span<const double> ys, double x) {
  const auto after = std::ranges::upper_bound(xs, x);
  const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
      after - xs.begin(), 1, static_cast<std::ptrdiff_t>(xs.size()) - 1));
  const double width = xs[i] - xs[i - 1];
  const double s = width > 0 ? (x - xs[i - 1]) / width : 0;
  return ys[i - 1] + std::clamp(s, 0.0, 1.0) * (ys[i] - ys[i - 1]);
}

// One stretch between two breaks, cut into chords: ends and the bound of each chord.
struct Stretch {
  std::vector<double> u;
  std::vector<double> bound;
  double worst = 0;
};

// `count` chords in equal steps of `measure` over the ascending parameters `at`.
std::vector<double> equal_steps(std::span<const double> at, std::span<const double> measure,
                                int count) {
  std::vector<double> u;
  u.reserve(static_cast<std::size_t>(count) + 1);
  u.push_back(at.front());
  const double total = measure.back() - measure.front();
  for (int i = 1; i < count; ++i) {
    const double share = static_cast<double>(i) / count;
    u.push_back(total > 0 ? interpolated(measure, at, measure.front() + share * total)
                          : at.front() + share * (at.back() - at.front()));
  }
  u.push_back(at.back());
  return u;
}

void bound(const ClosedCurve& curve, double tolerance, Stretch& stretch, const Progress& progress) {
  stretch.bound.clear();
  stretch.worst = 0;
  for (std::size_t i = 1; i < stretch.u.size(); ++i) {
    if (i % 1024 == 0) progress.at(0.5, "chords");
    stretch.bound.push_back(chord_bound(curve, stretch.u[i - 1], stretch.u[i], tolerance));
    stretch.worst = std::max(stretch.worst, stretch.bound.back());
  }
}

// Error grows with the square of a chord's length: equal steps of its root even it out, and as many
// chords are needed as the sum of the roots holds roots of the tolerance.
std::vector<double> evened(const Stretch& stretch, double tolerance, int limit) {
  std::vector<double> measure{0};
  for (const double e : stretch.bound) measure.push_back(measure.back() + std::sqrt(e));
  const double needed = std::ceil(measure.back() / std::sqrt(tolerance) - 1e-9);
  const int count = static_cast<int>(std::min<double>(needed, limit + 1.0));
  return equal_steps(stretch.u, measure, std::max(count, static_cast<int>(stretch.bound.size())));
}

// The longest chord from a that keeps the tolerance, within a few percent of its error.
double longest_chord(const ClosedCurve& curve, double a, double end, double guess,
                     double tolerance) {
  double kept = 0;
  double step = std::min(guess, end - a);
  double refused = 2 * (end - a);
  for (int i = 0; i < 40; ++i) {
    const double e = chord_bound(curve, a, a + step, tolerance);
    if (e <= tolerance) {
      kept = step;
      if (e >= 0.97 * tolerance || step >= end - a || refused - kept < 0.01 * kept) break;
    } else {
      refused = step;
      if (kept > 0 && refused - kept < 0.01 * kept) break;
    }
    const double ratio = e > 0 ? std::sqrt(tolerance / e) : 4;
    // Before a bend narrower than the chord the error hardly falls with the length.
    const double most = kept == 0 && i >= 3 ? 0.25 : 4.0;
    double next = step * std::clamp(0.99 * ratio, 0.2, most);
    if (!(next > kept && next < refused)) next = 0.5 * (kept + std::min(refused, end - a));
    step = std::min(next, end - a);
  }
  return kept;
}

// Chords one after the other, each as long as it may be: the fewest where the curvature is too
// uneven for equal steps.
Stretch marched(const ClosedCurve& curve, double from, double to, double tolerance, int limit,
                double guess, const Progress& progress) {
  Stretch stretch{.u = {from}, .bound = {}};
  while (stretch.u.back() < to && stretch.u.size() <= static_cast<std::size_t>(limit)) {
    progress.at(0.5, "chords");
    const double a = stretch.u.back();
    const double step = longest_chord(curve, a, to, guess, tolerance);
    if (!(step > 0)) break;
    const double b = to - (a + step) < 1e-12 ? to : a + step;
    stretch.u.push_back(b);
    stretch.bound.push_back(chord_bound(curve, a, b, tolerance));
    stretch.worst = std::max(stretch.worst, stretch.bound.back());
    guess = step;
  }
  return stretch;
}

Stretch cut(const ClosedCurve& curve, std::span<const double> at, std::span<const double> integral,
            double tolerance, int least, int limit, const Progress& progress) {
  const double steps = (integral.back() - integral.front()) / std::sqrt(8 * tolerance);
  const int count = std::max(least, static_cast<int>(std::ceil(steps - 1e-9)));
  Stretch stretch{.u = equal_steps(at, integral, count), .bound = {}};
  bound(curve, tolerance, stretch, progress);
  for (int round = 0; round < even_rounds && stretch.worst > tolerance; ++round) {
    stretch.u = evened(stretch, tolerance, limit);
    bound(curve, tolerance, stretch, progress);
  }
  const auto keeps = [&](const Stretch& s) {
    return s.worst <= tolerance && s.u.size() <= static_cast<std::size_t>(limit) + 1 &&
           s.u.back() == at.back();
  };
  if (keeps(stretch) && static_cast<int>(stretch.bound.size()) <= count + 1) return stretch;
  const double guess = (at.back() - at.front()) / count;
  Stretch march = marched(curve, at.front(), at.back(), tolerance, limit, guess, progress);
  const bool is_march = keeps(march) && static_cast<int>(march.bound.size()) >= least;
  if (is_march && (!keeps(stretch) || march.bound.size() < stretch.bound.size())) return march;
  if (keeps(stretch)) return stretch;
  throw Error(ErrorCode::ToleranceTooSmall,
              "tolerance " + text(tolerance, "mm") + " needs more than the limit of " +
                  std::to_string(limit) + " points",
              {.field = "/tolerance",
               .value = text(tolerance),
               .limit = std::to_string(limit) + " points"});
}

}  // namespace

Chords equal_error_chords(const ClosedCurve& curve, const std::vector<double>& breaks,
                          double tolerance, int limit, const Progress& progress) {
  const CurvatureTable table = curvature_table(curve, progress.part(0, 0.5));
  const double needed = std::ceil(table.integral.back() / std::sqrt(8 * tolerance) - 1e-9);
  if (!(needed <= limit)) {
    throw Error(ErrorCode::ToleranceTooSmall,
                "tolerance " + text(tolerance, "mm") + " needs " + text(needed) +
                    " points, the limit is " + std::to_string(limit),
                {.field = "/tolerance",
                 .value = text(tolerance),
                 .limit = std::to_string(limit) + " points"});
  }
  Chords chords{.u = {}, .optimal = std::max(3, static_cast<int>(needed)), .chord_error = 0};
  const int least = breaks.size() == 2 ? 3 : 1;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const auto index = [&](double u) {
      return static_cast<std::size_t>(std::ranges::lower_bound(table.u, u) - table.u.begin());
    };
    const std::size_t first = index(breaks[i - 1]);
    const std::size_t length = index(breaks[i]) - first + 1;
    const Stretch stretch = cut(curve, std::span(table.u).subspan(first, length),
                                std::span(table.integral).subspan(first, length),
                                tolerance - curve.error, least, limit, progress);
    chords.u.insert(chords.u.end(), stretch.u.begin(), stretch.u.end() - 1);
    chords.chord_error = std::max(chords.chord_error, stretch.worst + curve.error);
  }
  return chords;
}

double chord_error(const ClosedCurve& curve, const std::vector<double>& u,
                   const Progress& progress) {
  double worst = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    progress.step(i, u.size(), "chords");
    const double b = i + 1 < u.size() ? u[i + 1] : curve.pieces.back().to;
    worst = std::max(worst, chord_bound(curve, u[i], b, worst));
  }
  return worst + curve.error;
}

}  // namespace ridgeline::path
