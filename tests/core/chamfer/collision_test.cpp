// Brute force against the measured motion: points of the tool at places of the path, held against
// membership in the material straight from its definition.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "core/chamfer/job.hpp"
#include "core/verify/measure.hpp"
#include "tests/support/membership.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector3d;
using geometry::EdgeKind;
using geometry::is_material;
using geometry::Side;

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution(low, high)(random);
}

/// Round holes and slots, oblique to 35 degrees, eccentric to 0.8 of what fits; every edge; tool
/// axes along Z, the hole or the bore; necks from slim to as thick as the ball.
Job any_job(std::mt19937& random) {
  Job job;
  geometry::Workpiece& part = job.workpiece;
  part.inner_radius = uniform(random, 8, 20);
  part.outer_radius = part.inner_radius + uniform(random, 3, 12);
  part.length = uniform(random, 50, 90);
  if (random() % 4 == 0) {
    part.shape = geometry::BodyShape::ManifoldBlock;
    part.size = {2 * part.outer_radius + 4, part.length, 2 * part.outer_radius};
  }
  geometry::Hole hole;
  hole.name = "H1";
  hole.profile.R2 = uniform(random, 2, 0.5 * part.inner_radius);
  if (random() % 3 == 0) hole.profile.straight_along = uniform(random, 1, 6);
  const double room = part.inner_radius - hole.profile.R2;
  hole.position = {0.8 * uniform(random, -room, room), uniform(random, -4, 4), 0};
  const double beta = random() % 2 == 0 ? 0 : uniform(random, -0.6, 0.6);
  hole.axis = {0, std::sin(beta), std::cos(beta)};
  part.holes = {hole};
  job.hole = "H1";
  job.edge = random() % 2 == 0 ? EdgeKind::Inner : EdgeKind::Outer;
  job.side = random() % 2 == 0 ? Side::Entry : Side::Exit;
  job.method = random() % 2 == 0 ? Method::Swept : Method::Section;
  const double D = uniform(random, 0.3, 0.9) * hole.profile.R2;
  job.tool.radius = D;
  job.tool.neck_radius = uniform(random, 0.2, 1) * D;
  job.tool.neck_length = 2 * D + uniform(random, 5, 40);
  job.tool.shank_radius = uniform(random, 0.5, 1.5) * D;
  job.tool.stickout = *job.tool.neck_length + uniform(random, 5, 40);
  job.tool.holder_radius = 10;
  job.width = uniform(random, 0.1, 0.25) * std::min(D, 2.0);
  const int axis = static_cast<int>(random() % 3);
  if (axis == 1) job.tool_axis = Access::Hole;
  if (axis == 2 && job.edge == EdgeKind::Inner) job.tool_axis = Access::Bore;
  return job;
}

/// A point of the neck, shank or holder that is outside of the ball, at random.
struct Tip {
  double height, radius;
  bool is_holder;
};
Tip any_tip(std::mt19937& random, const tool::Tool& tool) {
  const double D = tool.radius;
  while (true) {
    const double height = uniform(random, 0, *tool.stickout - D + 20);
    const bool is_holder = height > *tool.stickout - D;
    const double limit = is_holder                        ? *tool.holder_radius
                         : height < *tool.neck_length - D ? *tool.neck_radius
                                                          : *tool.shank_radius;
    const double radius = limit * std::sqrt(uniform(random, 0, 1));
    if (std::hypot(height, radius) > D) return {height, radius, is_holder};
  }
}

class Sampler {
public:
  Sampler(const Job& job, const Result& result, std::mt19937& random)
      : job_(job), result_(result), random_(random) {}

  /// Ball centre at a random place of a random move, and whether it is a rapid.
  Vector3d any_centre() {
    const std::size_t i = random_() % result_.motion.moves.size();
    const Vector3d from = i == 0 ? result_.motion.start : result_.motion.moves[i - 1].to;
    const Vector3d tip = from + uniform(random_, 0, 1) * (result_.motion.moves[i].to - from);
    return tip + job_.tool.radius * result_.tool_axis;
  }
  Vector3d any_offset(double height, double radius) {
    const Vector3d x = result_.tool_axis.unitOrthogonal();
    const double turn = uniform(random_, 0, 2 * std::numbers::pi);
    return height * result_.tool_axis +
           radius * (std::cos(turn) * x + std::sin(turn) * result_.tool_axis.cross(x));
  }
  /// A point of the ball that is `deep` below its surface.
  Vector3d in_ball(double deep) {
    std::normal_distribution<double> normal;
    const Vector3d v(normal(random_), normal(random_), normal(random_));
    return (job_.tool.radius - deep) * v.normalized();
  }

private:
  const Job& job_;
  const Result& result_;
  std::mt19937& random_;
};

/// Farther from the ridge than any chamfer of the width can reach.
bool is_beside_chamfer(const Job& job, const Result& result, const Vector3d& q) {
  double reach = 0;
  for (std::size_t i = 0; i < result.targets.size(); ++i) {
    reach = std::max({reach, (result.G1[i] - result.targets[i]).norm(),
                      (result.G2[i] - result.targets[i]).norm()});
  }
  for (std::size_t i = 0; i < result.targets.size(); ++i) {
    const Vector3d& next = result.targets[(i + 1) % result.targets.size()];
    const double gap = (next - result.targets[i]).norm();
    if ((q - result.targets[i]).norm() < 2 * reach + job.width + gap) return false;
  }
  return true;
}

TEST(Collision, WhatBruteForceFindsIsMeasuredAndWhatIsRefusedHasAWitness) {
  constexpr double deep = 1e-3;  // mm: shallower gouges are the rounding of sampling
  std::mt19937 random(20240401);
  int solved = 0, neck_hits = 0, holder_hits = 0, neck_refused = 0, clear = 0;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE(i);
    const Job job = any_job(random);
    Result result;
    verify::Subject subject;
    try {
      subject.edge = geometry::edge_of(job.workpiece, job.workpiece.holes[0], job.edge, job.side);
      result = solve(job);
    } catch (const Error& error) {
      ASSERT_NE(error.code(), ErrorCode::Internal) << error.what();
      ASSERT_NE(error.code(), ErrorCode::BadInput) << error.what();
      continue;
    }
    ++solved;
    subject.workpiece = job.workpiece;
    subject.tool = job.tool;
    subject.tool_axis = result.tool_axis;
    subject.control_to_centre = job.tool.radius;
    subject.width = job.width;
    const verify::Report report = verify::measure(subject, result.motion);

    bool neck = false, holder = false, gouge = false;
    Sampler sampler(job, result, random);
    for (int k = 0; k < 4000; ++k) {
      const Vector3d c = sampler.any_centre();
      const Tip tip = any_tip(random, job.tool);
      if (is_material(job.workpiece, c + sampler.any_offset(tip.height, tip.radius))) {
        (tip.is_holder ? holder : neck) = true;
      }
      const Vector3d q = c + sampler.in_ball(deep);
      if (is_material(job.workpiece, q) && is_beside_chamfer(job, result, q)) gouge = true;
    }
    neck_hits += neck ? 1 : 0;
    holder_hits += holder ? 1 : 0;
    EXPECT_TRUE(!neck || *report.neck_clearance < 0);
    EXPECT_TRUE(!holder || *report.holder_clearance < 0);
    EXPECT_TRUE(!gouge || report.overcut > 0);
    // A refusal shows a point of the tool that is in the material.
    if (*report.neck_clearance < 0) {
      EXPECT_TRUE(is_material(job.workpiece, report.neck_at->point));
      ++neck_refused;
    }
    if (*report.holder_clearance < 0) {
      EXPECT_TRUE(is_material(job.workpiece, report.holder_at->point));
    }
    clear += *report.neck_clearance > 0 && *report.holder_clearance > 0 ? 1 : 0;
    EXPECT_GE(report.rapid_clearance, job.clearance - 1e-6);
  }
  EXPECT_GT(solved, 90);
  EXPECT_GT(neck_hits, 20);
  EXPECT_GT(holder_hits, 3);
  EXPECT_GT(clear, 20);
  EXPECT_GE(neck_refused, neck_hits);
}

}  // namespace
}  // namespace ridgeline::chamfer
