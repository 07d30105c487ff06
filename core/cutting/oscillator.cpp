#include "core/cutting/oscillator.hpp"

#include <cmath>
#include <numbers>

namespace ridgeline::cutting {

// x = (q, v). Under F0 + s t the motion is x_p(t) = ((F0 + s t - 2 zeta s / w) / k, s / k) and a
// free vibration on top: x(dt) = Phi (x(0) - x_p(0)) + x_p(dt), s = (F1 - F0) / dt.
StepMatrix step_matrix(const Mode& mode, double dt) {
  const double w = 2 * std::numbers::pi * mode.frequency;
  const double zeta = mode.damping;
  const double wd = w * std::sqrt(1 - zeta * zeta);
  const double fade = std::exp(-zeta * w * dt);
  const double c = fade * std::cos(wd * dt);
  const double s = fade * std::sin(wd * dt) / wd;
  StepMatrix m;
  m.qq = c + zeta * w * s;
  m.qv = s;
  m.vq = -w * w * s;
  m.vv = c - zeta * w * s;
  const double drift = 2 * zeta / (w * mode.stiffness * dt);  // of x_p(0) by F1, against F0
  const double slope = 1 / (mode.stiffness * dt);
  const double at_start = 1 / mode.stiffness + drift;
  m.q0 = -m.qq * at_start + m.qv * slope + drift;
  m.q1 = m.qq * drift - m.qv * slope + 1 / mode.stiffness - drift;
  m.v0 = -m.vq * at_start + m.vv * slope - slope;
  m.v1 = m.vq * drift - m.vv * slope + slope;
  return m;
}

Oscillator::Oscillator(const Modes& modes, double dt) {
  for (const Mode& mode : modes) modes_.push_back({step_matrix(mode, dt)});
}

double Oscillator::ahead(double F0, double F1) const {
  double sum = 0;
  for (const auto& [m, q, v] : modes_) sum += m.qq * q + m.qv * v + m.q0 * F0 + m.q1 * F1;
  return sum;
}

void Oscillator::step(double F0, double F1) {
  for (auto& [m, q, v] : modes_) {
    const double q_next = m.qq * q + m.qv * v + m.q0 * F0 + m.q1 * F1;
    v = m.vq * q + m.vv * v + m.v0 * F0 + m.v1 * F1;
    q = q_next;
  }
}

double Oscillator::displacement() const {
  double sum = 0;
  for (const State& mode : modes_) sum += mode.q;
  return sum;
}

}  // namespace ridgeline::cutting
