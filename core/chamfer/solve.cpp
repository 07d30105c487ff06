#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/base/text.hpp"
#include "core/chamfer/job.hpp"
#include "core/chamfer/loop.hpp"
#include "core/chamfer/motion.hpp"
#include "core/chamfer/route.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector3d;

constexpr double full_turn = 2 * std::numbers::pi;
constexpr int border_count = 360;  ///< borders that leads are held against

double wrapped(double u) {
  const double w = u - std::floor(u);
  return w < 1 ? w : 0;
}

const geometry::Hole& hole_of(const Job& job) {
  const auto hole = std::ranges::find(job.workpiece.holes, job.hole, &geometry::Hole::name);
  if (hole == job.workpiece.holes.end()) {
    throw Error(ErrorCode::UnknownHole, "the workpiece has no hole named \"" + job.hole + "\"",
                {.field = "/hole", .value = job.hole});
  }
  return *hole;
}

/// u of the profile point in the direction phi from the hole axis; of a merged edge, the angle
/// itself. The polar angle grows with u: bisection in the turn that has phi.
double parameter_at_angle(const geometry::Edge& edge, double phi) {
  const double turn = wrapped(phi / full_turn);
  const bool is_round = edge.profile.straight_along == 0 && edge.profile.straight_across == 0;
  if (edge.merged || is_round) return turn;
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double u = (low + high) / 2;
    const Eigen::Vector2d p = geometry::profile_at(edge.profile, u).p;
    (wrapped(std::atan2(p.y(), p.x()) / full_turn) < turn ? low : high) = u;
  }
  return wrapped(high);
}

CutPoint in_work(const geometry::Edge& edge, double u, const SectionPoint& point) {
  return {.u = u,
          .P = geometry::to_outer(edge.frame, point.ridge.P),
          .G1 = geometry::to_outer(edge.frame, point.G1),
          .G2 = geometry::to_outer(edge.frame, point.G2),
          .C = geometry::to_outer(edge.frame, point.C)};
}

std::vector<CutPoint> borders_of(const geometry::Edge& edge, const Chamfer& chamfer) {
  const Section ready = section(edge, chamfer);
  std::vector<CutPoint> all;
  for (int i = 0; i < border_count; ++i) {
    const double u = static_cast<double>(i) / border_count;
    all.push_back(in_work(edge, u, section_at(ready, u)));
  }
  return all;
}

/// A chamfer border beyond a bound of the edge: it eats through the wall or over an end.
void require_within_bounds(const geometry::Edge& edge, double u, const SectionPoint& point) {
  for (const geometry::Bound& bound : edge.bounds) {
    for (const Vector3d& G : {point.G1, point.G2}) {
      const double inside = bound.m * geometry::signed_distance(bound.surface, G).value;
      if (inside > 0) continue;
      throw Error(ErrorCode::WidthTooLarge,
                  "the chamfer runs " + text(-inside, "mm") + " past " + bound.name,
                  {.field = "/width",
                   .value = text((point.G1 - point.G2).norm(), "mm"),
                   .limit = "a chamfer within " + bound.name,
                   .parameter = u,
                   .target = geometry::to_outer(edge.frame, point.ridge.P)});
    }
  }
}

class Solver {
public:
  Solver(const Job& job, const Progress& progress)
      : job_(job),
        progress_(progress),
        edge_(geometry::edge_of(job.workpiece, hole_of(job), job.edge, job.side)),
        start_u_(parameter_at_angle(edge_, job.start_angle)) {}

  Result run();

private:
  Chamfer chamfer(double width) const {
    return {.W = width,
            .D = tool::cutting_radius(job_.tool),
            .section_angle = job_.section_angle,
            .method = job_.method};
  }
  Round round(double width);
  Round oriented(const Round& round, bool reversed, double width) const;
  std::vector<CutPoint> overlap(const std::vector<CutPoint>& loop, bool reversed,
                                double width) const;
  MotionPlan plan_along(const Route& route, const geometry::Solid& solid);
  void fill(const Route& route, MotionPlan plan);

  const Job& job_;
  const Progress& progress_;
  geometry::Edge edge_;
  double start_u_;
  std::vector<double> widths_;
  std::vector<Round> rounds_;    ///< in ascending u
  std::vector<Round> oriented_;  ///< as cut on the way last planned
  std::vector<CutPoint> borders_;
  Result result_;
};

Round Solver::round(double width) {
  const Loop once =
      loop(edge_, chamfer(width),
           {.tolerance = job_.tolerance, .points = job_.points, .start_u = start_u_}, progress_);
  result_.points_optimal = once.points_optimal;
  result_.chord_error = once.chord_error;
  Round round;
  round.points.reserve(once.points.size());
  for (std::size_t i = 0; i < once.points.size(); ++i) {
    require_within_bounds(edge_, once.parameter[i], once.points[i]);
    round.points.push_back(in_work(edge_, once.parameter[i], once.points[i]));
  }
  return round;
}

// The points of the loop again as far as the overlap goes, then a point at its very end.
std::vector<CutPoint> Solver::overlap(const std::vector<CutPoint>& loop, bool reversed,
                                      double width) const {
  if (!(job_.overlap > 0)) return {};
  const double sign = reversed ? -1 : 1;
  const double end_u = parameter_at_angle(edge_, job_.start_angle + sign * job_.overlap);
  const auto travelled = [&](double u) { return wrapped(sign * (u - start_u_)); };
  const double end = job_.overlap < full_turn ? travelled(end_u) : 1;
  std::vector<CutPoint> again;
  for (std::size_t i = 1; i < loop.size() && travelled(loop[i].u) < end; ++i) {
    again.push_back(loop[i]);
  }
  const Chamfer wanted = chamfer(width);
  const SectionPoint last = job_.method == Method::Swept ? swept_at(edge_, wanted, end_u)
                                                         : section_at(edge_, wanted, end_u);
  again.push_back(in_work(edge_, end_u, last));
  return again;
}

Round Solver::oriented(const Round& round, bool reversed, double width) const {
  Round out;
  out.points = round.points;
  if (reversed) std::reverse(out.points.begin() + 1, out.points.end());
  out.overlap = overlap(out.points, reversed, width);
  return out;
}

MotionPlan Solver::plan_along(const Route& route, const geometry::Solid& solid) {
  const bool climbs = is_climb(rounds_.back().points, route.tool_axis, job_.tool.spindle);
  const bool reversed = climbs != (job_.direction == Direction::Climb);
  oriented_.clear();
  for (std::size_t i = 0; i < rounds_.size(); ++i) {
    oriented_.push_back(oriented(rounds_[i], reversed, widths_[i]));
  }
  const Room room(solid, job_.tool, route.tool_axis);
  return plan(job_, edge_, route, room, oriented_, borders_);
}

void Solver::fill(const Route& route, MotionPlan plan) {
  result_.tool_axis = route.tool_axis;
  for (const CutPoint& p : oriented_.back().points) {
    result_.parameter.push_back(p.u);
    result_.targets.push_back(p.P);
    result_.centres.push_back(p.C);
    result_.G1.push_back(p.G1);
    result_.G2.push_back(p.G2);
  }
  result_.motion = std::move(plan.motion);
  result_.warnings = std::move(plan.warnings);
  if (job_.control_point == ControlPoint::Centre) return;
  const Vector3d to_tip = -tool::cutting_radius(job_.tool) * route.tool_axis;
  result_.motion.start += to_tip;
  for (path::Move& move : result_.motion.moves) move.to += to_tip;
}

// Of the ways that the axis allows, the first with room for the whole tool; if none has, the one
// with the most: what is in the way is measured and named afterwards.
Result Solver::run() {
  widths_ = job_.pass_widths.empty() ? std::vector<double>{job_.width} : job_.pass_widths;
  for (const double width : widths_) rounds_.push_back(round(width));
  if (job_.spring_pass) {
    widths_.push_back(job_.width);
    rounds_.push_back(rounds_.back());
  }
  borders_ = borders_of(edge_, chamfer(job_.width));
  progress_.at(0.8, "motion");

  const geometry::Solid solid(job_.workpiece);
  std::optional<Error> does_not_fit;
  double best = -std::numeric_limits<double>::infinity();
  for (const Route& route : routes(job_, edge_)) {
    try {
      require_entry(job_, edge_, route);
    } catch (const Error& error) {
      if (!does_not_fit) does_not_fit = error;
      continue;
    }
    MotionPlan found = plan_along(route, solid);
    if (!(found.room > best)) continue;
    best = found.room;
    result_.parameter.clear();
    result_.targets.clear();
    result_.centres.clear();
    result_.G1.clear();
    result_.G2.clear();
    fill(route, std::move(found));
    if (best > 0) break;
  }
  if (std::isinf(best) && does_not_fit) throw *does_not_fit;
  return std::move(result_);
}

}  // namespace

Result solve(const Job& job, const Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  validate(job);
  Result result = Solver(job, progress).run();
  result.solve_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace ridgeline::chamfer
