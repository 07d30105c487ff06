#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/chamfer/cross_hole.hpp"

namespace ridgeline::chamfer {
namespace {

/// Two round holes side by side through the top of a block, `rib` between their walls. At 45
/// degrees a chamfer of width W ends W / sqrt(2) from its edge.
Job two_holes(double rib) {
  Job job = cross_hole();
  job.workpiece.shape = geometry::BodyShape::ManifoldBlock;
  job.workpiece.size = {40, 60, 40};
  job.workpiece.holes[0].position = {0, 0, 0};
  geometry::Hole other = job.workpiece.holes[0];
  other.name = "H2";
  other.profile.R2 = 3;
  other.position = {0, 4 + rib + 3, 0};
  job.workpiece.holes.push_back(other);
  job.edge = geometry::EdgeKind::Outer;
  return job;
}

TEST(Neighbours, ChamferIntoAnotherHoleIsRefusedByItsName) {
  const Job job = two_holes(0.2);
  const double into = job.width / std::numbers::sqrt2 - 0.2;
  try {
    solve(job);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(name(error.code()), name(ErrorCode::WidthTooLarge)) << error.what();
    EXPECT_EQ(error.details().field, "/width");
    EXPECT_NE(std::string(error.what()).find("into hole \"H2\""), std::string::npos);
    ASSERT_TRUE(error.details().target);
    EXPECT_LT((*error.details().target - Eigen::Vector3d(0, 4, 20)).norm(), 0.1);
    EXPECT_NEAR(*error.details().parameter, 0.25, 0.005);
  }
  EXPECT_GT(into, 0.05);
}

TEST(Neighbours, RoomForOneChamferAloneIsWarnedOf) {
  const Job job = two_holes(0.5);
  const Result result = solve(job);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].find("passes hole \"H2\" at 0.2 mm"), std::string::npos)
      << result.warnings[0];
  EXPECT_EQ(measured(job, result).overcut, 0);
  EXPECT_TRUE(solve(two_holes(1)).warnings.empty());
}

// What lies on the other side of the bore is no neighbour.
TEST(Neighbours, OppositeHoleIsFar) {
  Job job = two_holes(0.1);
  job.workpiece.holes[0].walls = 1;
  job.workpiece.holes[1].walls = 1;
  job.workpiece.holes[1].axis = {0, 0, -1};
  EXPECT_TRUE(solve(job).warnings.empty());
}

}  // namespace
}  // namespace ridgeline::chamfer
