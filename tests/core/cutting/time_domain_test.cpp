#include "core/cutting/time_domain.hpp"

#include <gtest/gtest.h>

#include "tests/core/cutting/oracle_case.hpp"

namespace ridgeline::cutting {
namespace {

class TimeDomainOracle : public testing::TestWithParam<const char*> {};

// The oracle prints e to 1e-9 mm, D to 1e-11 mm and stops after the same revolution.
TEST_P(TimeDomainOracle, EveryDigitAgrees) {
  const nlohmann::json file = oracle::file(GetParam());
  const nlohmann::json& runs = file["time_domain (same N, FOH, 1 corrector, tol 1e-8)"];
  const Compliance compliance = oracle::compliance(file["case"]);
  const double S = file["speed_rpm"].get<double>() / 60;
  for (const int earlier_teeth : {1, 3}) {
    SCOPED_TRACE(earlier_teeth);
    Cut cut = oracle::cut(file["case"]);
    cut.earlier_teeth = earlier_teeth;
    const nlohmann::json& expected = runs[earlier_teeth == 1 ? "npast1" : "npast3"];
    const TimeDomain actual = time_domain(cut, compliance, S, {});
    EXPECT_NEAR(*actual.e, expected["e_mm"].get<double>(), 5.1e-10);
    EXPECT_EQ(actual.revolutions, expected["revs"]);
    EXPECT_NEAR(actual.change.back(), expected["rel"].get<double>(),
                0.01 * expected["rel"].get<double>());
    if (expected["D"].is_null()) continue;
    const auto every = file["sample_every"].get<std::size_t>();
    for (std::size_t i = 0; i < expected["D"].size(); ++i) {
      EXPECT_NEAR(actual.D[i * every].x(), expected["D"][i][0].get<double>(), 1e-11);
      EXPECT_NEAR(actual.D[i * every].y(), expected["D"][i][1].get<double>(), 1e-11);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Files, TimeDomainOracle, testing::ValuesIn(oracle::cases));

// Design page, section 4: base case, third pass. (1) 13700 rev/min flips, (2) a soft square mill at
// 6000 rev/min never settles, though the iteration converges there in 5 loops.
TEST(Stability, SeesWhatTheIterationCannot) {
  const nlohmann::json file = oracle::file("06-warm-start-from-pass-2.json");
  const Compliance soft = oracle::compliance(file["case"]);
  Cut cut = oracle::cut(file["case"]);
  cut.samples = 1024;
  cut.feed = 0.1;
  EXPECT_EQ(stability(cut, soft, 13700 / 60.0), Stability::Flip);
  EXPECT_EQ(stability(cut, soft, 8000 / 60.0), Stability::Stable);
  EXPECT_EQ(stability(cut, soft, 4400 / 60.0), Stability::Unstable);

  const nlohmann::json square = oracle::file("09-square-down-milling-helix-5.json");
  const Cut slot = oracle::cut(square["case"]);
  const Modes modes{{900, 0.03, 5000}};
  const Prediction fixed_point = iterate(slot, {modes, modes}, 100, {});
  EXPECT_TRUE(fixed_point.converged);
  EXPECT_EQ(fixed_point.loops, 5);
  EXPECT_EQ(stability(slot, {modes, modes}, 100), Stability::Unstable);
}

}  // namespace
}  // namespace ridgeline::cutting
