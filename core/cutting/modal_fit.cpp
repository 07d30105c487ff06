#include "core/cutting/modal_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/text.hpp"

namespace ridgeline::cutting {
namespace {

using Complex = std::complex<double>;

// Response of one mode of unit compliance.
Complex unit_mode(double frequency, double fn, double zeta) {
  const double ratio = frequency / fn;
  return 1.0 / Complex(1 - ratio * ratio, 2 * zeta * ratio);
}

// Real and imaginary parts one below the other.
Eigen::VectorXd stacked(const std::vector<Complex>& values) {
  const auto n = static_cast<Eigen::Index>(values.size());
  Eigen::VectorXd out(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    out[i] = values[static_cast<std::size_t>(i)].real();
    out[n + i] = values[static_cast<std::size_t>(i)].imag();
  }
  return out;
}

Eigen::MatrixXd basis(const MeasuredResponse& measured, const Eigen::VectorXd& shape) {
  const Eigen::Index modes = shape.size() / 2;
  Eigen::MatrixXd columns(2 * static_cast<Eigen::Index>(measured.frequency.size()), modes);
  for (Eigen::Index m = 0; m < modes; ++m) {
    std::vector<Complex> column;
    for (const double f : measured.frequency) {
      column.push_back(unit_mode(f, std::exp(shape[2 * m]), std::exp(shape[2 * m + 1])));
    }
    columns.col(m) = stacked(column);
  }
  return columns;
}

// What is left of the measurement beyond the best compliances for these frequencies and dampings
// (logarithms, in pairs): variable projection.
struct Projected {
  Eigen::VectorXd compliance;
  Eigen::VectorXd residual;
};

Projected project(const MeasuredResponse& measured, const Eigen::VectorXd& G,
                  const Eigen::VectorXd& shape) {
  const Eigen::MatrixXd columns = basis(measured, shape);
  const Eigen::VectorXd compliance = columns.colPivHouseholderQr().solve(G);
  return {compliance, G - columns * compliance};
}

// Peaks and their half-power widths.
Eigen::VectorXd first_shape(const MeasuredResponse& measured) {
  const auto& [lines, values] = measured;
  std::vector<double> shape;
  for (const double fn : natural_frequencies({measured, Modes{}, Eigen::Matrix2d::Identity()})) {
    const auto top =
        static_cast<std::size_t>(std::find(lines.begin(), lines.end(), fn) - lines.begin());
    const double half_power = std::abs(values[top]) / std::sqrt(2.0);
    std::size_t low = top, high = top;
    while (low > 0 && std::abs(values[low]) > half_power) --low;
    while (high + 1 < lines.size() && std::abs(values[high]) > half_power) ++high;
    const double zeta = std::clamp((lines[high] - lines[low]) / (2 * fn), 1e-3, 0.3);
    shape.insert(shape.end(), {std::log(fn), std::log(zeta)});
  }
  return Eigen::Map<const Eigen::VectorXd>(shape.data(), static_cast<Eigen::Index>(shape.size()));
}

// Levenberg-Marquardt on the logarithms, derivative by differences.
Eigen::VectorXd refined(const MeasuredResponse& measured, const Eigen::VectorXd& G,
                        Eigen::VectorXd shape) {
  constexpr int most_steps = 60;
  constexpr double difference = 1e-6;
  double damping = 1e-3;
  Eigen::VectorXd residual = project(measured, G, shape).residual;
  for (int step = 0; step < most_steps && damping < 1e9; ++step) {
    Eigen::MatrixXd slope(residual.size(), shape.size());
    for (Eigen::Index i = 0; i < shape.size(); ++i) {
      Eigen::VectorXd moved = shape;
      moved[i] += difference;
      slope.col(i) = (project(measured, G, moved).residual - residual) / difference;
    }
    Eigen::MatrixXd normal = slope.transpose() * slope;
    normal.diagonal() *= 1 + damping;
    const Eigen::VectorXd change = normal.ldlt().solve(-slope.transpose() * residual);
    const Eigen::VectorXd next = shape + change.cwiseMax(-0.5).cwiseMin(0.5);
    const Eigen::VectorXd next_residual = project(measured, G, next).residual;
    if (!(next_residual.norm() < residual.norm())) {
      damping *= 10;
      continue;
    }
    const bool done = next_residual.norm() > residual.norm() * (1 - 1e-10);
    shape = next;
    residual = next_residual;
    damping /= 10;
    if (done) break;
  }
  return shape;
}

}  // namespace

ModalFit fit_modes(const MeasuredResponse& measured) {
  constexpr double worst = 1.0 / 3;
  const Eigen::VectorXd start = first_shape(measured);
  if (start.size() == 0) {
    throw Error(ErrorCode::NotConverged, "frf: the response has no peak to fit a mode to");
  }
  const Eigen::VectorXd G = stacked(measured.value);
  const Eigen::VectorXd shape = refined(measured, G, start);
  const Projected fit = project(measured, G, shape);
  ModalFit out;
  out.misfit = fit.residual.norm() / G.norm();
  for (Eigen::Index m = 0; m < fit.compliance.size(); ++m) {
    if (!(fit.compliance[m] > 0)) continue;  // not a driving-point mode: noise
    out.modes.push_back(
        {std::exp(shape[2 * m]), std::exp(shape[2 * m + 1]), 1 / fit.compliance[m]});
  }
  if (out.modes.empty() || !(out.misfit <= worst)) {
    throw Error(ErrorCode::NotConverged, "frf: the fitted modes miss the response by " +
                                             text(100 * out.misfit) + " % rms, allowed 33 %");
  }
  return out;
}

bool is_measured(const Compliance& compliance) {
  return std::holds_alternative<MeasuredResponse>(compliance.x) ||
         std::holds_alternative<MeasuredResponse>(compliance.y);
}

Compliance with_modes(const Compliance& compliance) {
  Compliance out = compliance;
  for (Direction* direction : {&out.x, &out.y}) {
    const auto* measured = std::get_if<MeasuredResponse>(direction);
    if (measured != nullptr) *direction = fit_modes(*measured).modes;
  }
  return out;
}

}  // namespace ridgeline::cutting
