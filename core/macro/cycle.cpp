#include "core/macro/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/angle.hpp"
#include "core/macro/cycle_motion.hpp"
#include "core/macro/cycle_section.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

// Angles of a circle that the points are given at: all of a few, else the first four and the last
// three; the motion has them all.
constexpr std::size_t few_places = 7, first_places = 4, last_places = 3;
constexpr int helix_points = 24;  // parts that a helix is given at

// The angles at which a circular edge of method 2 begins and ends, or the passes of method 1.
std::vector<double> point_places(const Cycle& cycle, const std::vector<double>& passes) {
  if (cycle.edge == EdgeShape::Straight) return {cycle.x_start, cycle.x_end};
  std::vector<double> all = passes;
  if (cycle.method == 2) {
    all = places(cycle.angle_start, cycle.angle_end,
                 cycle.angle_step.value_or(std::abs(cycle.angle_end - cycle.angle_start)));
  }
  if (all.size() <= few_places) return all;
  std::vector<double> chosen(all.begin(), all.begin() + first_places);
  chosen.insert(chosen.end(), all.end() - last_places, all.end());
  return chosen;
}

bool is_half_round(const Cycle& cycle) {
  return cycle.family == Family::HalfConvex || cycle.family == Family::HalfConcave;
}

std::vector<CyclePoint> cycle_points(const Cycle& cycle, const std::vector<Station>& stations,
                                     const std::vector<double>& passes, const Progress& progress) {
  const std::vector<double> along_edge = point_places(cycle, passes);
  std::vector<CyclePoint> points;
  points.reserve(along_edge.size() * stations.size());
  for (const double along : along_edge) {
    for (const Station& station : stations) {
      if (points.size() % 1024 == 0) progress.at(0, "cycle");
      CyclePoint point;
      point.along = along;
      point.station = station;
      point.contact = placed(cycle, along, station.contact);
      point.normal = placed_direction(cycle, along, station.normal);
      point.tip = placed(cycle, along, station.tip);
      point.tip_radius = radius_at(cycle, station.tip.x());
      points.push_back(point);
    }
  }
  return points;
}

// Offsets to the outline: -tip_y from the wall's foot; from the top edge, R or w more.
std::vector<OffsetPass> offset_passes(const Cycle& cycle, const std::vector<Station>& stations) {
  const bool is_top = cycle.outline && cycle.outline->is_top_edge;
  const double shift = !is_top ? 0 : cycle.family == Family::ComplexSide ? cycle.width : cycle.R;
  std::vector<OffsetPass> passes;
  passes.reserve(stations.size());
  for (const Station& station : stations) {
    passes.push_back({station.param, station.tip.y(), shift - station.tip.x()});
  }
  return passes;
}

std::vector<RotatedPoint> rotated_points(const Cycle& cycle) {
  const double s = std::sin(radians(cycle.rotation)), c = std::cos(radians(cycle.rotation));
  std::vector<RotatedPoint> rotated;
  for (const Vector3d& p : cycle.points) {
    rotated.push_back({p,
                       {p.x(), p.y() * c - p.z() * s, p.y() * s + p.z() * c},
                       {p.z() * s + p.x() * c, p.y(), p.z() * c - p.x() * s},
                       {p.x() * c - p.y() * s, p.x() * s + p.y() * c, p.z()}});
  }
  return rotated;
}

// sum (-1)^k x^(2k+1)/(2k+1)! and sum (-1)^k x^(2k)/(2k)!, x reduced to +-90 degrees first.
SeriesValue series_value(double angle, int terms) {
  double reduced = std::remainder(angle, 360.0);
  double cosine_sign = 1;
  if (std::abs(reduced) > 90) {
    reduced = (reduced > 0 ? 180 : -180) - reduced;
    cosine_sign = -1;
  }
  const double x = radians(reduced);
  double sine = 0, cosine = 0, odd = x, even = 1;
  for (int k = 0; k < terms; ++k) {
    sine += odd;
    cosine += even;
    odd *= -x * x / ((2 * k + 2) * (2 * k + 3));
    even *= -x * x / ((2 * k + 1) * (2 * k + 2));
  }
  SeriesValue value{angle, sine, cosine_sign * cosine, {}};
  if (std::abs(reduced) != 90) value.tangent = value.sine / value.cosine;
  return value;
}

// Inside, the tip must stay off the axis; the tracing method goes to y = -D/2.
void check_room(const Cycle& cycle, const std::vector<Station>& stations) {
  const bool is_helix =
      cycle.family == Family::HelicalSide || cycle.family == Family::HelicalCornerR;
  if (cycle.side == WallSide::Outside || (cycle.edge == EdgeShape::Straight && !is_helix)) return;
  double lowest = is_helix || cycle.method == 1 ? -cycle.D / 2 : 0;
  for (const Station& station : stations) lowest = std::min(lowest, station.tip.x());
  const bool fits = cycle.method == 1 ? cycle.R0 + lowest >= 0 : cycle.R0 + lowest > 0;
  if (fits) return;
  ErrorDetails details;
  details.field = "R0";
  details.value = number_text(cycle.R0);
  details.limit = "greater than " + number_text(-lowest) + " mm, the reach of the tool's axis";
  throw Error(ErrorCode::BadInput, "R0 must be " + details.limit + ", is " + details.value,
              details);
}

void warn_of_rest(const Cycle& cycle, CycleResult& result) {
  const double R = cycle.R, r = cycle.r, a = core_radius(cycle);
  if (cycle.family == Family::HalfConcave && a > 0) {
    const double rest = R - r - std::sqrt((R - r) * (R - r) - a * a);
    result.warnings.push_back("the tool's flat leaves " + number_text(rest) +
                              " mm at the bottom of the groove");
  }
  if (cycle.family == Family::HalfConvex) {
    const double floor = cycle.z_floor.value_or(-R);
    const double foot = R * std::cos(half_round_limit(cycle)) - R - floor;
    if (foot > 1e-9) {
      result.warnings.push_back("the corner radius leaves the foot of the ridge up to " +
                                number_text(foot) + " mm above the floor");
    }
  }
}

}  // namespace

CycleResult solve(const Cycle& cycle, const Progress& progress) {
  validate(cycle);
  CycleResult result;
  if (cycle.family == Family::Rotation) {
    result.rotated = rotated_points(cycle);
  } else if (cycle.family == Family::Series) {
    for (const double angle : cycle.angles) {
      result.series.push_back(series_value(angle, cycle.terms));
    }
    return result;
  } else {
    result.stations = section_stations(cycle);
    check_room(cycle, result.stations);
    result.cusp = cusp_height(cycle);
  }
  if (cycle.method == 1) {
    result.passes = cycle.edge == EdgeShape::Straight
                        ? places(cycle.x_start, cycle.x_end, pass_step(cycle))
                        : places(cycle.angle_start, cycle.angle_end, pass_step(cycle));
  }
  if (cycle.family == Family::ComplexSide || cycle.family == Family::ComplexCornerR) {
    result.offsets = offset_passes(cycle, result.stations);
  } else if (cycle.family == Family::HelicalSide || cycle.family == Family::HelicalCornerR) {
    result.helix = helix_path(cycle);
    const auto count = static_cast<int>(result.helix.size()) - 1;
    std::vector<HelixPoint> chosen;
    for (int i = 0; i <= helix_points; ++i) {
      const auto index =
          static_cast<std::size_t>(std::llround(static_cast<double>(i) * count / helix_points));
      if (chosen.empty() || chosen.back().index != result.helix[index].index) {
        chosen.push_back(result.helix[index]);
      }
    }
    result.helix = std::move(chosen);
  } else if (!is_half_round(cycle)) {
    result.points = cycle_points(cycle, result.stations, result.passes, progress);
  }
  warn_of_rest(cycle, result);
  result.motion = cycle_motion(cycle, result, progress);
  return result;
}

}  // namespace ridgeline::macro
