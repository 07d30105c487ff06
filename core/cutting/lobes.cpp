#include "core/cutting/lobes.hpp"

#include <cmath>
#include <numbers>

namespace ridgeline::cutting {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

// Mean directional coefficients a_xx, a_xy, a_yx, a_yy: antiderivative at one angle.
struct Directional {
  double xx, xy, yx, yy;
};

Directional antiderivative(double phi, double K) {
  const double c = std::cos(2 * phi);
  const double s = std::sin(2 * phi);
  return {0.5 * (c - 2 * K * phi + K * s), 0.5 * (-s - 2 * phi + K * c),
          0.5 * (-s + 2 * phi + K * c), 0.5 * (-c - 2 * K * phi - K * s)};
}

// Is a deviation from the steady cut growing?
bool chatters(const Cut& cut, const Compliance& compliance, double S, Engaging engaging) {
  Deflections D(static_cast<std::size_t>(cut.samples), Eigen::Vector2d::Zero());
  if (engaging == Engaging::Moving) D = iterate(cut, compliance, S, {}).D;
  return std::abs(floquet_multiplier(cut, compliance, S, D, engaging)) > 1;
}

}  // namespace

// Eigenvalues l of [[a_xx Gx, a_xy Gy], [a_yx Gx, a_yy Gy]]:
//   depth = 2 pi / (z Kt Re l),  tooth period = (pi - 2 arg l + 2 pi k) / w.
std::vector<LobePoint> zeroth_order_lobes(const Compliance& compliance,
                                          const SteadyEngagement& engagement,
                                          const std::vector<double>& frequencies, int lobes) {
  const double K = engagement.Kr / engagement.Kt;
  const Directional in = antiderivative(engagement.entry, K);
  const Directional out = antiderivative(engagement.exit, K);
  std::vector<LobePoint> points;
  for (const double frequency : frequencies) {
    const Complex Gx = compliance_at(compliance.x, frequency);
    const Complex Gy = compliance_at(compliance.y, frequency);
    const Complex a = (out.xx - in.xx) * Gx;
    const Complex b = (out.xy - in.xy) * Gy;
    const Complex c = (out.yx - in.yx) * Gx;
    const Complex d = (out.yy - in.yy) * Gy;
    const Complex root = std::sqrt((a - d) * (a - d) / 4.0 + b * c);
    for (const Complex l : {(a + d) / 2.0 + root, (a + d) / 2.0 - root}) {
      if (!(l.real() > 0)) continue;
      LobePoint point{2 * pi / (engagement.teeth * engagement.Kt * l.real()), frequency, {}};
      const double phase = pi - 2 * std::arg(l);
      for (int k = 0; k < lobes; ++k) {
        const double turn = phase + 2 * pi * k;
        if (turn > 0) point.speeds.push_back(2 * pi * frequency / (turn * engagement.teeth));
      }
      points.push_back(std::move(point));
    }
  }
  return points;
}

std::optional<double> chatter_depth(const std::function<Cut(double depth)>& cut_of,
                                    const Compliance& compliance, double S,
                                    const DepthRange& depths, Engaging engaging) {
  const auto [from, to, steps] = depths;
  double stable = 0;
  for (int i = 0; i <= steps; ++i) {
    double depth = from + (to - from) * i / std::max(steps, 1);
    if (!chatters(cut_of(depth), compliance, S, engaging)) {
      stable = depth;
      continue;
    }
    for (int halving = 0; halving < 12 && i > 0; ++halving) {
      const double middle = (stable + depth) / 2;
      (chatters(cut_of(middle), compliance, S, engaging) ? depth : stable) = middle;
    }
    return depth;
  }
  return {};
}

}  // namespace ridgeline::cutting
