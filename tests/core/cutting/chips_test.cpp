#include "core/cutting/chips.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/cutting/chip_force.hpp"
#include "tests/core/cutting/oracle_case.hpp"

namespace ridgeline::cutting {
namespace {

using std::numbers::pi;

// Every chip of every element: a reach beyond the tool leaves nothing out.
ChipTable whole_table(const Cut& cut) {
  return chip_table(cut, 10 * cut.cutter.r);
}

// Chip of one tooth at one sample and element: all elements are there, in order.
const Chip& chip_at(const ChipTable& table, int tooth, int sample, int element) {
  const int N = table.cut.samples;
  const int row = (sample + tooth * table.pitch_samples) % N;
  const ToothChips& chips = table.teeth[0];
  const auto first = static_cast<std::size_t>(chips.first[static_cast<std::size_t>(row)]);
  return chips.chips[first + static_cast<std::size_t>(element)];
}

// Equations (6), (7), (11), (13) and the force directions against the printed values of the oracle.
TEST(Chips, UnitValuesOfTheOracle) {
  const nlohmann::json file = oracle::file("unit-values.json");
  const Cut cut = oracle::cut(file["case"]);
  const ChipTable table = whole_table(cut);
  const double width = cut.cutter.r * pi / 2 / cut.cutter.elements;
  int values = 0;
  for (const nlohmann::json& value : file["values"]) {
    SCOPED_TRACE(++values);
    const int tooth = value["tooth"].get<int>();
    const int sample = value["theta_index"].get<int>();
    const Chip& chip = chip_at(table, tooth, sample, value["element"].get<int>());
    const Eigen::Vector3d N = oracle::vector(value["N"]);
    EXPECT_LT((chip.N - N).norm(), 1e-14);
    EXPECT_NEAR(chip.N.dot(feed_direction(cut)), value["b"].get<double>(), 1e-14);
    EXPECT_NEAR(chip.earlier.ts, value["t_s"].get<double>(), 1e-14);
    double theta_o = (sample - chip.earlier.delay) * 2 * pi / cut.samples;
    if (theta_o < 0) theta_o += 2 * pi;
    EXPECT_NEAR(theta_o, value["theta_o_0_2pi"].get<double>(), 1e-13);
    const auto& k = cut.coefficients;
    const Eigen::Vector3d per_thickness = k.Ktc * oracle::vector(value["e_t"]) +
                                          k.Krc * oracle::vector(value["e_r"]) +
                                          k.Kac * oracle::vector(value["e_a"]);
    EXPECT_LT((chip.Fc - width * per_thickness).norm(), 1e-12);
  }
  EXPECT_EQ(values, static_cast<int>(file["values"].size()));
}

// Can this chip be engaged and cut by a deflection on the circle of the reach, tried all round?
bool can_cut(const ChipTable& table, std::size_t index, double reach) {
  constexpr int directions = 720;
  const ToothChips& tooth = table.teeth[0];
  const ChipPlace at{&tooth, index, table.curves.size(), 0};
  const Chip& chip = tooth.chips[index];
  if (chip.earlier.ts + 2 * reach * chip.N.head<2>().norm() <= 0) return false;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * pi * i / directions;
    if (is_engaged(table, at, reach * Eigen::Vector2d(std::cos(angle), std::sin(angle))))
      return true;
  }
  return false;
}

// The search by angle windows finds what a look at every element and sample finds.
TEST(Chips, WindowsLoseNoChip) {
  constexpr double reach = 0.02;
  for (const char* name :
       {"01-ball-down-milling-1-groove.json", "09-square-down-milling-helix-5.json"}) {
    SCOPED_TRACE(name);
    const Cut cut = oracle::cut(oracle::file(name)["case"]);
    const ChipTable whole = whole_table(cut);
    std::size_t expected = 0;
    for (std::size_t i = 0; i < whole.teeth[0].chips.size(); ++i) {
      expected += can_cut(whole, i, reach) ? 1U : 0U;
    }
    EXPECT_GT(expected, 100U);
    EXPECT_EQ(chip_table(cut, reach).teeth[0].chips.size(), expected);
  }
}

// Unequal pitch: each tooth's chip is proportional to the angle to the tooth before it, and the
// teeth together remove the feed of one revolution.
TEST(Chips, UnequalPitchSharesTheFeed) {
  Cut cut = oracle::cut(oracle::file("01-ball-down-milling-1-groove.json")["case"]);
  cut.stock.grooves.clear();
  cut.cutter.helix = 0;
  cut.cutter.pitch = {1.9 * pi / 3, 2 * pi - 1.9 * pi / 3};
  const ChipTable table = whole_table(cut);
  ASSERT_EQ(table.teeth.size(), 2U);
  const int element = 200;
  const auto deepest = [&](std::size_t tooth) {
    double most = 0;
    for (int i = 0; i < cut.samples; ++i) {
      const auto first =
          static_cast<std::size_t>(table.teeth[tooth].first[static_cast<std::size_t>(i)]);
      most = std::max(most, table.teeth[tooth].chips[first + element].earlier.ts);
    }
    return most;
  };
  EXPECT_NEAR(deepest(0) / deepest(1), 1.9 / (6 - 1.9), 2e-3);
  EXPECT_NEAR(deepest(0) + deepest(1), 2 * cut.feed * std::sin(200.5 * pi / 512), 2e-3);
}

}  // namespace
}  // namespace ridgeline::cutting
