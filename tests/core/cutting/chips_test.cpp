#include "core/cutting/chips.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <random>

#include "core/cutting/chip_force.hpp"
#include "core/cutting/force.hpp"
#include "tests/core/cutting/oracle_case.hpp"

namespace ridgeline::cutting {
namespace {

using std::numbers::pi;

// Every chip of every element: a reach beyond the tool leaves nothing out.
ChipTable whole_table(const Cut& cut) {
  return chip_table(cut, {10 * cut.cutter.r});
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
    EXPECT_EQ(chip_table(cut, {reach}).teeth[0].chips.size(), expected);
  }
}

// A vibration with some harmonics, and another within `reach` of it.
struct Vibration {
  Deflections centre, near;
};
Vibration vibration(int samples, double reach, std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  Vibration out;
  std::vector<Eigen::Vector4d> parts;
  for (int k = 0; k < 12; ++k)
    parts.emplace_back(0.02 * Eigen::Vector4d(any(random), any(random), any(random), any(random)));
  for (int i = 0; i < samples; ++i) {
    Eigen::Vector2d U = Eigen::Vector2d::Zero();
    for (int k = 0; k < 12; ++k) {
      const double at = 2 * pi * k * i / samples;
      U += std::cos(at) * parts[static_cast<std::size_t>(k)].head<2>() +
           std::sin(at) * parts[static_cast<std::size_t>(k)].tail<2>();
    }
    const double angle = pi * any(random);
    out.centre.push_back(U);
    out.near.push_back(U + 0.999 * reach * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return out;
}

// Chips that the narrower search leaves out, or takes for inside the stock, would change the force.
TEST(Chips, RoundADeflectionNoneThatCutsIsLost) {
  std::mt19937_64 random(6);
  std::vector<Cut> cuts;
  for (const char* name :
       {"01-ball-down-milling-1-groove.json", "03-ball-third-pass-low-pass-kappa-2.json",
        "09-square-down-milling-helix-5.json",
        "11-extensions-stock-limited-chip-3-earlier-teeth.json"})
    cuts.push_back(oracle::cut(oracle::file(name)["case"]));
  Cut tip = cuts.front();  // with its lowest elements in the stock, and beyond its equator
  tip.n = {0, 0, 1};
  tip.stock.grooves.clear();
  tip.stock.faces = {HalfSpace{tip.n, 0.23 - tip.cutter.r}};
  tip.cutter.q_end = 2.5;
  cuts.push_back(tip);
  for (const double phi : {-0.6, 0.9}) {  // down and up, with more feed and lead
    Cut steep = cuts.front();
    steep.phi = phi;
    steep.feed = 0.5;
    steep.cutter.helix = phi;
    steep.cutter.lag = phi > 0 ? LagLaw::ConstantLead : LagLaw::Tangent;
    steep.stock.grooves.clear();
    const Eigen::Vector3d fd = feed_direction(steep);
    steep.n = (steep.n - steep.n.dot(fd) * fd).normalized();
    steep.stock.faces = {HalfSpace{steep.n, 0.23 - steep.cutter.r}};
    cuts.push_back(steep);
  }
  for (const Combine combine : {Combine::All, Combine::Any}) {
    Cut wedge = cuts.front();
    wedge.stock.combine = combine;
    wedge.stock.grooves.clear();
    wedge.stock.faces.emplace_back(HalfSpace{{0.6, 0, 0.8}, -0.8});
    cuts.push_back(wedge);
  }
  for (const double side : {-1, 1}) {  // a groove on either hand, level and climbing
    Cut beside = cuts.front();
    beside.phi = side > 0 ? 0 : 0.2;
    const Eigen::Vector3d across = feed_direction(beside).cross(beside.n);
    beside.stock.grooves = {{0.3 * side * across, feed_direction(beside), beside.cutter.r}};
    cuts.push_back(beside);
  }
  int cutting = 0;
  for (const Cut& cut : cuts) {
    const ChipTable wide = chip_table(cut, {0.4});
    for (const double reach : {0.005, 0.0}) {
      SCOPED_TRACE(cutting);
      const auto [centre, near] = vibration(cut.samples / teeth(cut.cutter), reach, random);
      const ChipTable narrow = chip_table(cut, {reach, centre});
      EXPECT_LT(narrow.teeth[0].chips.size(), wide.teeth[0].chips.size());
      const Revolution expected = revolution_force(wide, near, Span::Pitch);
      const Revolution found = revolution_force(narrow, near, Span::Pitch);
      EXPECT_LT(greatest_deflection(cut, near), wide.around.reach);
      EXPECT_EQ(found.cut_points, expected.cut_points);
      EXPECT_EQ(found.F, expected.F);
      EXPECT_GT(expected.cut_points, 100);
      ++cutting;
    }
  }
  EXPECT_EQ(cutting, 22);
}

// What a rigid tool cuts, with nothing round it and no angle of the tooth before.
TEST(Chips, TheTableOfAStillToolIsWhatItCuts) {
  const Cut cut = oracle::cut(oracle::file("03-ball-third-pass-low-pass-kappa-2.json")["case"]);
  const ChipTable wide = chip_table(cut, {0.02});
  const ChipTable least = chip_table(cut, {.reach = 0, .is_still = true});
  const Deflections none(static_cast<std::size_t>(cut.samples), Eigen::Vector2d::Zero());
  const Revolution expected = revolution_force(wide, none, Span::Revolution);
  const Revolution found = revolution_force(least, none, Span::Revolution);
  EXPECT_EQ(found.F, expected.F);
  EXPECT_EQ(found.cut_points, expected.cut_points);
  EXPECT_EQ(found.cut.size(), static_cast<std::size_t>(found.cut_points));
  EXPECT_LT(found.cut.size(), expected.cut.size());
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
