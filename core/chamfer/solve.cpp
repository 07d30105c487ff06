#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

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

/// The rounds on one of the ways that the axis allows.
struct Way {
  Route route;
  MotionPlan plan;
  Round last;  ///< of the rounds
};

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
  std::vector<CutPoint> sampled(double width, const Progress& progress);
  Round oriented(const std::vector<CutPoint>& loop, bool reversed, double width,
                 const Vector3d& tool_axis, const Progress& progress) const;
  void overlap(std::vector<CutPoint>& way, bool reversed, double width,
               const Progress& progress) const;
  std::vector<Route> open_routes() const;
  Way way_along(const Route& route, const geometry::Solid& solid, const Progress& progress) const;
  void fill(Way way, const Progress& progress);
  int finer() const;

  const Job& job_;
  const Progress& progress_;
  geometry::Edge edge_;
  double start_u_;
  std::vector<double> widths_;
  std::vector<std::vector<CutPoint>> loops_;  ///< in ascending u; a spring pass has the last again
  double sampling_error_ = 0;                 ///< of the loops [mm]
  std::vector<CutPoint> borders_;
  Result result_;
};

/// Points of the polyline for one that the job asks for.
int Solver::finer() const {
  if (!job_.arcs || !job_.points) return 1;
  return std::clamp(point_limit / *job_.points, 1, points_under_arc);
}

// Arcs are fitted to a finer polyline, which takes a small share of the tolerance.
std::vector<CutPoint> Solver::sampled(double width, const Progress& progress) {
  const double share = job_.arcs ? arc_sampling : 1;
  Sampling sampling{.tolerance = share * job_.tolerance, .points = {}, .start_u = start_u_};
  if (job_.points) sampling.points = *job_.points * finer();
  const Loop once = loop(edge_, chamfer(width), sampling, progress.part(0, 0.9));
  result_.points_optimal =
      static_cast<int>(std::ceil(once.points_optimal * std::sqrt(share) - 1e-9));
  sampling_error_ = once.chord_error;
  std::vector<CutPoint> points;
  points.reserve(once.points.size());
  const Progress rest = progress.part(0.9, 1);
  for (std::size_t i = 0; i < once.points.size(); ++i) {
    rest.step(i, once.points.size(), "points");
    require_within_bounds(edge_, once.parameter[i], once.points[i]);
    points.push_back(in_work(edge_, once.parameter[i], once.points[i]));
  }
  return points;
}

// After a lap, its points again as far as the overlap goes, then a point at its very end.
void Solver::overlap(std::vector<CutPoint>& way, bool reversed, double width,
                     const Progress& progress) const {
  if (!(job_.overlap > 0)) return;
  const double sign = reversed ? -1 : 1;
  const double end_u = parameter_at(edge_, job_.start_angle + sign * job_.overlap);
  const auto travelled = [&](double u) { return wrapped(sign * (u - start_u_)); };
  const double end = job_.overlap < full_turn ? travelled(end_u) : 1;
  const std::size_t n = way.size() - 1;
  for (std::size_t i = 1; i < n && travelled(way[i].u) < end; ++i) {
    progress.step(i, n, "overlap");
    way.push_back(way[i]);
  }
  const Chamfer wanted = chamfer(width);
  const SectionPoint last = job_.method == Method::Swept ? swept_at(edge_, wanted, end_u)
                                                         : section_at(edge_, wanted, end_u);
  const bool has_more = way.size() > n + 1;
  way.push_back(in_work(edge_, end_u, last));
  if (has_more && way.back().C == way[way.size() - 2].C) way.pop_back();
}

Round Solver::oriented(const std::vector<CutPoint>& loop, bool reversed, double width,
                       const Vector3d& tool_axis, const Progress& progress) const {
  const std::size_t n = loop.size();
  const Progress order = progress.part(0, 0.2), blocks = progress.part(0.3, 0.9),
                 rest = progress.part(0.9, 1);
  std::vector<CutPoint> way;
  way.reserve(2 * n + 2);
  for (std::size_t i = 0; i <= n; ++i) {
    order.step(i, n, "order");
    way.push_back(loop[reversed ? (n - i) % n : i % n]);
  }
  overlap(way, reversed, width, progress.part(0.2, 0.3));

  Round round;
  round.chord_error = sampling_error_;
  round.first_travel = (way[1].C - way[n - 1].C).normalized();
  round.last_travel = way.size() == n + 1 ? round.first_travel
                                          : (way.back().C - way[way.size() - 2].C).normalized();
  round.last = way.back();
  if (!job_.arcs) {
    round.blocks = straight_blocks(way, blocks);
    way.resize(n);
    round.points = std::move(way);
    return round;
  }
  const ArcWish wish{.tool_axis = tool_axis,
                     .frame = job_.arc_frame,
                     .tolerance = job_.tolerance,
                     .sampling_error = sampling_error_,
                     .step = job_.points ? static_cast<std::size_t>(finer()) : 0};
  const std::span<const CutPoint> all(way), lap = all.first(n + 1);
  const Blocks once = arc_blocks(lap, wish, blocks);
  const Blocks again = arc_blocks(all.subspan(n), wish, rest);
  round.chord_error = std::max(once.error, again.error);
  round.blocks = once.blocks;
  round.blocks.insert(round.blocks.end(), again.blocks.begin(), again.blocks.end());
  round.points.reserve(once.index.size());
  round.points.push_back(lap.front());
  for (std::size_t i = 0; i + 1 < once.index.size(); ++i) {
    round.points.push_back(lap[once.index[i]]);
  }
  return round;
}

Way Solver::way_along(const Route& route, const geometry::Solid& solid,
                      const Progress& progress) const {
  const bool climbs =
      is_climb(loops_.back(), route.tool_axis, job_.tool.spindle, progress.part(0, 0.1));
  const bool reversed = climbs != (job_.direction == Direction::Climb);
  std::vector<Round> rounds;
  const double each = 0.6 / static_cast<double>(widths_.size());
  for (std::size_t i = 0; i < widths_.size(); ++i) {
    const double done = 0.1 + each * static_cast<double>(i);
    const std::vector<CutPoint>& loop = loops_[std::min(i, loops_.size() - 1)];
    rounds.push_back(
        oriented(loop, reversed, widths_[i], route.tool_axis, progress.part(done, done + each)));
  }
  const Room room(solid, job_.tool, route.tool_axis);
  MotionPlan motion = plan(job_, edge_, route, room, rounds, borders_, progress.part(0.7, 1));
  return {route, std::move(motion), std::move(rounds.back())};
}

void Solver::fill(Way way, const Progress& progress) {
  result_.tool_axis = way.route.tool_axis;
  result_.chord_error = way.last.chord_error;
  const std::vector<CutPoint>& points = way.last.points;
  for (std::vector<Vector3d>* each :
       {&result_.targets, &result_.centres, &result_.G1, &result_.G2}) {
    each->reserve(points.size());
  }
  result_.parameter.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    progress.step(i, 2 * points.size(), "points");
    const CutPoint& p = points[i];
    result_.parameter.push_back(p.u);
    result_.targets.push_back(p.P);
    result_.centres.push_back(p.C);
    result_.G1.push_back(p.G1);
    result_.G2.push_back(p.G2);
  }
  result_.motion = std::move(way.plan.motion);
  result_.warnings = std::move(way.plan.warnings);
  if (job_.control_point == ControlPoint::Centre) return;
  const Vector3d to_tip = -tool::cutting_radius(job_.tool) * way.route.tool_axis;
  result_.motion.start += to_tip;
  std::vector<path::Move>& moves = result_.motion.moves;
  const Progress rest = progress.part(0.5, 1);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    rest.step(i, moves.size(), "motion");
    moves[i].to += to_tip;
    if (moves[i].arc) moves[i].arc->centre += to_tip;
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
  const Progress points = progress_.part(0, 0.7);
  for (std::size_t i = 0; i < widths_.size(); ++i) {
    const double each = 1.0 / static_cast<double>(widths_.size());
    const double done = each * static_cast<double>(i);
    loops_.push_back(sampled(widths_[i], points.part(done, done + each)));
  }
  if (job_.spring_pass) widths_.push_back(job_.width);
  borders_ = borders_of(edge_, chamfer(job_.width));
  const Progress rest = progress_.part(0.7, 1);
  const std::vector<Neighbour> near = neighbours(job_, borders_, job_.width, rest.part(0, 0.1));
  require_clear(near, job_.width);

  rest.at(0.1, "motion");
  const geometry::Solid solid(job_.workpiece);
  std::optional<Way> best;
  for (const Route& route : open) {
    Way found = way_along(route, solid, rest.part(0.1, 0.8));
    if (!best || found.plan.room > best->plan.room) best = std::move(found);
    if (best->plan.room > 0) break;
  }
  loops_.clear();
  fill(*std::move(best), rest.part(0.8, 1));
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
