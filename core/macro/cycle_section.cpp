#include "core/macro/cycle_section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/angle.hpp"

namespace ridgeline::macro {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double divides = 1e-6;  // of a step: the range counts as a whole number of steps

double sign_of(double value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

// n = (-sin q, cos q), from the material to the tool.
Vector2d normal_at(double q) {
  return {-std::sin(q), std::cos(q)};
}

std::vector<Station> slope_stations(const Cycle& cycle) {
  const double t = radians(cycle.angle);
  const double length = cycle.width / std::cos(t);
  std::vector<Station> stations;
  for (const double s : places(0, length, slope_step(cycle))) {
    const Vector2d C(cycle.width - s * std::cos(t), -s * std::sin(t));
    stations.push_back(station_at(cycle, C.x(), t, C));
  }
  // The last station is at the wall exactly, not off by the rounding of s cos t.
  const Vector2d foot(0, -cycle.width * std::tan(t));
  stations.back() = station_at(cycle, 0, t, foot);
  return stations;
}

// C = K + R n outside of the round, K - R n inside, q in degrees from `from` to `to`.
std::vector<Station> round_stations(const Cycle& cycle, const Vector2d& K, double R, double from,
                                    double to) {
  std::vector<Station> stations;
  for (const double degree : places(from, to, section_step(cycle))) {
    const double q = radians(degree);
    stations.push_back(station_at(cycle, q, q, K + R * normal_at(q)));
  }
  return stations;
}

// Ridge: K = (0, -R), C = (R sin q, R cos q - R); groove: K = 0, C = (R sin q, -R cos q).
std::vector<Station> half_round_stations(const Cycle& cycle) {
  const bool is_ridge = cycle.family == Family::HalfConvex;
  const double limit = degrees(half_round_limit(cycle));
  std::vector<Station> stations;
  for (const double degree : places(-limit, limit, section_step(cycle))) {
    const double q = radians(degree);
    const double side = is_ridge ? -sign_of(degree) : sign_of(degree);
    const Vector2d C = is_ridge ? Vector2d(cycle.R * std::sin(q), cycle.R * std::cos(q) - cycle.R)
                                : Vector2d(cycle.R * std::sin(q), -cycle.R * std::cos(q));
    Station station = station_at(cycle, q, std::abs(q), C, side);
    station.param = q;
    station.reachable = is_ridge || degree * station.tip.x() >= 0;
    stations.push_back(station);
  }
  return stations;
}

std::vector<Station> r_taper_r_stations(const Cycle& cycle) {
  const RTaperRLengths lengths = r_taper_r(cycle);
  const double t = radians(cycle.angle);
  std::vector<Station> stations = round_stations(cycle, lengths.K1, cycle.R, 0, cycle.angle);
  const Vector2d begin = lengths.K1 + cycle.R * normal_at(t);
  const double lower_sign = cycle.lower == LowerRound::Concave ? -1 : 1;
  const Vector2d end = lengths.K2 + lower_sign * cycle.R2 * normal_at(t);
  const double length = (end - begin).norm();
  for (const double s : places(0, length, slope_step(cycle))) {
    if (s == 0) continue;  // the round ended there
    const Vector2d C = begin + s / length * (end - begin);
    stations.push_back(station_at(cycle, C.x(), t, C));
  }
  for (const Station& station : round_stations(cycle, lengths.K2, lower_sign * cycle.R2,
                                               cycle.angle, degrees(lengths.q_end))) {
    if (station.q != t) stations.push_back(station);
  }
  return stations;
}

}  // namespace

// tip_y = yc - r sin q - a, tip_z = zc + r cos q - r (U). On a half round the flank may be on
// either side: y is taken towards the side's own material.
Station station_at(const Cycle& cycle, double param, double q, const Vector2d& contact,
                   double side) {
  const double a = core_radius(cycle);
  const double across = side < 0 ? 1 : -1;
  Station station;
  station.param = param;
  station.q = q;
  station.contact = contact;
  station.normal = {across * std::sin(q), std::cos(q)};
  station.tip = {contact.x() + across * cycle.r * std::sin(q) + (side == 0 ? 0 : across * a),
                 contact.y() + cycle.r * std::cos(q) - cycle.r};
  return station;
}

std::vector<double> places(double from, double to, double step) {
  const double range = std::abs(to - from);
  const auto count = static_cast<int>(std::ceil(range / step - divides));
  const double direction = to < from ? -1 : 1;
  std::vector<double> result;
  result.reserve(static_cast<std::size_t>(count) + 1);
  for (int i = 0; i < count; ++i) result.push_back(from + direction * i * step);
  result.push_back(to);
  return result;
}

std::vector<Station> section_stations(const Cycle& cycle) {
  const double R = cycle.R;
  switch (cycle.family) {
    case Family::Taper:
      if (cycle.method == 2) return slope_stations(cycle);
      [[fallthrough]];
    case Family::ComplexSide: {
      if (cycle.family == Family::ComplexSide) return slope_stations(cycle);
      const double t = radians(cycle.angle);
      const double H = cycle.width * std::tan(t);
      return {station_at(cycle, cycle.width, t, {cycle.width, 0}),
              station_at(cycle, cycle.width / 2, t, {cycle.width / 2, -H / 2}),
              station_at(cycle, 0, t, {0, -H})};
    }
    case Family::CornerR:
    case Family::ComplexCornerR:
    case Family::HelicalCornerR: return round_stations(cycle, {R, -R}, R, 0, 90);
    case Family::BottomR: return round_stations(cycle, {-R, -cycle.depth + R}, -R, 90, 0);
    case Family::HalfConvex:
    case Family::HalfConcave: return half_round_stations(cycle);
    case Family::RTaperR: return r_taper_r_stations(cycle);
    default: return {};
  }
}

// (R + r) cos q0 = R + r + zf on a ridge with a floor at zf; 90 degrees in a groove.
double half_round_limit(const Cycle& cycle) {
  if (cycle.family == Family::HalfConcave) return pi / 2;
  const double floor = cycle.z_floor.value_or(-cycle.R);
  const double cosine = (cycle.R + cycle.r + floor) / (cycle.R + cycle.r);
  return std::acos(std::clamp(cosine, 0.0, 1.0));
}

double groove_reach(const Cycle& cycle) {
  const double a = core_radius(cycle);
  return a > 0 ? std::asin(a / (cycle.R - cycle.r)) : 0;
}

// t1 = R1 tan(t/2); concave foot t2 = R2 tan(t/2), K2 = (-t2, -H + R2); convex into the wall
// t2 = R2 tan((90 - t)/2), K2 = (R2, -H - t2). K1 = (w + t1, -R1).
RTaperRLengths r_taper_r(const Cycle& cycle) {
  const double t = radians(cycle.angle);
  RTaperRLengths lengths;
  lengths.H = cycle.width * std::tan(t);
  lengths.t1 = cycle.R * std::tan(t / 2);
  lengths.K1 = {cycle.width + lengths.t1, -cycle.R};
  if (cycle.lower == LowerRound::Concave) {
    lengths.t2 = cycle.R2 * std::tan(t / 2);
    lengths.K2 = {-lengths.t2, -lengths.H + cycle.R2};
    lengths.q_end = 0;
  } else {
    lengths.t2 = cycle.R2 * std::tan((pi / 2 - t) / 2);
    lengths.K2 = {cycle.R2, -lengths.H - lengths.t2};
    lengths.q_end = pi / 2;
  }
  return lengths;
}

// b = w - D/2 + h/tan t + r (1 - tan(t/2)), c = w tan t + r (1 - tan((90 - t)/2)); [003], straight
// taper (1).
TaperTriangle taper_triangle(const Cycle& cycle) {
  const double t = radians(cycle.angle);
  return {cycle.width - cycle.D / 2 + cycle.z_clear / std::tan(t) + cycle.r * (1 - std::tan(t / 2)),
          cycle.width * std::tan(t) + cycle.r * (1 - std::tan((pi / 2 - t) / 2))};
}

double radius_at(const Cycle& cycle, double y) {
  return cycle.side == WallSide::Outside ? cycle.R0 - y : cycle.R0 + y;
}

Vector3d placed(const Cycle& cycle, double along, const Vector2d& section) {
  if (cycle.edge == EdgeShape::Straight) {
    return {along, cycle.y_pos + section.x(), section.y()};
  }
  const double f = radians(along);
  const double rho = radius_at(cycle, section.x());
  return {cycle.centre.x() + rho * std::cos(f), cycle.centre.y() + rho * std::sin(f), section.y()};
}

Vector3d placed_direction(const Cycle& cycle, double along, const Vector2d& section) {
  if (cycle.edge == EdgeShape::Straight) return {0, section.x(), section.y()};
  const double f = radians(along);
  const double radial = cycle.side == WallSide::Outside ? -section.x() : section.x();
  return {radial * std::cos(f), radial * std::sin(f), section.y()};
}

}  // namespace ridgeline::macro
