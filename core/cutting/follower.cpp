#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/text.hpp"
#include "core/cutting/along.hpp"

namespace ridgeline::cutting {
namespace {

constexpr double chattering = 0.1;  // of the radius: no steady cut gives way so far

IterateOptions iterate_options(const Course& course, const AlongOptions& options) {
  IterateOptions used = options.iterate;
  const bool alike = is_periodic(course.cutter) && course.samples % teeth(course.cutter) == 0;
  used.span = alike ? Span::Pitch : Span::Revolution;
  used.guard = LowPassGuard::Off;
  used.keeps_history = false;
  used.largest = chattering * course.cutter.r;
  if (options.method == Method::Rigid) used.max_loops = 1;
  return used;
}

// Forces and deflection in the work frame.
void summarise(const Prediction& prediction, const Eigen::Matrix3d& axes, StationError& out) {
  if (prediction.F.empty()) return;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& F : prediction.F) {
    sum += F;
    if (F.squaredNorm() > force.squaredNorm()) force = F;
  }
  Eigen::Vector2d deflection = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& D : prediction.D) {
    if (D.squaredNorm() > deflection.squaredNorm()) deflection = D;
  }
  out.mean_force = axes * (sum / static_cast<double>(prediction.F.size()));
  out.peak_force = axes * force;
  out.peak_deflection = axes * Eigen::Vector3d(deflection.x(), deflection.y(), 0);
}

double limit_of(const CorrectOptions& limits, double original) {
  return std::max(limits.residual, limits.relative * std::abs(original));
}

// What a correction takes away: what is left of the error with the tool moved by s.
double left_of(const Station& station, const StationError& now, double s, bool by_borders) {
  if (!by_borders || station.borders.empty()) return *now.e - s;
  double sum = 0;
  for (std::size_t b = 0; b < station.borders.size(); ++b) {
    sum += *now.border[b] - s * station.n.dot(station.borders[b]);
  }
  return sum / static_cast<double>(station.borders.size());
}

[[noreturn]] void refuse(const Station& station, double radius, double original, double left,
                         double shift, double limit) {
  const auto um = [](double mm) { return text(std::round(mm * 1e6) / 1e3) + " um"; };
  ErrorDetails details;
  details.value = um(left);
  details.limit = um(limit);
  details.target = Eigen::Vector3d(station.centre - radius * station.n);
  throw Error(ErrorCode::NotConverged,
              "correction: the error of " + um(original) + " is still " + details.value +
                  " after a shift of " + um(shift) + ", allowed " + details.limit +
                  "; the shift raises the engagement without taking the error away",
              details);
}

}  // namespace

Follower::Follower(const Course& course, const Compliance& compliance, double S,
                   const AlongOptions& options)
    : course_(course),
      compliance_(compliance),
      S_(S),
      options_(options),
      iteration_(compliance, S, iterate_options(course, options)) {}

// The tool moved to c - shift n.
StationError Follower::shifted(const Station& nominal, double shift) {
  Station station = nominal;
  station.centre -= shift * station.n;
  const Cut cut = cut_at(course_, station);
  const Eigen::Matrix3d axes = cut_axes(course_, station.direction);
  compliance_.axes = machine_axes(course_, station.direction);
  StationError out;
  Prediction prediction;
  if (options_.method != Method::TimeDomain) {
    const bool is_rigid = options_.method == Method::Rigid;  // its one loop is from no deflection
    prediction = iteration_.solve(cut, compliance_.axes, is_rigid ? Deflections() : ahead_);
    out.loops = prediction.loops;
    out.converged = prediction.converged;
    out.low_pass_off = options_.iterate.kappa && !prediction.cutoff && prediction.e;
    out.e = prediction.e;
    out.fell_back = !out.converged && options_.fall_back && options_.method == Method::Iterate;
  }
  if (options_.method == Method::TimeDomain || out.fell_back) by_time(cut, prediction, out);
  for (const Eigen::Vector3d& n : station.borders) {
    out.border.push_back(out.e ? iteration_.error_towards(axes.transpose() * n) : out.e);
  }
  start_ = out.settles ? prediction.D : Deflections();  // of nothing, where it chatters
  const bool knows = out.settles && !out.fell_back && !prediction.ahead.empty();
  ahead_ = knows ? std::move(prediction.ahead) : start_;
  summarise(prediction, axes, out);
  return out;
}

// The deflection of the time domain is also what the next station begins from.
void Follower::by_time(const Cut& cut, Prediction& prediction, StationError& out) {
  try {
    TimeOptions time = options_.time;
    time.largest = std::min(time.largest, chattering);
    TimeDomain run = time_domain(cut, compliance_, S_, time);
    iteration_.adopt(cut, run.D);
    out.e = run.e;
    out.stability = stability_of(run);
    if (!out.fell_back) {
      out.loops = run.revolutions;
      out.converged = run.converged;
    }
    prediction.F = std::move(run.F);
    if (!prediction.D.empty()) run.D.resize(prediction.D.size());
    prediction.D = std::move(run.D);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::NotConverged) throw;
    out.settles = out.converged = false;
    out.stability = Stability::Unstable;
  }
}

StationError Follower::at(const Station& station) {
  ahead_ = iteration_.next_start(ahead_);
  StationError out = shifted(station, 0);
  if (options_.uncertainty && out.e) out.spread = spread(station, 0, *out.e);
  return out;
}

// Central differences by a tenth, from the deflection that the station has: the time domain's is
// one that the iteration begins from.
double Follower::spread(const Station& nominal, double shift, double e) {
  constexpr double step = 0.1;
  if (options_.method == Method::TimeDomain) {
    Station station = nominal;
    station.centre -= shift * station.n;
    Deflections D = start_;
    if (iterate_options(course_, options_).span == Span::Pitch) {
      D.resize(D.size() / static_cast<std::size_t>(teeth(course_.cutter)));
    }
    iteration_.solve(cut_at(course_, station), compliance_.axes, D);
  }
  const auto& [cutting, edge, stiffness] = *options_.uncertainty;
  const auto error = [&](double cut_scale, double edge_scale) {
    return iteration_.scaled(cut_scale, edge_scale).e.value_or(e);
  };
  const double by_cutting = (error(1 + step, 1) - error(1 - step, 1)) / (2 * step);
  const double by_edge = (error(1, 1 + step) - error(1, 1 - step)) / (2 * step);
  const double by_stiffness = -(by_cutting + by_edge);  // a stiffer tool is less of both forces
  return std::hypot(by_cutting * cutting, by_edge * edge, by_stiffness * stiffness);
}

// Fixed point s = e(s): the first shift is e(0), the next ones by the secant of e(s) - s, which
// also serves where e(s) grows nearly as fast as s.
StationError Follower::corrected_at(const Station& station, const CorrectOptions& limits) {
  ahead_ = iteration_.next_start(ahead_);
  StationError now = shifted(station, 0);
  if (!now.e) return now;
  const double radius = course_.cutter.r;
  const double before = *now.e;
  const double original = left_of(station, now, 0, limits.by_borders);
  const double limit = limit_of(limits, original);
  const bool stays = limits.only_overcut && original >= 0;
  double s = 0, s_before = 0;
  double left = original, left_before = 0;
  for (int shifts = 0; !stays && std::abs(left) > limit; ++shifts) {
    const double slope = shifts == 0 ? -1 : (left - left_before) / (s - s_before);
    const double next = s - left / slope;
    const bool is_lost = !(slope < 0) || !(std::abs(next) <= limits.largest_shift * radius);
    if (is_lost || shifts == limits.max_shifts) {
      refuse(station, radius, original, left, s, limit);
    }
    s_before = s;
    left_before = left;
    s = next;
    now = shifted(station, s);
    if (!now.e) refuse(station, radius, original, left, s, limit);
    left = left_of(station, now, s, limits.by_borders);
  }
  if (options_.uncertainty) now.spread = spread(station, s, *now.e);
  now.before = before;
  now.shift = s;
  *now.e -= s;
  for (std::size_t b = 0; b < now.border.size(); ++b) {
    if (now.border[b]) *now.border[b] -= s * station.n.dot(station.borders[b]);
  }
  return now;
}

namespace {

// Near -1 every second tooth repeats: a flip. A cutter with unlike teeth has a multiplier by the
// revolution, which tells no flip.
Stability stability_of(std::complex<double> multiplier, bool by_tooth) {
  constexpr double same_angle = 0.1;
  if (std::abs(multiplier) <= 1) return Stability::Stable;
  const bool alternates = std::numbers::pi - std::abs(std::arg(multiplier)) < same_angle;
  return by_tooth && alternates ? Stability::Flip : Stability::Unstable;
}

}  // namespace

void Follower::test(const Station& nominal, StationError& out) {
  if (out.stability) return;  // the time domain has told it
  if (!out.e) {
    out.stability = Stability::Stable;
    return;
  }
  Station station = nominal;
  station.centre -= out.shift * station.n;
  const Cut cut = cut_at(course_, station);
  compliance_.axes = machine_axes(course_, station.direction);
  if (options_.stability == StabilityTest::TimeDomain) {
    out.stability = stability(cut, compliance_, S_);
    return;
  }
  const bool by_tooth = is_periodic(course_.cutter) && cut.samples % teeth(course_.cutter) == 0;
  out.multiplier = floquet_multiplier(cut, compliance_, S_, start_, Engaging::Moving);
  out.stability = stability_of(*out.multiplier, by_tooth);
}

}  // namespace ridgeline::cutting
