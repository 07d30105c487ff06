#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ridgeline::part {

/// Gauss-Legendre, 8 points on [-1, 1].
inline constexpr double nodes[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                    0.9602898564975363};
inline constexpr double weights[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                      0.1012285362903763};

inline constexpr double few_nodes[2] = {0.3399810435848563, 0.8611363115940526};
inline constexpr double few_weights[2] = {0.6521451548625461, 0.3478548451374538};

/// f(t, weight) at the Gauss points of [a, b]: 8, or 4 where a curve has many spans.
template <class F>
void at_gauss_points(double a, double b, const F& f, std::size_t spans = 1) {
  const double middle = (a + b) / 2;
  const double half = (b - a) / 2;
  if (spans > 6) {
    for (int i = 0; i < 2; ++i) {
      f(middle - half * few_nodes[i], half * few_weights[i]);
      f(middle + half * few_nodes[i], half * few_weights[i]);
    }
    return;
  }
  for (int i = 0; i < 4; ++i) {
    f(middle - half * nodes[i], half * weights[i]);
    f(middle + half * nodes[i], half * weights[i]);
  }
}

/// Spans of a curve on which 8 points are enough: between knots, arcs of a quarter circle.
template <class Knots>
std::vector<double> spans(double first, double last, const Knots* knots, double longest) {
  std::vector<double> limits{first};
  if (knots != nullptr) {
    for (const double knot : *knots)
      if (knot > first + 1e-12 && knot < last - 1e-12) limits.push_back(knot);
  }
  limits.push_back(last);
  std::vector<double> fine{first};
  for (std::size_t i = 0; i + 1 < limits.size(); ++i) {
    const double width = limits[i + 1] - limits[i];
    const int n = std::max(1, static_cast<int>(std::ceil(width / longest - 1e-9)));
    for (int k = 1; k <= n; ++k) fine.push_back(limits[i] + width * k / n);
  }
  return fine;
}

/// The weights of the poles of a rational curve.
struct Weights {
  double least = HUGE_VAL;
  double greatest = 0;

  void add(double weight) {
    least = std::min(least, weight);
    greatest = std::max(greatest, weight);
  }
  double ratio() const { return least / greatest; }
};

/// Polynomials of a higher degree, and arcs of up to half a turn, which are none, need two halves
/// of a span: 8 points leave 1e-6 of a volume under them. Many spans are short ones. Weights of
/// 1 : q keep the roots of a denominator of degree n away from the span [0, 1], beyond the ellipse
/// (|t| + |1 - t|)^n = (1 + q) / (1 - q), and 16 powers of its size are the error: 6e-9 for a
/// quarter of a turn, q = cos 45 degrees, and n = 3.
inline bool needs_halves(double weight_ratio, int degree, std::size_t limits) {
  constexpr double quarter_turn = 0.7;
  const bool is_rational = weight_ratio < 1 - 1e-12;
  return limits <= 7 &&
         (degree > 4 || (is_rational && (degree > 3 || weight_ratio < quarter_turn)));
}
inline std::vector<double> halved(const std::vector<double>& limits) {
  std::vector<double> found{limits.front()};
  for (std::size_t i = 1; i < limits.size(); ++i) {
    found.push_back((limits[i - 1] + limits[i]) / 2);
    found.push_back(limits[i]);
  }
  return found;
}

}  // namespace ridgeline::part
