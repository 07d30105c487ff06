#include "tests/core/macro/plain_moves.hpp"

#include <gtest/gtest.h>

namespace ridgeline::macro {
namespace {

using Eigen::Vector3d;

constexpr double no_move = 2e-4;  // [mm]: rs274 prints four decimals

void add(std::vector<Plain>& moves, const Plain& move) {
  const Vector3d at = moves.empty() ? Vector3d(Vector3d::Zero()) : moves.back().to;
  if (move.sense != 0 || (move.to - at).norm() > no_move) moves.push_back(move);
}

}  // namespace

std::vector<Plain> moves_of(const Result& result) {
  std::vector<Plain> moves;
  for (const Move& move : result.motion) {
    if (move.kind == MoveKind::Dwell) continue;
    Plain plain{move.kind == MoveKind::Rapid, 0, ' ', move.to};
    plain.feed = move.feed;
    if (move.kind == MoveKind::Arc) {
      const ArcDetail& arc = arc_of(result, move);
      plain.sense = arc.sense == path::ArcSense::Clockwise ? -1 : 1;
      plain.normal = "ZYX"[static_cast<int>(arc.plane)];
      plain.centre = arc.centre;
    }
    add(moves, plain);
  }
  return moves;
}

std::vector<Plain> moves_of(const nc::CanonRun& run) {
  std::vector<Plain> moves;
  for (const nc::CanonMove& move : run.moves) {
    Plain plain{move.call == "STRAIGHT_TRAVERSE", 0, ' ', move.to};
    plain.feed = move.feed;
    if (move.call == "ARC_FEED") {
      plain.sense = move.turns > 0 ? 1 : -1;
      plain.normal = move.plane;
      plain.centre = move.centre;
    }
    add(moves, plain);
  }
  return moves;
}

void expect_same(const std::vector<Plain>& ours, const std::vector<Plain>& theirs,
                 double tolerance) {
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    SCOPED_TRACE(i);
    ASSERT_EQ(ours[i].is_rapid, theirs[i].is_rapid);
    ASSERT_EQ(ours[i].sense, theirs[i].sense);
    ASSERT_EQ(ours[i].normal, theirs[i].normal);
    ASSERT_NEAR((ours[i].to - theirs[i].to).norm(), 0, tolerance)
        << ours[i].to.transpose() << " / " << theirs[i].to.transpose();
    ASSERT_NEAR(ours[i].feed, theirs[i].feed, 1e-3);
    if (ours[i].sense == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      if ("XYZ"[axis] == ours[i].normal) continue;
      ASSERT_NEAR(ours[i].centre[axis], theirs[i].centre[axis], 2 * tolerance);
    }
  }
}

}  // namespace ridgeline::macro
