#include "core/cutting/compliance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/cutting/beam.hpp"
#include "core/cutting/iterate.hpp"
#include "core/cutting/modal_fit.hpp"
#include "tests/core/cutting/oracle_case.hpp"

namespace ridgeline::cutting {
namespace {

using std::numbers::pi;

// A limit with no other end says so.
TEST(LowPass, WhatWouldCutTheResonanceIsRefusedWithTheLeastAllowed) {
  const nlohmann::json file = oracle::file("01-ball-down-milling-1-groove.json");
  IterateOptions options;
  options.kappa = 0.01;
  try {
    iterate(oracle::cut(file["case"]), oracle::compliance(file["case"]), 100, options);
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadInput);
    EXPECT_EQ(error.details().limit.find("at least "), 0U) << error.details().limit;
    EXPECT_EQ(std::string(error.what()).find("e+308"), std::string::npos) << error.what();
  }
}

// Euler-Bernoulli cantilever of one radius: k = 3 E I / L^3, f1 = 1.8751^2 / (2 pi L^2) sqrt(E I /
// (rho A)); the first mode has 1 / 0.9707 of the static stiffness (4 / 1.8751^4 of the compliance).
TEST(Beam, UniformCantilever) {
  const double E = 600e3, rho = 14.5e-9, r = 2, L = 40;
  Beam beam;
  beam.parts = {{r, L}};
  const double EI = E * pi * std::pow(r, 4) / 4;
  const double roots[] = {1.8751040687, 4.6940911330, 7.8547574382};
  const BeamModes found = beam_modes(beam, 4);
  EXPECT_NEAR(found.static_stiffness, 3 * EI / (L * L * L), 1e-6 * found.static_stiffness);
  for (std::size_t i = 0; i < 3; ++i) {
    const double fn = roots[i] * roots[i] / (2 * pi * L * L) * std::sqrt(EI / (rho * pi * r * r));
    const double k = std::pow(roots[i], 4) / 4 * EI / (L * L * L);
    EXPECT_NEAR(found.modes[i].frequency, fn, 1e-3 * fn);
    EXPECT_NEAR(found.modes[i].stiffness, k, 1e-3 * k);
  }
}

TEST(Beam, ModesTogetherHaveTheStaticCompliance) {
  Beam beam;
  beam.parts = {{1.5, 20}, {3, 30}};
  beam.tip_mass = 1e-6;
  const BeamModes found = beam_modes(beam, 2);
  const double compliance = 1 / found.modes[0].stiffness + 1 / found.modes[1].stiffness;
  EXPECT_NEAR(compliance * found.static_stiffness, 1, 1e-12);
}

// Stepped cantilever by hand: slope and deflection of the lower part plus the upper one's own.
TEST(Beam, SteppedCantileverByHand) {
  const double E = 600e3, F = 1;
  const double r1 = 1.5, L1 = 20, r2 = 3, L2 = 30;
  const double I1 = pi * std::pow(r1, 4) / 4, I2 = pi * std::pow(r2, 4) / 4;
  const double at_step = F * std::pow(L2, 3) / (3 * E * I2) + F * L1 * L2 * L2 / (2 * E * I2);
  const double slope = F * L2 * L2 / (2 * E * I2) + F * L1 * L2 / (E * I2);
  const double tip = at_step + slope * L1 + F * std::pow(L1, 3) / (3 * E * I1);
  Beam beam;
  beam.parts = {{r1, L1}, {r2, L2}};
  EXPECT_NEAR(beam_modes(beam, 1).static_stiffness, F / tip, 1e-6 / tip);
}

// A slender tool decides the chamfer: 10 N on a carbide shank of 4 mm, 40 mm long, is 28 um.
TEST(Beam, FourMillimetreShankGives28Micrometres) {
  Beam beam;
  beam.parts = {{2, 40}};
  EXPECT_NEAR(10 / beam_modes(beam, 1).static_stiffness, 0.028, 0.001);
}

TEST(Beam, RefusesWhatIsNoBeam) {
  Beam beam;
  EXPECT_THROW(beam_modes(beam, 1), Error);
  beam.parts = {{0, 10}};
  EXPECT_THROW(beam_modes(beam, 1), Error);
}

MeasuredResponse measured(const Modes& modes, double noise) {
  MeasuredResponse out;
  for (int i = 0; i < 800; ++i) {
    const double f = 200 + 5 * i;
    const double wobble = 1 + noise * std::sin(12.9898 * i);
    out.frequency.push_back(f);
    out.value.push_back(compliance_at(modes, f) * wobble);
  }
  return out;
}

TEST(ModalFit, FindsTheModesOfTwoPeaks) {
  const Modes modes{{1100, 0.03, 2000}, {2600, 0.02, 9000}};
  const ModalFit fit = fit_modes(measured(modes, 0));
  ASSERT_EQ(fit.modes.size(), 2U);
  EXPECT_LT(fit.misfit, 1e-6);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(fit.modes[i].frequency, modes[i].frequency, 1e-3);
    EXPECT_NEAR(fit.modes[i].damping, modes[i].damping, 1e-6);
    EXPECT_NEAR(fit.modes[i].stiffness, modes[i].stiffness, 0.1);
  }
}

TEST(ModalFit, BearsAMeasurementsNoise) {
  const Modes modes{{1100, 0.03, 2000}};
  const ModalFit fit = fit_modes(measured(modes, 0.05));
  EXPECT_NEAR(fit.modes.front().frequency, 1100, 5);
  EXPECT_NEAR(fit.modes.front().stiffness, 2000, 60);
  EXPECT_LT(fit.misfit, 0.1);
}

TEST(ModalFit, RefusesAResponseWithoutAPeak) {
  MeasuredResponse flat;
  for (int i = 1; i < 50; ++i) {
    flat.frequency.push_back(10.0 * i);
    flat.value.emplace_back(1e-4, 0);
  }
  EXPECT_THROW(fit_modes(flat), Error);
}

}  // namespace
}  // namespace ridgeline::cutting
