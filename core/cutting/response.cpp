#include "core/cutting/response.hpp"

#include <kissfft/kissfft.hh>
#include <limits>

namespace ridgeline::cutting {

using Complex = std::complex<double>;

struct Response::Plan {
  std::size_t samples;
  double repetition;
  kissfft<double> forward;
  kissfft<double> inverse;
  std::vector<Complex> Gx, Gy;  // bins 0 .. samples / 2
  std::vector<Complex> time, bins;
  Eigen::Matrix2d axes = Eigen::Matrix2d::Identity();
};

Response::Response(const Compliance& compliance, int samples, double repetition)
    : plan_(new Plan{static_cast<std::size_t>(samples),
                     repetition,
                     {static_cast<std::size_t>(samples), false},
                     {static_cast<std::size_t>(samples), true},
                     {},
                     {},
                     std::vector<Complex>(static_cast<std::size_t>(samples)),
                     std::vector<Complex>(static_cast<std::size_t>(samples)),
                     compliance.axes}) {
  const std::size_t last = plan_->samples / 2;
  for (std::size_t k = 0; k <= last; ++k) {
    const double frequency = static_cast<double>(k) * repetition;
    plan_->Gx.push_back(compliance_at(compliance.x, frequency));
    plan_->Gy.push_back(compliance_at(compliance.y, frequency));
    const bool is_its_own_mirror = k == 0 || 2 * k == plan_->samples;  // Nyquist: real part
    if (is_its_own_mirror) {
      plan_->Gx.back() = plan_->Gx.back().real();
      plan_->Gy.back() = plan_->Gy.back().real();
    }
  }
}

Response::~Response() = default;
Response::Response(Response&&) noexcept = default;
Response& Response::operator=(Response&&) noexcept = default;

void Response::turn(const Eigen::Matrix2d& axes) {
  plan_->axes = axes;
}

Deflections Response::deflections(const Forces& forces) const {
  return deflections(forces, std::numeric_limits<double>::infinity());
}

// Both directions in one complex transform: z = Fx + i Fy. With Z_k and Z_-k of a bin,
// Fx_k = (Z_k + conj Z_-k) / 2, Fy_k = (Z_k - conj Z_-k) / 2i, and back the same way.
Deflections Response::deflections(const Forces& forces, double cutoff) const {
  Plan& plan = *plan_;
  const std::size_t n = plan.samples;
  const Complex i(0, 1);
  for (std::size_t s = 0; s < n; ++s) {
    const Eigen::Vector2d F = plan.axes.transpose() * forces[s].head<2>();
    plan.time[s] = {F.x(), F.y()};
  }
  plan.forward.transform(plan.time.data(), plan.bins.data());
  for (std::size_t k = 0; 2 * k <= n; ++k) {
    const std::size_t mirror = k == 0 ? 0 : n - k;
    const bool passes = static_cast<double>(k) * plan.repetition <= cutoff;
    const Complex Z = plan.bins[k];
    const Complex Zm = std::conj(plan.bins[mirror]);
    const Complex Dx = passes ? plan.Gx[k] * (0.5 * (Z + Zm)) : 0.0;
    const Complex Dy = passes ? plan.Gy[k] * (-0.5 * i * (Z - Zm)) : 0.0;
    plan.bins[k] = Dx + i * Dy;
    plan.bins[mirror] = std::conj(Dx) + i * std::conj(Dy);
  }
  plan.inverse.transform(plan.bins.data(), plan.time.data());
  Deflections out(n);
  const double scale = 1 / static_cast<double>(n);
  for (std::size_t s = 0; s < n; ++s) {
    out[s] = plan.axes * Eigen::Vector2d(plan.time[s].real() * scale, plan.time[s].imag() * scale);
  }
  return out;
}

}  // namespace ridgeline::cutting
