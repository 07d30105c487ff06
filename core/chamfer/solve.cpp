#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/base/text.hpp"
#include "core/chamfer/blocks.hpp"
#include "core/chamfer/job.hpp"
#include "core/chamfer/loop.hpp"
#include "core/chamfer/motion.hpp"
#include "core/chamfer/neighbours.hpp"
#include "core/chamfer/route.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector3d;

constexpr double full_turn = 2 * std::numbers::pi;
constexpr double arc_sampling = 0.0025;  ///< of the tolerance, for the polyline under arcs
constexpr int points_under_arc = 32;     ///< of that polyline, where the arcs' ends are chosen
constexpr int border_count = 360;        ///< borders that leads are held against

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

/// u of the ridge point in the direction phi from the hole axis; a merged edge has its own turn.
double parameter_at(const geometry::Edge& edge, double phi) {
  return edge.merged ? wrapped(phi / full_turn) : geometry::parameter_at(edge.profile, phi);
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
        start_u_(parameter_at(edge_, job.start_angle)) {}

  Result run();

private:
  Chamfer chamfer(double width) const {
    return {.W = width,
            .D = tool::cutting_radius(job_.tool),
            .section_angle = job_.section_angle,
            .method = job_.method};
  }
  std::vector<CutPoint> sampled(double width);
  Round oriented(std::vector<CutPoint> points, bool reversed, double width,
                 const Vector3d& tool_axis);
  std::vector<CutPoint> overlap(const std::vector<CutPoint>& loop, bool reversed,
                                double width) const;
  std::vector<Route> open_routes() const;
  MotionPlan plan_along(const Route& route, const geometry::Solid& solid);
  void fill(const Route& route, MotionPlan plan);
  int finer() const;

  const Job& job_;
  const Progress& progress_;
  geometry::Edge edge_;
  double start_u_;
  std::vector<double> widths_;
  std::vector<std::vector<CutPoint>> loops_;  ///< of each pass, in ascending u
  double sampling_error_ = 0;                 ///< of the loops [mm]
  std::vector<Round> oriented_;               ///< as cut on the way last planned
  std::vector<CutPoint> borders_;
  Result result_;
};

/// Points of the polyline for one that the job asks for.
int Solver::finer() const {
  if (!job_.arcs || !job_.points) return 1;
  return std::clamp(point_limit / *job_.points, 1, points_under_arc);
}

// Arcs are fitted to a finer polyline, which takes a small share of the tolerance.
std::vector<CutPoint> Solver::sampled(double width) {
  const double share = job_.arcs ? arc_sampling : 1;
  Sampling sampling{.tolerance = share * job_.tolerance, .points = {}, .start_u = start_u_};
  if (job_.points) sampling.points = *job_.points * finer();
  const Loop once = loop(edge_, chamfer(width), sampling, progress_);
  result_.points_optimal =
      static_cast<int>(std::ceil(once.points_optimal * std::sqrt(share) - 1e-9));
  sampling_error_ = result_.chord_error = once.chord_error;
  std::vector<CutPoint> points;
  points.reserve(once.points.size());
  for (std::size_t i = 0; i < once.points.size(); ++i) {
    require_within_bounds(edge_, once.parameter[i], once.points[i]);
    points.push_back(in_work(edge_, once.parameter[i], once.points[i]));
  }
  return points;
}

// The points of the loop again as far as the overlap goes, then a point at its very end.
std::vector<CutPoint> Solver::overlap(const std::vector<CutPoint>& loop, bool reversed,
                                      double width) const {
  if (!(job_.overlap > 0)) return {};
  const double sign = reversed ? -1 : 1;
  const double end_u = parameter_at(edge_, job_.start_angle + sign * job_.overlap);
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
  if (again.size() > 1 && again.back().C == again[again.size() - 2].C) again.pop_back();
  return again;
}

Round Solver::oriented(std::vector<CutPoint> points, bool reversed, double width,
                       const Vector3d& tool_axis) {
  if (reversed) std::reverse(points.begin() + 1, points.end());
  std::vector<CutPoint> lap = points;
  lap.push_back(points.front());
  std::vector<CutPoint> past = {points.front()};
  for (const CutPoint& p : overlap(points, reversed, width)) past.push_back(p);

  Round round;
  round.first_travel = (points[1].C - points.back().C).normalized();
  round.last_travel = past.size() == 1 ? round.first_travel
                                       : (past.back().C - past[past.size() - 2].C).normalized();
  if (!job_.arcs) {
    round.points = std::move(points);
    round.blocks = straight_blocks(lap);
    for (CutBlock& block : straight_blocks(past)) round.blocks.push_back(std::move(block));
    return round;
  }
  const ArcWish wish{.tool_axis = tool_axis,
                     .frame = job_.arc_frame,
                     .tolerance = job_.tolerance,
                     .sampling_error = sampling_error_,
                     .step = job_.points ? static_cast<std::size_t>(finer()) : 0};
  const Blocks once = arc_blocks(lap, wish);
  const Blocks again = arc_blocks(past, wish);
  result_.chord_error = std::max(once.error, again.error);
  round.blocks = once.blocks;
  round.blocks.insert(round.blocks.end(), again.blocks.begin(), again.blocks.end());
  round.points.push_back(lap.front());
  for (std::size_t i = 0; i + 1 < once.blocks.size(); ++i) {
    round.points.push_back(once.blocks[i].to);
  }
  return round;
}

MotionPlan Solver::plan_along(const Route& route, const geometry::Solid& solid) {
  const bool climbs = is_climb(loops_.back(), route.tool_axis, job_.tool.spindle);
  const bool reversed = climbs != (job_.direction == Direction::Climb);
  oriented_.clear();
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    oriented_.push_back(oriented(loops_[i], reversed, widths_[i], route.tool_axis));
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
  for (path::Move& move : result_.motion.moves) {
    move.to += to_tip;
    if (move.arc) move.arc->centre += to_tip;
  }
}

// The ways that the axis allows and the ball fits into. Throws what keeps it out when there is
// none.
std::vector<Route> Solver::open_routes() const {
  std::vector<Route> open;
  std::optional<Error> does_not_fit;
  for (const Route& route : routes(job_, edge_)) {
    try {
      require_entry(job_, edge_, route);
      open.push_back(route);
    } catch (const Error& error) {
      if (!does_not_fit) does_not_fit = error;
    }
  }
  if (open.empty() && does_not_fit) throw *does_not_fit;
  return open;
}

// Of the ways that the axis allows, the first with room for the whole tool; if none has, the one
// with the most: what is in the way is measured and named afterwards.
Result Solver::run() {
  const std::vector<Route> open = open_routes();
  widths_ = job_.pass_widths.empty() ? std::vector<double>{job_.width} : job_.pass_widths;
  for (const double width : widths_) loops_.push_back(sampled(width));
  if (job_.spring_pass) {
    widths_.push_back(job_.width);
    loops_.push_back(loops_.back());
  }
  borders_ = borders_of(edge_, chamfer(job_.width));
  const std::vector<Neighbour> near = neighbours(job_, borders_, job_.width);
  require_clear(near, job_.width);
  progress_.at(0.8, "motion");

  const geometry::Solid solid(job_.workpiece);
  double best = -std::numeric_limits<double>::infinity();
  for (const Route& route : open) {
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
  for (const Neighbour& neighbour : near) result_.warnings.push_back(warning(neighbour));
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
