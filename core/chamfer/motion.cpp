#include "core/chamfer/motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/text.hpp"

namespace ridgeline::chamfer {
namespace {

using Eigen::Vector3d;
using path::MoveKind;

constexpr double lead_of_radius = 0.5;          ///< lead radius, of the ball's, when none is given
constexpr std::size_t most_moves_beside = 500;  ///< of a round's blocks: leads, approach, retract
constexpr int most_lead = 200;                  ///< straight moves of a lead
constexpr int most_halvings = 8;                ///< of a lead radius that does not fit
constexpr double lead_slack = 0.1;              ///< of the tolerance: what a lead may cut too deep
constexpr int line_samples = 16;                ///< looked at on a straight way near the edge
constexpr int places_looked_at = 48;            ///< of a loop, for the room of the tool
constexpr double largest_feed_ratio = 20;       ///< of the centre's speed to the contact's
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double same_place = 1e-9;  ///< [mm]

/// Away from the material and square to the travel.
Vector3d away(const CutPoint& p, const Vector3d& travel) {
  const Vector3d k = (middle(p) - p.C).normalized();
  return (k.dot(travel) * travel - k).normalized();
}

/// A quarter circle of radius r that touches the path at p; from its far end to p, or back for a
/// reversed travel. Chords keep the tolerance and lie on the side away from the material.
std::vector<Vector3d> lead_arc(const CutPoint& p, const Vector3d& travel, double r,
                               double tolerance) {
  const Vector3d n = away(p, travel);
  const double quarter = std::numbers::pi / 2;
  const double widest = 2 * std::acos(std::max(0.0, 1 - tolerance / r));
  const int count = std::clamp(static_cast<int>(std::ceil(quarter / widest)), 3, most_lead);
  std::vector<Vector3d> points;
  for (int i = 0; i <= count; ++i) {
    const double w = quarter * (count - i) / count;
    points.push_back(p.C + r * ((1 - std::cos(w)) * n - std::sin(w) * travel));
  }
  return points;
}

/// What the ball may do near the edge: not cut below the borders of the chamfer.
class Leads {
public:
  Leads(const Room& room, const std::vector<CutPoint>& borders, double slack)
      : room_(room), borders_(borders), slack_(slack) {
    for (const CutPoint& border : borders_) {
      reach_ = std::max({reach_, (border.G1 - border.P).norm(), (border.G2 - border.P).norm()});
    }
  }

  /// How much deeper than the chamfer the ball at c cuts, at most; negative: clear.
  double too_deep(const Vector3d& c) const {
    double deepest = -1e300;
    double ridge = 1e300;
    for (const CutPoint& border : borders_) {
      const double near = std::min((border.G1 - c).norm(), (border.G2 - c).norm());
      deepest = std::max(deepest, room_.ball_radius() - near);
      ridge = std::min(ridge, (border.P - c).norm());
    }
    const geometry::Solid::Nearest nearest = room_.solid().nearest(c);
    if (is_chamfer(nearest.point)) return deepest;
    if (geometry::distance(room_.solid().material(), c) <= 0) return room_.ball_radius();
    if (nearest.distance < room_.ball_radius()) {
      deepest = std::max(deepest, room_.ball_radius() - nearest.distance);
    }
    return deepest;
  }
  bool is_clear(const Vector3d& c) const { return too_deep(c) <= slack_; }
  bool is_clear(const Vector3d& a, const Vector3d& b) const {
    for (int i = 0; i <= line_samples; ++i) {
      if (!is_clear(a + (b - a) * i / line_samples)) return false;
    }
    return true;
  }

private:
  bool is_chamfer(const Vector3d& q) const {
    return std::any_of(borders_.begin(), borders_.end(),
                       [&](const CutPoint& border) { return (border.P - q).norm() <= reach_; });
  }

  const Room& room_;
  const std::vector<CutPoint>& borders_;
  double slack_;
  double reach_ = 0;
};

class Planner {
public:
  Planner(const Job& job, const geometry::Edge& edge, const Route& route, const Room& room,
          const std::vector<CutPoint>& borders)
      : job_(job),
        edge_(edge),
        route_(route),
        room_(room),
        leads_(room, borders, lead_slack * job.tolerance) {}

  MotionPlan run(const std::vector<Round>& rounds, const Progress& progress);

private:
  /// Where a lead begins or ends, and the place on the hole's axis that it is reached from.
  struct Lead {
    std::vector<Vector3d> arc;  ///< ends on the path
    Vector3d ready;
  };
  /// Of the ball centre along the hole's axis, lowest and highest.
  struct Heights {
    double low, high;
  };
  Heights heights(const std::vector<CutPoint>& loop, const Progress& progress) const;
  Lead lead(const CutPoint& p, const Vector3d& travel, const Heights& loop);
  std::vector<Vector3d> ready_places(const Vector3d& from, const Heights& loop) const;
  Vector3d base_of(const Vector3d& ready) const;
  void go(MoveKind kind, const Vector3d& to, double feed);
  void cut(const Round& round, const Progress& progress);
  void cut_along(const CutBlock& block);
  void approach(const Vector3d& ready);
  void retract();
  void look(const std::vector<Round>& rounds);

  const Job& job_;
  const geometry::Edge& edge_;
  const Route& route_;
  const Room& room_;
  Leads leads_;
  MotionPlan plan_;
  Vector3d here_ = Vector3d::Zero();
  Vector3d base_ = Vector3d::Zero();  ///< where the ready place meets the route's line
  Vector3d top_ = Vector3d::Zero();   ///< the last clear point of the route
  Vector3d safe_ = Vector3d::Zero();  ///< above it, clear of the whole workpiece
};

void Planner::go(MoveKind kind, const Vector3d& to, double feed) {
  if (!plan_.motion.moves.empty() && (to - here_).norm() <= same_place) return;
  plan_.motion.moves.push_back({kind, to, feed, std::nullopt});
  here_ = to;
}

Vector3d Planner::base_of(const Vector3d& ready) const {
  return route_.point + (ready - route_.point).dot(route_.outward) * route_.outward;
}

Planner::Heights Planner::heights(const std::vector<CutPoint>& loop,
                                  const Progress& progress) const {
  Heights found{infinity, -infinity};
  for (std::size_t i = 0; i < loop.size(); ++i) {
    progress.step(i, loop.size(), "motion");
    const double z = geometry::to_local(edge_.frame, loop[i].C).z();
    found = {std::min(found.low, z), std::max(found.high, z)};
  }
  return found;
}

// On the hole axis: at the height of the lead, or at the lowest or highest of the loop, or on the
// way to the bore.
std::vector<Vector3d> Planner::ready_places(const Vector3d& from, const Heights& loop) const {
  std::vector<Vector3d> places;
  const double start = geometry::to_local(edge_.frame, from).z();
  const double low = std::min(loop.low, start), high = std::max(loop.high, start);
  const double D = room_.ball_radius();
  for (const double z :
       {start, low, high, low - D / 2, high + D / 2, start / 2, low - D, high + D, 0.0}) {
    places.push_back(geometry::to_outer(edge_.frame, {0, 0, z}));
  }
  return places;
}

Planner::Lead Planner::lead(const CutPoint& p, const Vector3d& travel, const Heights& loop) {
  const double wanted = job_.lead_radius.value_or(lead_of_radius * room_.ball_radius());
  double r = wanted;
  Lead best;
  for (int i = 0; i < most_halvings; ++i, r /= 2) {
    std::vector<Vector3d> arc = lead_arc(p, travel, r, job_.tolerance);
    const bool fits = std::all_of(arc.begin(), arc.end() - 1,
                                  [&](const Vector3d& c) { return leads_.is_clear(c); });
    for (const Vector3d& ready : ready_places(arc.front(), loop)) {
      if (best.arc.empty()) best = {arc, ready};
      if (!fits || !leads_.is_clear(arc.front(), ready) ||
          !leads_.is_clear(ready, base_of(ready))) {
        continue;
      }
      if (job_.lead_radius && r < wanted) {
        plan_.warnings.push_back("the lead radius is " + text(r, "mm") + ": " + text(wanted, "mm") +
                                 " does not fit");
      }
      return {std::move(arc), ready};
    }
  }
  plan_.warnings.push_back("no lead to the path is quite clear of the edge");
  return best;
}

/// Block by block, so that the middle of the chamfer moves at the feed.
void Planner::cut_along(const CutBlock& block) {
  double feed = job_.feed;
  if (job_.feed_at == FeedAt::Contact) {
    feed *= std::clamp(block.centre / std::max(block.contact, same_place), 1 / largest_feed_ratio,
                       largest_feed_ratio);
  }
  go(MoveKind::Cut, block.end, feed);
  if (block.arc) plan_.motion.moves.back().arc = block.arc;
}

void Planner::cut(const Round& round, const Progress& progress) {
  const CutPoint& first = round.points.front();
  const double slow = job_.lead_in_feed.value_or(job_.feed / 2);

  const Heights loop = heights(round.points, progress.part(0, 0.2));
  const Lead in = lead(first, round.first_travel, loop);
  if (plan_.motion.moves.empty()) {
    approach(in.ready);
  } else {
    go(MoveKind::Approach, in.ready, job_.feed);
  }
  for (const Vector3d& c : in.arc) go(MoveKind::LeadIn, c, slow);
  const Progress blocks = progress.part(0.2, 1);
  for (std::size_t i = 0; i < round.blocks.size(); ++i) {
    blocks.step(i, round.blocks.size(), "motion");
    cut_along(round.blocks[i]);
  }

  Lead out = lead(round.last, -round.last_travel, loop);
  std::reverse(out.arc.begin(), out.arc.end());
  for (const Vector3d& c : out.arc) go(MoveKind::LeadOut, c, job_.feed);
  go(MoveKind::LeadOut, out.ready, job_.feed);
}

// Rapid above the workpiece, rapid down to where the clearance ends, then at feed.
void Planner::approach(const Vector3d& ready) {
  base_ = base_of(ready);
  const double plane =
      extent(job_.workpiece, route_.tool_axis) + job_.clearance + room_.ball_radius();
  top_ = last_clear_point(room_, route_, base_, job_.clearance, plane);
  const double rise = std::max(0.0, plane - top_.dot(route_.tool_axis));
  safe_ = top_ + rise * route_.tool_axis;
  plan_.motion.start = safe_;
  go(MoveKind::Rapid, safe_, 0);
  go(MoveKind::Rapid, top_, 0);
  go(MoveKind::Approach, base_, job_.feed);
  go(MoveKind::Approach, ready, job_.feed);
}

void Planner::retract() {
  go(MoveKind::Retract, base_of(here_), job_.feed);
  go(MoveKind::Retract, top_, job_.feed);
  go(MoveKind::Rapid, safe_, 0);
  if (!job_.end_position) return;
  const bool is_tip = job_.control_point == ControlPoint::Tip;
  const Vector3d end = *job_.end_position + (is_tip ? room_.ball_radius() : 0) * route_.tool_axis;
  const double rise = std::max(0.0, (safe_ - end).dot(route_.tool_axis));
  go(MoveKind::Rapid, end + rise * route_.tool_axis, 0);
  go(MoveKind::Rapid, end, 0);
}

void Planner::look(const std::vector<Round>& rounds) {
  const std::vector<CutPoint>& loop = rounds.back().points;
  const std::size_t step = std::max<std::size_t>(1, loop.size() / places_looked_at);
  plan_.room = room_.above(base_);
  for (std::size_t i = 0; i < loop.size(); i += step) {
    plan_.room = std::min(plan_.room, room_.above(loop[i].C));
  }
}

MotionPlan Planner::run(const std::vector<Round>& rounds, const Progress& progress) {
  std::size_t blocks = 0;
  for (const Round& round : rounds) blocks += round.blocks.size() + most_moves_beside;
  plan_.motion.moves.reserve(blocks);
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    const double each = 1.0 / static_cast<double>(rounds.size());
    const double done = each * static_cast<double>(i);
    cut(rounds[i], progress.part(done, done + each));
  }
  retract();
  look(rounds);
  return std::move(plan_);
}

}  // namespace

bool is_climb(const std::vector<CutPoint>& points, const Vector3d& tool_axis,
              tool::SpindleSense spindle, const Progress& progress) {
  const double sign = spindle == tool::SpindleSense::Clockwise ? -1 : 1;
  double along = 0;  // of the tooth's way and the travel
  for (std::size_t i = 0; i < points.size(); ++i) {
    progress.step(i, points.size(), "motion");
    const CutPoint& here = points[i];
    const CutPoint& next = points[(i + 1) % points.size()];
    const Vector3d k = middle(here) - here.C;
    along += (sign * tool_axis).cross(k).dot(next.C - here.C);
  }
  return along < 0;
}

MotionPlan plan(const Job& job, const geometry::Edge& edge, const Route& route, const Room& room,
                const std::vector<Round>& rounds, const std::vector<CutPoint>& borders,
                const Progress& progress) {
  return Planner(job, edge, route, room, borders).run(rounds, progress);
}

}  // namespace ridgeline::chamfer
