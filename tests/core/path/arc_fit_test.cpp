#include "core/path/arc_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "core/base/error.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::path {
namespace {

using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;
using Curve = std::function<Vector3d(double)>;

/// n chords of a curve over [0, 1], and the largest distance of curve to chord, found by sampling.
struct Sampled {
  std::vector<Vector3d> points;
  double error = 0;
};

double distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

Sampled sample(const Curve& curve, int n) {
  Sampled sampled;
  for (int k = 0; k <= n; ++k) sampled.points.push_back(curve(k / double(n)));
  for (int k = 0; k < n; ++k) {
    for (const double t : {0.25, 0.5, 0.75}) {
      const Vector3d p = curve((k + t) / n);
      const auto at = static_cast<std::size_t>(k);
      sampled.error = std::max(sampled.error,
                               distance_to_segment(p, sampled.points[at], sampled.points[at + 1]));
    }
  }
  sampled.error *= 1.1;  // smooth curves: the samples are near the worst place
  return sampled;
}

/// Largest distance between two fine polylines, from either to the other, by brute force near the
/// same share of the way.
double hausdorff(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  const auto one_way = [](const std::vector<Vector3d>& from, const std::vector<Vector3d>& to) {
    double worst = 0;
    for (const Vector3d& p : from) {
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t n = 1; n < to.size(); ++n) {
        best = std::min(best, distance_to_segment(p, to[n - 1], to[n]));
      }
      worst = std::max(worst, best);
    }
    return worst;
  };
  return std::max(one_way(a, b), one_way(b, a));
}

std::vector<Vector3d> points_of(const ArcFit& fit, const Vector3d& start) {
  std::vector<Vector3d> points{start};
  Vector3d from = start;
  for (const Move& move : fit.moves) {
    for (const Vector3d& p : sampled(from, move, 1e-5)) points.push_back(p);
    from = move.to;
  }
  return points;
}

/// A saddle: circle of radius rho with two hills.
Curve saddle(double rho, double A) {
  return [=](double u) {
    const double phi = 2 * pi * u;
    return Vector3d(rho * std::cos(phi), rho * std::sin(phi), A * std::cos(2 * phi));
  };
}

struct CurveCase {
  std::string name;
  Curve curve;
  double tolerance;
};
void PrintTo(const CurveCase& sample, std::ostream* out) {
  *out << sample.name;
}

const std::vector<CurveCase> curve_cases = {
    {"Saddle", saddle(5, 0.05), 0.002},
    {"SteepSaddle", saddle(3, 1), 0.01},
    {"Clockwise", [](double u) { return saddle(4, 0.1)(-u); }, 0.005},
    {"Ellipse",
     [](double u) {
       return Vector3d(6 * std::cos(2 * pi * u), 3 * std::sin(2 * pi * u), std::sin(2 * pi * u));
     },
     0.003},
    {"Line", [](double u) { return Vector3d(10 * u, 3 * u, -u); }, 0.001},
    {"Wave", [](double u) { return Vector3d(20 * u, std::sin(9 * u), 0.2 * std::cos(5 * u)); },
     0.002},
    {"LineIntoArc",
     [](double u) {
       if (u < 0.5) return Vector3d(20 * u - 10, 0, 1);
       const double phi = (u - 0.5) * 2 * pi;
       return Vector3d(3 * std::sin(phi), 3 - 3 * std::cos(phi), 1 + 0.2 * std::sin(phi));
     },
     0.002},
};

class FittedCurve : public testing::TestWithParam<CurveCase> {};

TEST_P(FittedCurve, StaysWithinTheCertifiedErrorOfTheCurve) {
  const auto& [name, curve, tolerance] = GetParam();
  const Sampled dense = sample(curve, 3000);
  const ArcFit fit = fit_arcs(dense.points, tolerance, dense.error);
  EXPECT_LE(fit.error, tolerance * (1 + 1e-9));
  EXPECT_EQ(fit.moves.back().to, dense.points.back());
  EXPECT_EQ(fit.index.back() + 1, dense.points.size());
  ASSERT_EQ(fit.index.size(), fit.moves.size());
  const double distance = hausdorff(points_of(fit, curve(0)), sample(curve, 1000).points);
  EXPECT_LE(distance, fit.error + 3e-5);  // what the polylines of this test leave out
  // Joints lie on the curve as seen from above.
  for (std::size_t n = 0; n < fit.moves.size(); ++n) {
    EXPECT_EQ(fit.moves[n].to.head<2>(), dense.points[fit.index[n]].head<2>());
  }
}
INSTANTIATE_TEST_SUITE_P(Path, FittedCurve, testing::ValuesIn(curve_cases),
                         [](const auto& sample) { return sample.param.name; });

// The integrals of the header: arcs sqrt(A / (4 TA)) * integral sqrt |cos 2 phi| = 4.7925 of it,
// lines integral sqrt(kappa / (8 TA)) ds, nearly 2 pi sqrt(rho / (8 TA)).
TEST(FitArcs, NeedsHardlyMoreThanTheLeastCount) {
  const double TA = 0.002;
  for (const auto& [rho, A] : {std::pair(5.0, 0.05), std::pair(3.0, 0.12), std::pair(8.0, 0.02)}) {
    const Sampled dense = sample(saddle(rho, A), 4000);
    const ArcFit fit = fit_arcs(dense.points, TA, dense.error);
    const double least = std::sqrt(A / (4 * TA)) * 4.7925;
    EXPECT_LE(static_cast<double>(fit.moves.size()), 1.08 * least + 3) << rho;
    EXPECT_GE(static_cast<double>(fit.moves.size()), 0.9 * least) << rho;
    const double lines = 2 * pi * std::sqrt(rho / (8 * TA));
    EXPECT_GE(lines / static_cast<double>(fit.moves.size()), 4) << rho;
  }
}

TEST(FitArcs, ACircleIsTwoOrThreeArcs) {
  const Sampled dense = sample(saddle(5, 0), 2000);
  const ArcFit fit = fit_arcs(dense.points, 0.002, dense.error);
  EXPECT_LE(fit.moves.size(), 3U);
  for (const Move& move : fit.moves) {
    ASSERT_TRUE(move.arc);
    EXPECT_LT(move.arc->centre.head<2>().norm(), 0.002);
  }
}

TEST(FitArcs, StraightPartsAreStraightMoves) {
  const Sampled dense = sample([](double u) { return Vector3d(9 * u, -4 * u, u); }, 500);
  const ArcFit fit = fit_arcs(dense.points, 0.001, dense.error);
  ASSERT_EQ(fit.moves.size(), 1U);
  EXPECT_FALSE(fit.moves[0].arc);
}

// Another plane and turned axes give the same arcs, turned.
TEST(FitArcs, FollowsPlaneAndAxes) {
  const Sampled flat = sample(saddle(5, 0.1), 1500);
  const ArcFit expected = fit_arcs(flat.points, 0.002, flat.error);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.8, Vector3d(1, -2, 2) / 3).matrix();
  for (const ArcPlane plane : {ArcPlane::XY, ArcPlane::ZX, ArcPlane::YZ}) {
    const auto [i, j, k] = axes_of(plane);
    const auto turned = [&](const Vector3d& p) {
      return Vector3d(p.x() * R.col(i) + p.y() * R.col(j) + p.z() * R.col(k));
    };
    std::vector<Vector3d> points;
    for (const Vector3d& p : flat.points) points.push_back(turned(p));
    const ArcFit fit = fit_arcs(points, 0.002, flat.error, plane, R);
    ASSERT_EQ(fit.moves.size(), expected.moves.size());
    Vector3d from = points.front(), flat_from = flat.points.front();
    for (std::size_t n = 0; n < fit.moves.size(); ++n) {
      EXPECT_LT((fit.moves[n].to - turned(expected.moves[n].to)).norm(), 1e-4);
      ASSERT_TRUE(fit.moves[n].arc);
      EXPECT_EQ(fit.moves[n].arc->plane, plane);
      EXPECT_NEAR(arc_shape(from, fit.moves[n]).sweep,
                  arc_shape(flat_from, expected.moves[n]).sweep, 1e-4);
      from = fit.moves[n].to;
      flat_from = expected.moves[n].to;
    }
  }
}

TEST(FitArcs, RandomCurvesKeepTheirTolerance) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  std::size_t arcs = 0;
  for (int n = 0; n < 20; ++n) {
    SCOPED_TRACE(n);
    const double rho = 3 + 2 * any(random), f = 0.3 * any(random), A = 0.5 * any(random);
    const double B = 0.3 * any(random), shift = any(random);
    const Curve curve = [=](double u) {
      const double phi = 2 * pi * u;
      const double r = rho * (1 + 0.2 * f * std::cos(3 * phi + shift));
      return Vector3d(r * std::cos(phi), r * std::sin(phi) * (1 + f),
                      A * std::cos(2 * phi) + B * std::sin(phi + shift));
    };
    const double tolerance = std::pow(10, -2.5 + any(random));
    const Sampled dense = sample(curve, 4000);
    if (dense.error > tolerance / 20) continue;
    const ArcFit fit = fit_arcs(dense.points, tolerance, dense.error);
    EXPECT_LE(fit.error, tolerance * (1 + 1e-9));
    const double distance = hausdorff(points_of(fit, curve(0)), sample(curve, 800).points);
    EXPECT_LE(distance, fit.error + 5e-5);
    arcs += fit.moves.size();
  }
  EXPECT_GT(arcs, 300U);
}

TEST(FitArcs, RefusesWhatItCannotCertify) {
  const auto code_of = [](const std::vector<Vector3d>& points, double tolerance, double error) {
    try {
      fit_arcs(points, tolerance, error);
    } catch (const Error& caught) {
      return caught.code();
    }
    return ErrorCode::Internal;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vector3d> two{{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(code_of(two, 0.001, 0.001), ErrorCode::BadInput);
  EXPECT_EQ(code_of(two, nan, 0), ErrorCode::BadInput);
  EXPECT_EQ(code_of(two, 0.001, nan), ErrorCode::BadInput);
  EXPECT_EQ(code_of({{0, 0, 0}}, 0.001, 0), ErrorCode::BadInput);
  EXPECT_EQ(code_of({{0, 0, 0}, {0, 0, 0}}, 0.001, 0), ErrorCode::BadInput);
  EXPECT_EQ(code_of({{0, 0, 0}, {nan, 0, 0}}, 0.001, 0), ErrorCode::BadInput);
  // Straight up: no arc in the plane has that.
  EXPECT_EQ(code_of({{0, 0, 0}, {0, 0, 1}}, 0.001, 0), ErrorCode::NotConverged);
}

}  // namespace
}  // namespace ridgeline::path
