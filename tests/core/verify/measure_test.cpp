#include "core/verify/measure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>

#include "core/base/error.hpp"
#include "tests/core/verify/countersink.hpp"

namespace ridgeline::verify {
namespace {

using path::MoveKind;

TEST(Measure, LengthAndTimeCountEachMove) {
  const Countersink c;
  path::Motion motion = circle(c);  // 20 down, a circle of radius 3, 20 up
  motion.moves[1].feed = 2;
  motion.moves[2].kind = MoveKind::Rapid;
  const Report report = measure(subject_of(c), motion);
  EXPECT_NEAR(report.path_length, 40 + 6 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(report.cutting_time, 20 / 5.0 + 6 * std::numbers::pi / 2, 1e-12);
}

// A loop of 100 chords whose last vertex misses the first by (0.003, 0.004), square to it.
TEST(Measure, ClosingErrorIsTheStepAtTheSeam) {
  const Countersink c;
  path::Motion motion = polygon(c, 100);
  EXPECT_EQ(measure(subject_of(c), motion).closing_error, 0);
  motion.moves[100].to += Eigen::Vector3d(0.003, 0, 0.004);
  EXPECT_NEAR(measure(subject_of(c), motion).closing_error, 0.005, 1e-5);
}

TEST(Measure, OverlapRetracesTheSeam) {
  const Countersink c;
  path::Motion motion = polygon(c, 100);
  const path::Move away = motion.moves.back();
  motion.moves.back() = motion.moves[1];
  motion.moves.push_back(away);
  EXPECT_NEAR(measure(subject_of(c), motion).closing_error, 0, 1e-15);
}

TEST(Measure, TheTipIsARadiusBelowTheCentre) {
  const Countersink c;
  path::Motion motion = polygon(c, 200);
  Subject subject = subject_of(c);
  const Report at_centre = measure(subject, motion);
  motion.start.z() -= c.D;
  for (path::Move& move : motion.moves) move.to.z() -= c.D;
  subject.control_to_centre = c.D;
  const Report at_tip = measure(subject, motion);
  EXPECT_NEAR(at_tip.width_min, at_centre.width_min, 1e-12);
  EXPECT_NEAR(at_tip.width_max, at_centre.width_max, 1e-12);
}

TEST(Measure, PartsThatAreNotDescribedAreNotChecked) {
  const Countersink c;
  const Report report = measure(subject_of(c), polygon(c, 50));
  EXPECT_FALSE(report.neck_clearance);
  EXPECT_FALSE(report.holder_clearance);
  EXPECT_TRUE(std::isinf(report.rapid_clearance));
}

// 100,000 chords: seconds at most. The polygon's own error is 3 (pi / 100000)^2 / 2.
TEST(Measure, AHundredThousandMovesMeasureAlike) {
  const Countersink c;
  const Report report = measure(subject_of(c), polygon(c, 100'000));
  EXPECT_NEAR(report.width_min, width_of(c), 1e-8);
  EXPECT_NEAR(report.width_max, width_of(c), 1e-8);
  EXPECT_EQ(report.overcut, 0);
}

struct Refused {
  const char* name;
  std::function<void(Subject&, path::Motion&)> spoil;
};
void PrintTo(const Refused& refused, std::ostream* out) {
  *out << refused.name;
}

class MeasureRefuses : public testing::TestWithParam<Refused> {};

TEST_P(MeasureRefuses, BadInput) {
  const Countersink c;
  Subject subject = subject_of(c);
  path::Motion motion = polygon(c, 20);
  GetParam().spoil(subject, motion);
  try {
    measure(subject, motion);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadInput);
  }
}

const double nan = std::nan("");
INSTANTIATE_TEST_SUITE_P(
    Inputs, MeasureRefuses,
    testing::Values(Refused{"nan_target",
                            [](Subject&, path::Motion& m) { m.moves[3].to.x() = nan; }},
                    Refused{"nan_start", [](Subject&, path::Motion& m) { m.start.z() = nan; }},
                    Refused{"nan_feed", [](Subject&, path::Motion& m) { m.moves[3].feed = nan; }},
                    Refused{"no_feed", [](Subject&, path::Motion& m) { m.moves[3].feed = 0; }},
                    Refused{"no_radius", [](Subject& s, path::Motion&) { s.tool.radius = 0; }},
                    Refused{"no_width", [](Subject& s, path::Motion&) { s.width = nan; }},
                    Refused{"no_moves", [](Subject&, path::Motion& m) { m.moves.clear(); }},
                    Refused{"far_from_the_edge", [](Subject&, path::Motion& m) {
                              for (path::Move& move : m.moves) move.to.z() += 30;
                            }}));

}  // namespace
}  // namespace ridgeline::verify
