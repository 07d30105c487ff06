#include "tests/core/macro/cycle_section.hpp"

#include <cmath>

namespace ridgeline::macro {
namespace {

using Eigen::Vector2d;

constexpr double pi = 3.14159265358979323846;

void add_line(std::vector<Surface>& surface, const Vector2d& a, const Vector2d& b, bool is_worked,
              int count) {
  const Vector2d along = (b - a).normalized();
  for (int i = 0; i <= count; ++i) {
    surface.push_back(
        {a + static_cast<double>(i) / count * (b - a), {along.y(), -along.x()}, is_worked});
  }
}

void add_slope(std::vector<Surface>& surface, const Vector2d& a, const Vector2d& b, double step) {
  const Vector2d along = (b - a).normalized();
  const Vector2d normal(along.y(), -along.x());
  for (double s = 0; s < (b - a).norm(); s += step)
    surface.push_back({a + s * along, normal, true});
  surface.push_back({b, normal, true});
}

// K + side R n(q), n = (-sin q, cos q); side 1: convex, -1: concave. Degrees.
void add_round(std::vector<Surface>& surface, const Vector2d& K, double R, double from, double to,
               double side, double step) {
  const double direction = to > from ? 1 : -1;
  const auto add = [&](double degree) {
    const double q = degree * pi / 180;
    const Vector2d n(-std::sin(q), std::cos(q));
    surface.push_back({K + side * R * n, n, true});
  };
  for (int i = 0; i * step < std::abs(to - from); ++i) add(from + direction * i * step);
  add(to);
}

}  // namespace

// Design section 1.3, each family from its drawing. Lines run with the material on their right.
std::vector<Surface> ideal(const Cycle& c) {
  std::vector<Surface> s;
  const double t = c.angle * pi / 180, far = 4;
  // Parts of a step, so that the middle between two stations, where the cusp is, is looked at; that
  // of a flat tool is elsewhere.
  const bool is_helix = c.family == Family::HelicalCornerR;
  const double parts = c.r == 0 || is_helix ? 24 : 6;
  const double dq = (is_helix ? c.turn_step : *c.section_step) / parts;
  const double ds = *c.slope_step / parts;
  switch (c.family) {
    case Family::Taper:
    case Family::ComplexSide: {
      const double H = c.width * std::tan(t);
      add_line(s, {c.width + far, 0}, {c.width, 0}, false, 8);
      add_slope(s, {c.width, 0}, {0, -H}, ds);
      add_line(s, {0, -H}, {0, -H - far}, false, 8);
      break;
    }
    case Family::CornerR:
    case Family::ComplexCornerR:
    case Family::HelicalCornerR:
      add_line(s, {c.R + far, 0}, {c.R, 0}, false, 8);
      add_round(s, {c.R, -c.R}, c.R, 0, 90, 1, dq);
      add_line(s, {0, -c.R}, {0, -c.R - far}, false, 8);
      break;
    case Family::BottomR:
      add_line(s, {far, 0}, {0, 0}, false, 8);
      add_line(s, {0, 0}, {0, -c.depth + c.R}, false, 20);
      add_round(s, {-c.R, -c.depth + c.R}, c.R, 90, 0, -1, dq);
      add_line(s, {-c.R, -c.depth}, {-c.R - far, -c.depth}, false, 8);
      break;
    case Family::HalfConvex: {  // down to the foot that the corner radius leaves
      const double q0 = std::acos(c.r / (c.R + c.r)) * 180 / pi;
      add_round(s, {0, -c.R}, c.R, q0, -q0, 1, dq);
      break;
    }
    case Family::HalfConcave:
      add_line(s, {c.R + far, 0}, {c.R, 0}, false, 8);
      add_round(s, {0, 0}, c.R, 90, -90, -1, dq);
      break;
    case Family::HelicalSide:
      add_line(s, {far, 0}, {0, 0}, false, 8);
      add_line(s, {0, 0}, {0, -c.depth + c.r}, true, 60);
      break;
    case Family::RTaperR: {
      const double H = c.width * std::tan(t), t1 = c.R * std::tan(t / 2);
      add_round(s, {c.width + t1, -c.R}, c.R, 0, c.angle, 1, dq);
      const bool concave = c.lower == LowerRound::Concave;
      const double t2 = c.R2 * std::tan(concave ? t / 2 : (pi / 2 - t) / 2);
      const Vector2d K2 = concave ? Vector2d(-t2, -H + c.R2) : Vector2d(c.R2, -H - t2);
      add_slope(s, {c.width - t1 * std::cos(t), -t1 * std::sin(t)},
                {t2 * std::cos(t), -H + t2 * std::sin(t)}, ds);
      add_round(s, K2, c.R2, c.angle, concave ? 0 : 90, concave ? -1 : 1, dq);
      break;
    }
    default: break;
  }
  return s;
}

}  // namespace ridgeline::macro
