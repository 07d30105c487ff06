#include "core/nc/plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"
#include "core/nc/text.hpp"
#include "core/nc/validate.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::nc {
namespace {

constexpr double pi = std::numbers::pi;
/// A rounded centre is sought so that the radii at both ends differ by no more than this [mm].
constexpr double end_radius_aim = 0.001;
/// Arcs may refer to the nominal tilted plane, the text to its rounded angles [rad].
constexpr double axes_difference = 1e-4;
constexpr int centre_search = 2;          ///< units around the nearest grid point
constexpr double centre_shift_limit = 2;  ///< of a centre whose ends were rounded [units of these]

[[noreturn]] void refuse(std::size_t move, const std::string& message) {
  throw Error(ErrorCode::BadInput, "move " + std::to_string(move) + ": " + message);
}

/// Rounds the moves one after the other; holds where the motion is, exact and rounded.
class Rounding {
public:
  explicit Rounding(const Program& program)
      : program_(program),
        scale_(static_cast<double>(power_of_ten(program.decimals))),
        centre_scale_(static_cast<double>(power_of_ten(centre_decimals(program)))),
        plan_{plane_axes(program), {}, {}} {}

  Plan run(const Progress& progress) {
    exact_ = program_.motion.start;
    plan_.start = at_ = grid(local(exact_), "the start");
    real_ = real(at_);
    plan_.steps.reserve(program_.motion.moves.size());
    for (index_ = 0; index_ < program_.motion.moves.size(); ++index_) {
      progress.step(index_, program_.motion.moves.size(), "rounding");
      add(program_.motion.moves[index_]);
    }
    return std::move(plan_);
  }

private:
  Eigen::Vector3d local(const Eigen::Vector3d& point) const {
    return plan_.axes.transpose() * point;
  }
  static Eigen::Vector3d real(const Grid& grid, double scale) {
    return Eigen::Vector3d(static_cast<double>(grid[0]), static_cast<double>(grid[1]),
                           static_cast<double>(grid[2])) /
           scale;
  }
  Eigen::Vector3d real(const Grid& grid) const { return real(grid, scale_); }

  static Grid grid(const Eigen::Vector3d& point, double scale, const std::string& name) {
    if (!(point.cwiseAbs().maxCoeff() <= largest_coordinate)) {  // NaN fails too
      throw Error(
          ErrorCode::BadInput,
          name + " has a coordinate that is not within +-99999 mm: " + std::to_string(point.x()) +
              ", " + std::to_string(point.y()) + ", " + std::to_string(point.z()));
    }
    return {std::llround(point.x() * scale), std::llround(point.y() * scale),
            std::llround(point.z() * scale)};
  }
  Grid grid(const Eigen::Vector3d& point, const std::string& name) const {
    return grid(point, scale_, name);
  }

  void add(const path::Move& move) {
    Step step;
    step.kind = move.kind;
    step.rapid = is_rapid(move);
    step.to = grid(local(move.to), "move " + std::to_string(index_));
    step.feed = step.rapid ? 0 : feed(move.feed);
    step.end = real(step.to);
    if (move.arc) {
      step_onto_grid(step, *move.arc);
      set_arc(step, move);
      if (!step.arc) step.end = real(step.to);
    }
    exact_ = move.to;
    if (!step.arc && step.to == at_ && step.end == real_) return;  // nothing to print
    at_ = step.to;
    real_ = step.end;
    plan_.steps.push_back(step);
  }

  /// A HEIDENHAIN helix ends between the units. What follows it in the working plane is polar too;
  /// an arc in another plane needs its start on the grid: a line of less than a unit or two.
  void step_onto_grid(const Step& next, const path::Arc& arc) {
    const bool in_plane = path::axes_of(arc.plane).third == length_axis(program_);
    if (in_plane || real_ == real(at_)) return;
    Step line;
    line.kind = next.kind;
    line.feed = next.feed;
    line.to = at_;
    line.end = real_ = real(at_);
    plan_.steps.push_back(line);
  }

  bool is_rapid(const path::Move& move) const {
    using enum path::MoveKind;
    const bool may_be = move.kind == Rapid || move.kind == Approach || move.kind == Retract;
    const bool rapid = move.kind == Rapid || (may_be && move.feed == 0);
    if (rapid && move.arc) refuse(index_, "an arc cannot be a rapid");
    return rapid;
  }

  /// mm/s to 0.001 mm/min: 0.1 mm/min steps from 10 mm/min on.
  std::int64_t feed(double mm_per_s) const {
    const double mm_per_min = mm_per_s * 60;
    if (!(mm_per_min >= 0.0005 && mm_per_min <= largest_feed)) {
      refuse(index_,
             "feed " + std::to_string(mm_per_min) + " mm/min is not within 0.001 to 999999");
    }
    const std::int64_t fine = std::llround(mm_per_min * 1000);
    return fine < 10'000 ? fine : std::llround(mm_per_min * 10) * 100;
  }

  /// The arc in whole units; none when it differs from its chord by less than half a unit.
  void set_arc(Step& step, const path::Move& move) {
    const Eigen::Matrix3d axes = plan_.axes.transpose() * move.arc->axes;
    if (!((axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= axes_difference)) {
      refuse(index_, "the plane of the arc is not one of the axes that the program prints");
    }
    const path::ArcShape shape = path::arc_shape(exact_, move);
    if (!(std::abs(shape.start_radius - shape.end_radius) <= end_radius_tolerance)) {
      refuse(index_, "the ends of the arc are " + std::to_string(shape.start_radius) + " and " +
                         std::to_string(shape.end_radius) + " mm from its centre");
    }
    const double sagitta = shape.start_radius * (1 - std::cos(shape.sweep / 2));
    if (sagitta * scale_ <= 0.5) return;

    const auto third = static_cast<std::size_t>(path::axes_of(move.arc->plane).third);
    // A coordinate that is not printed stays where the control has it.
    if (step.to[third] == at_[third]) {
      step.end[static_cast<int>(third)] = real_[static_cast<int>(third)];
    }
    ArcStep arc;
    arc.plane = move.arc->plane;
    arc.sense = move.arc->sense;
    const Eigen::Vector3d centre = local(move.arc->centre);
    arc.centre = rounded_centre(centre, arc, step.end, shape.sweep);
    const auto turned = [&] {
      return path::arc_shape(real_,
                             {move.kind, step.end, 1,
                              path::Arc{real(arc.centre, centre_scale_), arc.plane, arc.sense}});
    };
    if (std::abs(turned().sweep - shape.sweep) > pi) {
      // Rounding swapped the order of two ends that nearly coincide.
      if (std::abs(shape.sweep) < pi) return;
      const auto [i, j, k] = path::axes_of(arc.plane);
      for (const int n : {i, j}) {
        step.to[static_cast<std::size_t>(n)] = at_[static_cast<std::size_t>(n)];
        step.end[n] = real_[n];
      }
      arc.centre = rounded_centre(centre, arc, step.end, shape.sweep);
    }
    const bool rises = step.to[third] != at_[third];
    if (program_.dialect == Dialect::Heidenhain && (rises || real_ != real(at_))) {
      if (path::axes_of(arc.plane).third != length_axis(program_)) {
        throw Error(ErrorCode::Unsupported, "move " + std::to_string(index_) +
                                                ": HEIDENHAIN has helices in the working plane "
                                                "only; ask for lines");
      }
      arc.polar = std::llround(degrees(turned().sweep) * 1e4);
      step.end = polar_end(real_, real(arc.centre, centre_scale_), arc.plane, *arc.polar * 100'000,
                           step.end[static_cast<int>(third)]);
    }
    step.arc = arc;
  }

  /// Where the centre must go so that both rounded ends are equally far from it: the shortest way,
  /// by Newton on the difference of the radii. Three steps leave less than the centre's decimals.
  /// An arc of up to half a turn hangs on its ends and hardly feels it; a longer one is carried
  /// along, so that its centre may go a unit or two only.
  Eigen::Vector3d balanced_centre(const Eigen::Vector3d& ideal, const ArcStep& arc,
                                  const Eigen::Vector3d& end, double sweep) const {
    const auto [i, j, k] = path::axes_of(arc.plane);
    const Eigen::Vector2d from(real_[i], real_[j]), to(end[i], end[j]), c0(ideal[i], ideal[j]);
    Eigen::Vector2d c = c0;
    for (int n = 0; n < 3; ++n) {
      const double mismatch = (c - from).norm() - (c - to).norm();
      if (std::abs(mismatch) <= end_radius_aim / 2) break;
      const Eigen::Vector2d gradient = (c - from).normalized() - (c - to).normalized();
      c -= mismatch / gradient.squaredNorm() * gradient;
    }
    const double limit = centre_shift_limit / scale_;
    if (std::abs(sweep) > pi && (c - c0).norm() > limit) {
      c = c0 + limit * (c - c0).normalized();
    }
    Eigen::Vector3d centre = real_;
    centre[i] = c.x();
    centre[j] = c.y();
    return centre;
  }

  /// The grid point near the centre whose distances to the rounded ends agree.
  Grid rounded_centre(const Eigen::Vector3d& ideal, const ArcStep& arc, const Eigen::Vector3d& end,
                      double sweep) const {
    const auto [i, j, k] = path::axes_of(arc.plane);
    const auto first = static_cast<std::size_t>(i), second = static_cast<std::size_t>(j);
    const Eigen::Vector3d centre = balanced_centre(ideal, arc, end, sweep);
    const Grid nearest =
        grid(centre, centre_scale_, "the centre of move " + std::to_string(index_));
    Grid best = nearest;
    double best_cost = std::numeric_limits<double>::infinity(), best_mismatch = best_cost;
    for (std::int64_t a = -centre_search; a <= centre_search; ++a) {
      for (std::int64_t b = -centre_search; b <= centre_search; ++b) {
        Grid at = nearest;
        at[first] += a;
        at[second] += b;
        const Eigen::Vector3d c = real(at, centre_scale_);
        const double start_radius = std::hypot(real_[i] - c[i], real_[j] - c[j]);
        const double end_radius = std::hypot(end[i] - c[i], end[j] - c[j]);
        if (std::min(start_radius, end_radius) * centre_scale_ < 0.5) continue;
        const double mismatch = std::abs(start_radius - end_radius);
        const double moved = std::hypot(centre[i] - c[i], centre[j] - c[j]);
        // First the mismatch as far as it matters, then the nearest.
        const double cost = std::max(mismatch, end_radius_aim) * 1e6 + moved;
        if (cost >= best_cost) continue;
        best = at;
        best_cost = cost;
        best_mismatch = mismatch;
      }
    }
    if (!(best_mismatch <= end_radius_tolerance)) {
      refuse(index_, "the radii at the ends of the arc would differ by more than 0.005 mm: " +
                         std::to_string(program_.decimals) + " decimals are too few for it");
    }
    return best;
  }

  const Program& program_;
  double scale_;
  double centre_scale_;
  Plan plan_;
  Eigen::Vector3d exact_;  ///< work frame, unrounded
  Grid at_{};
  Eigen::Vector3d real_;  ///< what the control is at, printed axes
  std::size_t index_ = 0;
};

}  // namespace

Eigen::Vector3d polar_end(const Eigen::Vector3d& from, const Eigen::Vector3d& centre,
                          path::ArcPlane plane, std::int64_t turn, double height) {
  const auto [i, j, k] = path::axes_of(plane);
  const double a = from[i] - centre[i], b = from[j] - centre[j];
  // A whole turn ends where it began: reduce before the sine sees a rounded pi.
  const double angle = radians(static_cast<double>(turn % 360'000'000'000) / 1e9);
  const auto nano = [](double x) { return static_cast<double>(std::llround(x * 1e9)) / 1e9; };
  Eigen::Vector3d end;
  end[i] = nano(centre[i] + a * std::cos(angle) - b * std::sin(angle));
  end[j] = nano(centre[j] + a * std::sin(angle) + b * std::cos(angle));
  end[k] = height;
  return end;
}

Plan plan(const Program& program, const Progress& progress) {
  validate(program);
  return Rounding(program).run(progress);
}

}  // namespace ridgeline::nc
