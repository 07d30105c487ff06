#include "core/chamfer/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector3d;

// Hole frame: bore or outer wall R1 at x = -f, tilted by beta.
geometry::Edge edge(double R1, double m, double f, double beta, const geometry::Profile& profile) {
  geometry::Edge edge;
  edge.profile = profile;
  edge.body = geometry::Cylinder{
      .point = {-f, 0, 0}, .axis = {0, std::cos(beta), std::sin(beta)}, .radius = R1};
  edge.m = m;
  return edge;
}

Vector3d centre(const geometry::Edge& edge, const Chamfer& chamfer, double u) {
  u -= std::floor(u);
  return chamfer.method == Method::Swept ? swept_at(edge, chamfer, u).C
                                         : section_at(edge, chamfer, u).C;
}

// Brute force: distance of samples between the points to their chord.
double measured_error(const geometry::Edge& edge, const Chamfer& chamfer, const Loop& loop,
                      double sign) {
  double worst = 0;
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const std::size_t j = (i + 1) % loop.points.size();
    double step = sign * (loop.parameter[j] - loop.parameter[i]);
    if (step <= 0) step += 1;
    const Vector3d A = loop.points[i].C;
    const Vector3d d = loop.points[j].C - A;
    for (int k = 1; k < 8; ++k) {
      const Vector3d p = centre(edge, chamfer, loop.parameter[i] + sign * step * k / 8);
      const double s = std::clamp((p - A).dot(d) / d.squaredNorm(), 0.0, 1.0);
      worst = std::max(worst, (p - A - s * d).norm());
    }
  }
  return worst;
}

TEST(Loop, KeepsTheToleranceWithFewPointsOnRandomEdges) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  int checked = 0;
  for (int i = 0; i < 60; ++i) {
    const double R1 = 8 + 30 * unit(random);
    const double half = R1 * (0.2 + 0.4 * unit(random));
    const double across = i % 3 == 2 ? half * unit(random) : 0;
    const double along = i % 3 == 0 ? 0 : 8 * unit(random);
    const double R2 = half - across / 2;
    const double f = (2 * unit(random) - 1) * 0.8 * (R1 - half);
    const double m = i % 2 == 0 ? 1 : -1;
    const geometry::Edge e = edge(R1, m, f, radians(40) * (2 * unit(random) - 1),
                                  {.R2 = R2, .straight_along = along, .straight_across = across});
    const Chamfer chamfer{.W = 0.3,
                          .D = std::max(0.3, 0.3 * R2),
                          .method = i % 4 < 2 ? Method::Swept : Method::Section};
    const Sampling sampling{.tolerance = std::pow(10, -2 - 2 * unit(random)),
                            .points = {},
                            .start_u = unit(random),
                            .reversed = i % 5 == 0};
    SCOPED_TRACE(testing::Message() << "edge " << i << " tolerance=" << sampling.tolerance);
    Loop l;
    try {
      l = loop(e, chamfer, sampling);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::SweptNotReached) << error.what();
      printf("%d %s m=%g along=%g across=%g R2=%g R1=%g f=%g\n", i, error.what(), m, along, across,
             R2, R1, f);
      continue;  // the ball does not fit into the bend of the borders
    }
    EXPECT_LE(l.chord_error, sampling.tolerance);
    const double measured = measured_error(e, chamfer, l, sampling.reversed ? -1 : 1);
    EXPECT_LE(measured, l.chord_error);
    EXPECT_GE(measured, 0.5 * sampling.tolerance);
    const auto joints = static_cast<double>(geometry::joints(e.profile).size());
    EXPECT_LE(static_cast<double>(l.points.size()),
              std::ceil(1.03 * l.points_optimal) + joints + 1);
    EXPECT_NEAR(l.parameter.front(), sampling.start_u, 1e-12);
    ++checked;
  }
  EXPECT_GE(checked, 50);
}

// Points asked for: equal steps of u from the start, in either direction, error of each certified.
// Edges on which the ball goes round bends of the borders: at joints, and where G2 crosses one.
TEST(Loop, GoesRoundTheBendsOfSlots) {
  struct Bend {
    double R1, m, f, beta_deg;
    geometry::Profile profile;
    double W, D;
  };
  const Bend bends[] = {
      {30.313, 1, -19.976, 57.799, {.R2 = 7.695, .straight_along = 7.528}, 0.261, 1.34},
      {33.302, 1, 2.05, 5.4, {.R2 = 26.318, .straight_along = 4.939}, 0.699, 8.501},
      {36.266, 1, 10.937, 23.5, {.R2 = 13.522, .straight_along = 5.252}, 0.121, 4.729},
      {27.412,
       1,
       2.844,
       16.048,
       {.R2 = 8.889, .straight_along = 3.849, .straight_across = 12.603},
       0.3,
       2.6}};
  for (const Bend& bend : bends) {
    SCOPED_TRACE(bend.R1);
    const geometry::Edge slot = edge(bend.R1, bend.m, bend.f, radians(bend.beta_deg), bend.profile);
    const Chamfer chamfer{.W = bend.W, .D = bend.D};
    Sampling sampling;
    sampling.tolerance = 0.001;
    const Loop loop = chamfer::loop(slot, chamfer, sampling);
    EXPECT_LE(loop.chord_error, sampling.tolerance);
    EXPECT_LE(measured_error(slot, chamfer, loop, 1), sampling.tolerance);
    // The curve of centres is one piece at every bend: near it, no step is larger than the way.
    const Section ready = section(slot, chamfer);
    ASSERT_GT(ready.breaks.size(), geometry::joints(bend.profile).size());
    for (const double at : ready.breaks) {
      Vector3d before = centre(slot, chamfer, at - 1e-3);
      for (int i = -99; i <= 100; ++i) {
        const Vector3d here = centre(slot, chamfer, at + i * 1e-5);
        EXPECT_LT((here - before).norm(), 2e-5 * geometry::perimeter(bend.profile) * 2);
        before = here;
      }
    }
  }
}

// A table of section angles bends the borders at its entries.
TEST(Loop, GoesRoundTheBendsOfAnAngleTable) {
  const geometry::Edge round = edge(20, 1, 3, 0.3, {.R2 = 5});
  const Chamfer chamfer{
      .W = 0.4,
      .D = 2,
      .section_angle = AngleTable{.entries = {{0.2, 0.6}, {1.9, 0.9}, {4.1, 0.7}}}};
  Sampling sampling;
  sampling.tolerance = 0.001;
  const Loop loop = chamfer::loop(round, chamfer, sampling);
  EXPECT_LE(loop.chord_error, sampling.tolerance);
  EXPECT_LE(measured_error(round, chamfer, loop, 1), sampling.tolerance);
  EXPECT_EQ(section(round, chamfer).corners.size(), 3u);
}

TEST(Loop, GivesEqualStepsWhenPointsAreAskedFor) {
  const geometry::Edge e = edge(20, 1, 3, 0, {.R2 = 8});
  const Chamfer chamfer{.W = 0.5, .D = 2};
  for (const bool reversed : {false, true}) {
    const Loop l = loop(e, chamfer, {.points = 24, .start_u = 0.25, .reversed = reversed});
    ASSERT_EQ(l.parameter.size(), 24u);
    for (int i = 0; i < 24; ++i) {
      const double u = 0.25 + (reversed ? -1 : 1) * i / 24.0;
      EXPECT_NEAR(l.parameter[static_cast<std::size_t>(i)], u - std::floor(u), 1e-12);
    }
    EXPECT_LE(measured_error(e, chamfer, l, reversed ? -1 : 1), l.chord_error);
  }
}

TEST(Loop, RefusesWhatItCannotSample) {
  const geometry::Edge e = edge(20, 1, 0, 0, {.R2 = 5});
  const Chamfer chamfer{.W = 0.5, .D = 3};
  const auto code = [&](const Sampling& sampling) {
    try {
      loop(e, chamfer, sampling);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::Internal;
  };
  EXPECT_EQ(code({.tolerance = 0, .points = {}}), ErrorCode::BadInput);
  EXPECT_EQ(code({.tolerance = std::nan(""), .points = {}}), ErrorCode::BadInput);
  EXPECT_EQ(code({.points = 2}), ErrorCode::BadInput);
  EXPECT_EQ(code({.tolerance = 1e-6, .points = {}, .limit = 500}), ErrorCode::ToleranceTooSmall);
}

TEST(Loop, StopsWhenCancelled) {
  std::stop_source source;
  source.request_stop();
  const geometry::Edge e = edge(20, 1, 0, 0, {.R2 = 5});
  try {
    loop(e, {.W = 0.5, .D = 3}, {}, {.report = {}, .stop = source.get_token()});
    FAIL() << "finished";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::Cancelled);
  }
}

}  // namespace
}  // namespace ridgeline::chamfer
