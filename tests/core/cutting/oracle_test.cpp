#include <gtest/gtest.h>

#include "tests/core/cutting/oracle_case.hpp"

namespace ridgeline::cutting {
namespace {

// Relative to the greatest value of the array: samples near zero carry no information.
constexpr double tolerance = 1e-9;

void expect_samples(const nlohmann::json& rows, int every, const auto& actual) {
  double greatest = 0;
  for (const auto& row : rows) {
    for (const auto& value : row) greatest = std::max(greatest, std::abs(value.get<double>()));
  }
  ASSERT_EQ(rows.size() * static_cast<std::size_t>(every), actual.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t c = 0; c < rows[i].size(); ++c) {
      EXPECT_NEAR(actual[i * static_cast<std::size_t>(every)][static_cast<Eigen::Index>(c)],
                  rows[i][c].get<double>(), tolerance * greatest)
          << "sample " << i << " component " << c;
    }
  }
}

class ErrorOracle : public testing::TestWithParam<const char*> {};

TEST_P(ErrorOracle, RigidAndIterationAgree) {
  const nlohmann::json file = oracle::file(GetParam());
  const Cut cut = oracle::cut(file["case"]);
  const Compliance compliance = oracle::compliance(file["case"]);
  const double S = file["speed_rpm"].get<double>() / 60;
  const int every = file["sample_every"].get<int>();

  const Prediction stiff = rigid(cut, compliance, S, Span::Revolution);
  EXPECT_NEAR(*stiff.e, file["rigid"]["e_mm"].get<double>(), tolerance * std::abs(*stiff.e));
  EXPECT_EQ(stiff.cut_points, file["rigid"]["cut_points"]);
  EXPECT_NEAR(stiff.contact_time, file["rigid"]["tc_s"].get<double>(), 1e-15);
  expect_samples(file["rigid"]["F"], every, stiff.F);
  expect_samples(file["rigid"]["D"], every, stiff.D);

  Deflections start;
  if (file.contains("warm_from")) {
    const nlohmann::json& before = file["warm_from"];
    start = iterate(oracle::cut(before["case"]), oracle::compliance(before["case"]),
                    before["speed_rpm"].get<double>() / 60, oracle::options(before["options"]))
                .D;
  }
  const nlohmann::json& expected = file["iterate"];
  const Prediction actual = iterate(cut, compliance, S, oracle::options(file["options"]), start);
  EXPECT_EQ(actual.loops, expected["loops"]);
  EXPECT_EQ(actual.converged, expected["converged"]);
  EXPECT_EQ(actual.w1, expected["w1_final"]);
  EXPECT_EQ(actual.weight_changes.size(), expected["weight_changes"].size());
  EXPECT_NEAR(*actual.e, expected["e_mm"].get<double>(), tolerance * std::abs(*actual.e));
  ASSERT_EQ(actual.A.size(), expected["A"].size());
  for (std::size_t i = 0; i < actual.A.size(); ++i) {
    EXPECT_NEAR(actual.A[i], expected["A"][i].get<double>(), tolerance * actual.A[i]);
    EXPECT_NEAR(*actual.e_history[i], expected["e_hist"][i].get<double>(),
                tolerance * std::abs(*actual.e_history[i]));
  }
  expect_samples(expected["F"], every, actual.F);
  expect_samples(expected["D"], every, actual.D);
}

INSTANTIATE_TEST_SUITE_P(Files, ErrorOracle, testing::ValuesIn(oracle::cases));

}  // namespace
}  // namespace ridgeline::cutting
