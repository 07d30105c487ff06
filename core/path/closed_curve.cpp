#include "core/path/closed_curve.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace ridgeline::path {
namespace {

using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Coefficients = std::array<Vector3d, 6>;

constexpr int hull_parts = 16;  // of a chord: the hull is then under 0.5 % wider than the curve
constexpr int table_parts = 8;  // of a piece, in curvature_table
constexpr double least_piece = 0x1p-40;

// Interpolation nodes on [0, 1]: Chebyshev-Lobatto, so that neighbours share their ends.
std::array<double, 6> nodes() {
  std::array<double, 6> t;
  for (std::size_t k = 0; k < 6; ++k) {
    t[k] = 0.5 * (1 - std::cos(std::numbers::pi * static_cast<double>(k) / 5));
  }
  t[5] = 1;
  return t;
}

// Bernstein coefficients from values at the nodes.
Matrix6 interpolation() {
  constexpr std::array<double, 6> binomial{1, 5, 10, 10, 5, 1};
  const auto t = nodes();
  Matrix6 values;
  for (int k = 0; k < 6; ++k) {
    for (int i = 0; i < 6; ++i) {
      const double x = t[static_cast<std::size_t>(k)];
      values(k, i) =
          binomial[static_cast<std::size_t>(i)] * std::pow(x, i) * std::pow(1 - x, 5 - i);
    }
  }
  return values.inverse();
}

template <std::size_t n>
Vector3d de_casteljau(std::array<Vector3d, n> b, double t) {
  for (std::size_t level = n - 1; level > 0; --level) {
    for (std::size_t i = 0; i < level; ++i) b[i] += t * (b[i + 1] - b[i]);
  }
  return b[0];
}

// Coefficients over [s, t] of [0, 1].
template <std::size_t n>
std::array<Vector3d, n> restricted(std::array<Vector3d, n> b, double s, double t) {
  if (s > 0) {  // keep the right part
    for (std::size_t level = 1; level < n; ++level) {
      for (std::size_t i = 0; i + level < n; ++i) b[i] += s * (b[i + 1] - b[i]);
    }
  }
  const double r = s < 1 ? (t - s) / (1 - s) : 1;
  if (r < 1) {  // keep the left part
    for (std::size_t level = 1; level < n; ++level) {
      for (std::size_t i = n - 1; i >= level; --i) b[i] = b[i - 1] + r * (b[i] - b[i - 1]);
    }
  }
  return b;
}

// Coefficients of the derivative by u, degree n - 2.
template <std::size_t n>
std::array<Vector3d, n - 1> derivative(const std::array<Vector3d, n>& b, double length) {
  std::array<Vector3d, n - 1> d;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    d[i] = static_cast<double>(n - 1) / length * (b[i + 1] - b[i]);
  }
  return d;
}

struct Fit {
  CurvePiece piece;
  double error;
};

Fit fit(const std::function<Vector3d(double)>& curve, double from, double to) {
  static const auto t = nodes();
  static const Matrix6 inverse = interpolation();
  Coefficients values;
  for (std::size_t k = 0; k < 6; ++k) values[k] = curve(from + t[k] * (to - from));
  Fit out{.piece = {.from = from, .to = to, .b = {}}, .error = 0};
  for (Eigen::Index i = 0; i < 6; ++i) {
    Vector3d b = Vector3d::Zero();
    for (Eigen::Index k = 0; k < 6; ++k) b += inverse(i, k) * values[static_cast<std::size_t>(k)];
    out.piece.b[static_cast<std::size_t>(i)] = b;
  }
  for (std::size_t k = 0; k < 5; ++k) {
    const double x = 0.5 * (t[k] + t[k + 1]);
    const Vector3d off = curve(from + x * (to - from)) - de_casteljau(out.piece.b, x);
    out.error = std::max(out.error, 2 * off.norm());
  }
  return out;
}

std::size_t piece_at(const ClosedCurve& curve, double u) {
  const auto after = std::ranges::upper_bound(curve.pieces, u, {}, &CurvePiece::from);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, after - curve.pieces.begin() - 1));
}

double local(const CurvePiece& piece, double u) {
  return std::clamp((u - piece.from) / (piece.to - piece.from), 0.0, 1.0);
}

double distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& d) {
  const double length2 = d.squaredNorm();
  const double s = length2 > 0 ? std::clamp((p - a).dot(d) / length2, 0.0, 1.0) : 0;
  return (p - a - s * d).norm();
}

// The part of a piece within a chord.
struct Part {
  const CurvePiece* piece;
  double s, t;
};

template <class F>
void for_parts(const ClosedCurve& curve, double a, double b, const F& f) {
  for (std::size_t i = piece_at(curve, a); i < curve.pieces.size(); ++i) {
    const CurvePiece& piece = curve.pieces[i];
    if (piece.from >= b) return;
    const Part part{.piece = &piece, .s = local(piece, a), .t = local(piece, b)};
    if (part.t > part.s) f(part);
  }
}

// Let g be the part of curve - chord across the chord: g vanishes at both ends, so that over length
// L in u
//   |g| <= L^2/8 max |g''| + L/4 sum |jumps of g'|,
// the jumps where pieces meet. max |g''| by the coefficients of the second derivative.
double bound_by_curvature(const ClosedCurve& curve, double a, double b, const Vector3d& direction) {
  const auto across = [&](const Vector3d& v) { return (v - v.dot(direction) * direction).norm(); };
  double second = 0;
  double jumps = 0;
  Vector3d slope = Vector3d::Zero();
  bool first = true;
  for_parts(curve, a, b, [&](const Part& part) {
    const double length = part.piece->to - part.piece->from;
    const auto velocity = derivative(part.piece->b, length);
    for (const Vector3d& c : restricted(derivative(velocity, length), part.s, part.t)) {
      second = std::max(second, across(c));
    }
    if (!first) jumps += across(velocity.front() - slope);
    first = false;
    slope = velocity.back();
  });
  const double L = b - a;
  return L * L / 8 * second + L / 4 * jumps;
}

// By the convex hulls of parts of the curve.
double bound_by_hull(const ClosedCurve& curve, double a, double b, const Vector3d& from,
                     const Vector3d& chord) {
  double bound = 0;
  for_parts(curve, a, b, [&](const Part& part) {
    const double share = (part.t - part.s) * (part.piece->to - part.piece->from) / (b - a);
    const int n = std::max(1, static_cast<int>(std::ceil(hull_parts * share)));
    for (int i = 0; i < n; ++i) {
      const double s = part.s + (part.t - part.s) * i / n;
      const double t = part.s + (part.t - part.s) * (i + 1) / n;
      for (const Vector3d& p : restricted(part.piece->b, s, t)) {
        bound = std::max(bound, distance_to_segment(p, from, chord));
      }
    }
  });
  return bound;
}

}  // namespace

ClosedCurve model(const std::function<Vector3d(double)>& curve, const std::vector<double>& breaks,
                  double tolerance, const Progress& progress) {
  constexpr double first_piece = 1.0 / 16;
  ClosedCurve out;
  std::vector<std::pair<double, double>> open;  // the next interval at the back
  for (std::size_t i = breaks.size() - 1; i > 0; --i) {
    const double length = breaks[i] - breaks[i - 1];
    const int parts = std::max(1, static_cast<int>(std::ceil(length / first_piece)));
    for (int k = parts; k > 0; --k) {
      open.emplace_back(breaks[i - 1] + length * (k - 1) / parts,
                        k == parts ? breaks[i] : breaks[i - 1] + length * k / parts);
    }
  }
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    progress.at(from - breaks.front(), "curve");
    const Fit candidate = fit(curve, from, to);
    if (candidate.error <= tolerance) {
      out.error = std::max(out.error, candidate.error);
      out.pieces.push_back(candidate.piece);
      continue;
    }
    if (to - from < least_piece) {
      throw Error(ErrorCode::NotConverged, "the tool path is not continuous at u = " +
                                               std::to_string(from - std::floor(from)));
    }
    const double middle = from + (to - from) / 2;
    open.emplace_back(middle, to);
    open.emplace_back(from, middle);
  }
  return out;
}

Vector3d point_at(const ClosedCurve& curve, double u) {
  const CurvePiece& piece = curve.pieces[piece_at(curve, u)];
  return de_casteljau(piece.b, local(piece, u));
}

double chord_bound(const ClosedCurve& curve, double a, double b, double enough) {
  const Vector3d from = point_at(curve, a);
  const Vector3d chord = point_at(curve, b) - from;
  const double length = chord.norm();
  if (length > 0) {
    const double bound = bound_by_curvature(curve, a, b, chord / length);
    if (bound <= enough) return bound;
    return std::min(bound, bound_by_hull(curve, a, b, from, chord));
  }
  return bound_by_hull(curve, a, b, from, chord);
}

// sqrt(kappa) ds = sqrt(|C' x C''| / |C'|) du, by the midpoint rule on parts of each piece.
CurvatureTable curvature_table(const ClosedCurve& curve, const Progress& progress) {
  CurvatureTable table{.u = {curve.pieces.front().from}, .integral = {0}};
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    progress.step(i, curve.pieces.size(), "curvature");
    const CurvePiece& piece = curve.pieces[i];
    const double length = piece.to - piece.from;
    const auto velocity = derivative(piece.b, length);
    const auto acceleration = derivative(velocity, length);
    for (int k = 0; k < table_parts; ++k) {
      const double t = (k + 0.5) / table_parts;
      const Vector3d v = de_casteljau(velocity, t);
      const double speed = v.norm();
      const double across = v.cross(de_casteljau(acceleration, t)).norm();
      const double rate = speed > 0 ? std::sqrt(across / speed) : 0;
      table.u.push_back(k + 1 == table_parts ? piece.to
                                             : piece.from + length * (k + 1) / table_parts);
      table.integral.push_back(table.integral.back() + rate * length / table_parts);
    }
  }
  return table;
}

}  // namespace ridgeline::path
