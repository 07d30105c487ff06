#include "core/cutting/beam.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "core/cutting/require.hpp"

namespace ridgeline::cutting {
namespace {

using std::numbers::pi;

constexpr int elements_per_part = 12;

// Stiffness and mass of the beam; degrees of freedom: deflection and slope of each node, from the
// loaded point to the holder.
struct Matrices {
  Eigen::MatrixXd K;
  Eigen::MatrixXd M;
};

void add_element(const Beam& beam, double radius, double h, Eigen::Index at, Matrices& m) {
  const double area = pi * radius * radius;
  const double EI = beam.modulus * area * radius * radius / 4;
  const double mass = beam.density * area * h / 420;
  Eigen::Matrix4d k, c;
  k << 12, 6 * h, -12, 6 * h, 6 * h, 4 * h * h, -6 * h, 2 * h * h, -12, -6 * h, 12, -6 * h, 6 * h,
      2 * h * h, -6 * h, 4 * h * h;
  c << 156, 22 * h, 54, -13 * h, 22 * h, 4 * h * h, 13 * h, -3 * h * h, 54, 13 * h, 156, -22 * h,
      -13 * h, -3 * h * h, -22 * h, 4 * h * h;
  m.K.block<4, 4>(at, at) += EI / (h * h * h) * k;
  m.M.block<4, 4>(at, at) += mass * c;
}

Matrices matrices(const Beam& beam) {
  const auto nodes = static_cast<Eigen::Index>(beam.parts.size()) * elements_per_part + 1;
  Matrices m{Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes),
             Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes)};
  Eigen::Index at = 0;
  for (const BeamPart& part : beam.parts) {
    for (int i = 0; i < elements_per_part; ++i, at += 2) {
      add_element(beam, part.radius, part.length / elements_per_part, at, m);
    }
  }
  m.M(0, 0) += beam.tip_mass;
  const Eigen::Index last = 2 * nodes - 2;
  // The holder lets no slope through and, unless it is rigid, a deflection against its stiffness.
  Eigen::Index kept = last;
  if (beam.holder_stiffness > 0) {
    m.K(last, last) += beam.holder_stiffness;
    ++kept;
  }
  return {m.K.topLeftCorner(kept, kept), m.M.topLeftCorner(kept, kept)};
}

void validate(const Beam& beam) {
  require_between("/dynamics/beam", static_cast<double>(beam.parts.size()), 1, 16, "parts");
  for (const BeamPart& part : beam.parts) {
    require_between("/dynamics/beam/radius", part.radius, 0.01, 1e3, "mm");
    require_between("/dynamics/beam/length", part.length, 0.01, 1e4, "mm");
  }
  require_between("/dynamics/beam/modulus", beam.modulus, 1, 1e7, "N/mm2");
  require_between("/dynamics/beam/density", beam.density, 1e-12, 1e-6, "t/mm3");
  require_between("/dynamics/beam/damping", beam.damping, 1e-4, 0.9, "of critical damping");
  require_between("/dynamics/beam/holder_stiffness", beam.holder_stiffness, 0, 1e9, "N/mm");
}

}  // namespace

// K v = w^2 M v with v'Mv = 1: a mode's compliance at the loaded point is v_0^2 / w^2.
BeamModes beam_modes(const Beam& beam, int count) {
  validate(beam);
  const auto [K, M] = matrices(beam);
  const Eigen::VectorXd load = Eigen::VectorXd::Unit(K.rows(), 0);
  const Eigen::VectorXd at_rest = K.ldlt().solve(load);
  BeamModes out;
  out.static_stiffness = 1 / at_rest[0];
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, M);
  double left = at_rest[0];  // compliance that the modes so far do not give
  for (int i = 0; i < count; ++i) {
    const double w2 = solver.eigenvalues()[i];
    const double tip = solver.eigenvectors()(0, i);
    const double compliance = tip * tip / w2;
    const bool is_last = i + 1 == count;
    out.modes.push_back(
        {std::sqrt(w2) / (2 * pi), beam.damping, 1 / (is_last ? left : compliance)});
    left -= compliance;
  }
  return out;
}

}  // namespace ridgeline::cutting
