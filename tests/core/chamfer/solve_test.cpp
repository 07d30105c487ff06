#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>

#include "core/chamfer/loop.hpp"
#include "tests/core/chamfer/cross_hole.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector3d;
using geometry::EdgeKind;
using geometry::Side;
using path::MoveKind;

struct Way {
  const char* name;
  std::function<void(Job&)> change;
  Vector3d tool_axis;
};
void PrintTo(const Way& way, std::ostream* out) {
  *out << way.name;
}

class SolvedWay : public testing::TestWithParam<Way> {};

// The measuring knows nothing of the solver: it finds the chamfer, all clear, nothing else cut.
TEST_P(SolvedWay, MeasuresCleanAndClear) {
  Job job = cross_hole();
  GetParam().change(job);
  const Result result = solve(job);
  EXPECT_TRUE(result.warnings.empty()) << result.warnings[0];
  EXPECT_LT((result.tool_axis - GetParam().tool_axis).norm(), 1e-12);
  const verify::Report report = measured(job, result);
  // At the tolerance of 0.005 chords lie on the side of the air, arcs on both.
  EXPECT_NEAR(report.width_max, job.width, job.arcs ? 0.015 : 2e-4);
  EXPECT_GT(report.width_min, job.width - 0.015);
  EXPECT_EQ(report.overcut, 0);
  EXPECT_GT(*report.neck_clearance, 0);
  EXPECT_GT(*report.holder_clearance, 0);
  EXPECT_GE(report.rapid_clearance, job.clearance - 1e-6);
  EXPECT_NEAR(report.closing_error, 0, 1e-12);
}

const auto nothing = [](Job&) {};
const auto outer = [](Job& job) { job.edge = EdgeKind::Outer; };
const auto block = [](Job& job) {
  job.workpiece.shape = geometry::BodyShape::ManifoldBlock;
  job.workpiece.size = {40, 60, 40};
};
INSTANTIATE_TEST_SUITE_P(
    Ways, SolvedWay,
    testing::Values(
        Way{"inner_entry", nothing, {0, 0, 1}}, Way{"outer_entry", outer, {0, 0, 1}},
        Way{"inner_exit_across_the_bore", [](Job& job) { job.side = Side::Exit; }, {0, 0, 1}},
        Way{"outer_exit_through_everything",
            [](Job& job) {
              job.edge = EdgeKind::Outer;
              job.side = Side::Exit;
            },
            {0, 0, 1}},
        Way{"inner_round_a_hole_that_breaks_out_of_the_bore",
            [](Job& job) {
              job.workpiece.outer_radius = 40;
              job.workpiece.holes[0].profile.R2 = 6;
              job.workpiece.holes[0].position = {6, 0, 0};
              job.tool.radius = 2;
              job.tool.neck_radius = job.tool.shank_radius = 0.5;
              job.tool.neck_length = 150;
              job.tool.stickout = 160;
              job.clearance = 2;
            },
            {0, 0, 1}},
        Way{"inner_beside_ports_of_one_wall",  // whose ends and walls lie in those of this hole
            [](Job& job) {
              job.workpiece.holes[0].walls = 1;
              job.workpiece.holes[0].position = {0, 0, 0};
              geometry::Hole port = job.workpiece.holes[0];
              port.name = "opposite";
              port.axis = {0, 0, -1};
              job.workpiece.holes.push_back(port);
              port.name = "across";
              port.axis = {1, 0, 0};
              job.workpiece.holes.push_back(port);
            },
            {0, 0, 1}},
        Way{"outer_acute_tip_with_the_centre_in_it",  // the centre lies in the tip that is cut off
            [](Job& job) {
              job.edge = EdgeKind::Outer;
              job.workpiece.inner_radius = 6.547;
              job.workpiece.outer_radius = 8.111;
              job.workpiece.holes[0].profile.R2 = 3.453;
              job.workpiece.holes[0].position = {2.442, 0, 0};
              job.tool.radius = 0.922;
              job.tool.neck_radius = job.tool.shank_radius = 0.3;
              job.width = 0.737;
            },
            {0, 0, 1}},
        Way{"outer_exit_from_its_own_side",
            [](Job& job) {
              job.edge = EdgeKind::Outer;
              job.side = Side::Exit;
              job.tool_axis = Access::Hole;
            },
            {0, 0, -1}},
        Way{"inner_through_the_bore", [](Job& job) { job.tool_axis = Access::Bore; }, {0, 1, 0}},
        Way{"inner_through_the_bore_from_behind",
            [](Job& job) { job.tool_axis = Vector3d(0, -2, 0); },
            {0, -1, 0}},
        Way{"conventional", [](Job& job) { job.direction = Direction::Conventional; }, {0, 0, 1}},
        Way{"three_passes_and_a_spring_pass",
            [](Job& job) {
              job.pass_widths = {0.2, 0.3, job.width};
              job.spring_pass = true;
            },
            {0, 0, 1}},
        Way{"arcs", [](Job& job) { job.arcs = true; }, {0, 0, 1}},
        Way{"arcs_in_a_tilted_plane",
            [](Job& job) {
              job.arcs = true;
              job.tool_axis = Vector3d(0, 0.05, 1);
            },
            Vector3d(0, 0.05, 1).normalized()},
        Way{"arcs_of_the_work_frame_about_a_tilted_tool",
            [](Job& job) {
              job.arcs = true;
              job.arc_frame = ArcFrame::WorkFrame;
              job.tool_axis = Vector3d(0, 0.05, 1);
            },
            Vector3d(0, 0.05, 1).normalized()},
        Way{"slot",
            [](Job& job) {
              job.workpiece.holes[0].profile = {3.5, 6, 0};
              job.start_angle = 1;
            },
            {0, 0, 1}},
        Way{"block_inner", block, {0, 0, 1}},
        Way{"block_outer_from_beside",
            [](Job& job) {
              block(job);
              job.edge = EdgeKind::Outer;
              job.tool_axis = Vector3d(1, 0, 0);
            },
            {1, 0, 0}},
        Way{"block_outer_ball_wider_than_the_hole",
            [](Job& job) {
              block(job);
              job.edge = EdgeKind::Outer;
              job.tool.radius = 4.5;
            },
            {0, 0, 1}},
        Way{"no_overlap_centre_driven",
            [](Job& job) {
              job.overlap = 0;
              job.control_point = ControlPoint::Centre;
              job.end_position = Vector3d(50, 60, 40);
            },
            {0, 0, 1}}));

/// Twice the area that the loop of centres goes round, seen from +Z: > 0 counter-clockwise.
double turn(const Result& result) {
  double area = 0;
  for (std::size_t i = 0; i < result.centres.size(); ++i) {
    const Vector3d& a = result.centres[i];
    const Vector3d& b = result.centres[(i + 1) % result.centres.size()];
    area += (a.x() - 3) * b.y() - (b.x() - 3) * a.y();
  }
  return area;
}

// M3 in a pocket: climb milling goes counter-clockwise, the material at the right hand of the
// travel (shop rule: G41 climbs). The hole edge is a pocket from above for either edge; from below,
// seen from above, and for M4 it is the other way.
TEST(Solve, ClimbKeepsTheMaterialAtTheRightHand) {
  Job job = cross_hole();
  EXPECT_GT(turn(solve(job)), 0);
  job.edge = EdgeKind::Outer;
  EXPECT_GT(turn(solve(job)), 0);
  job.direction = Direction::Conventional;
  EXPECT_LT(turn(solve(job)), 0);
  job.tool.spindle = tool::SpindleSense::CounterClockwise;
  EXPECT_GT(turn(solve(job)), 0);
  job.side = Side::Exit;
  job.tool_axis = Vector3d(0, 0, -1);
  EXPECT_LT(turn(solve(job)), 0);
}

TEST(Solve, LoopBeginsAtTheStartAngleAndOverlapEndsPastIt) {
  Job job = cross_hole();
  job.start_angle = 1.2;
  job.overlap = 0.3;
  job.control_point = ControlPoint::Centre;
  const Result result = solve(job);
  EXPECT_NEAR(result.parameter[0], 1.2 / (2 * std::numbers::pi), 1e-12);
  const Vector3d target = result.targets[0] - Vector3d(3, 0, 0);
  EXPECT_NEAR(std::atan2(target.y(), target.x()), 1.2, 1e-12);
  Vector3d last = Vector3d::Zero();
  int cuts = 0;
  for (const path::Move& move : result.motion.moves) {
    if (move.kind != MoveKind::Cut) continue;
    last = move.to;
    ++cuts;
  }
  const geometry::Edge edge =
      geometry::edge_of(job.workpiece, job.workpiece.holes[0], job.edge, job.side);
  const SectionPoint end =
      swept_at(edge, {.W = job.width, .D = 2.9, .section_angle = {}}, 1.5 / (2 * std::numbers::pi));
  EXPECT_LT((last - geometry::to_outer(edge.frame, end.C)).norm(), 1e-9);
  EXPECT_GT(cuts, static_cast<int>(result.centres.size()));
}

TEST(Solve, ContactFeedMovesTheChamferAtTheFeed) {
  Job job = cross_hole();
  job.overlap = 0;
  const Result result = solve(job);
  Vector3d from = result.motion.start;
  std::size_t i = 0;
  for (const path::Move& move : result.motion.moves) {
    if (move.kind == MoveKind::Cut) {
      const std::size_t next = (i + 1) % result.centres.size();
      const Vector3d contact =
          (result.G1[next] + result.G2[next] - result.G1[i] - result.G2[i]) / 2;
      EXPECT_NEAR(contact.norm() / ((move.to - from).norm() / move.feed), job.feed, 1e-9);
      ++i;
    }
    from = move.to;
  }
  EXPECT_EQ(i, result.centres.size());
}

TEST(Solve, FirstRadialMoveHasItsOwnFeed) {
  Job job = cross_hole();
  job.lead_in_feed = 0.7;
  for (const path::Move& move : solve(job).motion.moves) {
    if (move.kind == MoveKind::Cut) continue;  // scaled
    EXPECT_EQ(move.feed, move.kind == MoveKind::LeadIn  ? 0.7
                         : move.kind == MoveKind::Rapid ? 0
                                                        : job.feed);
  }
}

TEST(Solve, TipIsARadiusBelowTheCentreAlongTheToolAxis) {
  Job job = cross_hole();
  job.tool_axis = Access::Bore;
  const Result tip = solve(job);
  job.control_point = ControlPoint::Centre;
  const Result centre = solve(job);
  ASSERT_EQ(tip.motion.moves.size(), centre.motion.moves.size());
  for (std::size_t i = 0; i < tip.motion.moves.size(); ++i) {
    EXPECT_LT((centre.motion.moves[i].to - tip.motion.moves[i].to - Vector3d(0, 2.9, 0)).norm(),
              1e-12);
  }
}

TEST(Solve, EndPositionIsReachedFromAbove) {
  Job job = cross_hole();
  job.end_position = Vector3d(40, 50, 3);
  const Result result = solve(job);
  const auto& moves = result.motion.moves;
  EXPECT_LT((moves.back().to - Vector3d(40, 50, 3)).norm(), 1e-12);
  const Vector3d above = moves[moves.size() - 2].to;
  EXPECT_LT((above.head<2>() - Eigen::Vector2d(40, 50)).norm(), 1e-12);
  EXPECT_GE(above.z(), 16 + job.clearance);
}

struct Refused {
  const char* name;
  std::function<void(Job&)> spoil;
  ErrorCode code;
  const char* field;
};
void PrintTo(const Refused& refused, std::ostream* out) {
  *out << refused.name;
}

class SolveRefuses : public testing::TestWithParam<Refused> {};

TEST_P(SolveRefuses, WithCodeAndField) {
  Job job = cross_hole();
  GetParam().spoil(job);
  try {
    solve(job);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(name(error.code()), name(GetParam().code)) << error.what();
    EXPECT_EQ(error.details().field, GetParam().field);
  }
}

const double nan = std::nan("");
INSTANTIATE_TEST_SUITE_P(
    Jobs, SolveRefuses,
    testing::Values(
        Refused{"nan_width", [](Job& j) { j.width = nan; }, ErrorCode::BadInput, "/width"},
        Refused{"no_width", [](Job& j) { j.width = 0; }, ErrorCode::BadInput, "/width"},
        Refused{"nan_tolerance", [](Job& j) { j.tolerance = nan; }, ErrorCode::BadInput,
                "/tolerance"},
        Refused{"no_tolerance", [](Job& j) { j.tolerance = 0; }, ErrorCode::BadInput, "/tolerance"},
        Refused{"infinite_feed", [](Job& j) { j.feed = INFINITY; }, ErrorCode::BadInput, "/feed"},
        Refused{"worn_away", [](Job& j) { j.tool.wear = -2.9; }, ErrorCode::BadInput,
                "/tool/radius"},
        Refused{"holder_nowhere", [](Job& j) { j.tool.stickout.reset(); }, ErrorCode::BadInput,
                "/tool/stickout"},
        Refused{"no_axis", [](Job& j) { j.tool_axis = Vector3d(0, 0, 0); }, ErrorCode::BadInput,
                "/tool_axis"},
        Refused{"nan_axis", [](Job& j) { j.tool_axis = Vector3d(nan, 0, 1); }, ErrorCode::BadInput,
                "/tool_axis"},
        Refused{"falling_passes",
                [](Job& j) {
                  j.pass_widths = {0.4, 0.3};
                },
                ErrorCode::BadInput, "/passes"},
        Refused{"passes_end_elsewhere",
                [](Job& j) {
                  j.pass_widths = {0.2, 0.3};
                },
                ErrorCode::BadInput, "/passes"},
        Refused{"nan_start", [](Job& j) { j.start_angle = nan; }, ErrorCode::BadInput,
                "/start_angle"},
        Refused{"no_clearance", [](Job& j) { j.clearance = 0; }, ErrorCode::BadInput, "/clearance"},
        Refused{"nan_end", [](Job& j) { j.end_position = Vector3d(0, nan, 0); },
                ErrorCode::BadInput, "/end_position"},
        Refused{"no_such_hole", [](Job& j) { j.hole = "H7"; }, ErrorCode::UnknownHole, "/hole"},
        Refused{"ball_wider_than_the_hole",
                [](Job& j) {
                  j.tool.radius = 4.01;
                  j.workpiece.inner_radius = 30;
                  j.workpiece.outer_radius = 40;
                  j.workpiece.holes[0].position = {0, 0, 0};
                },
                ErrorCode::ToolTooLarge, "/tool"}));

}  // namespace
}  // namespace ridgeline::chamfer
