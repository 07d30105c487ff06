// Benchmarks of others: closed forms, exact series, a collocation solution of the delay equation.
#include <gtest/gtest.h>

#include <cmath>

#include "core/cutting/floquet.hpp"
#include "core/cutting/lobes.hpp"
#include "core/cutting/predict.hpp"
#include "tests/core/cutting/oracle_case.hpp"

namespace ridgeline::cutting {
namespace {

Cut square_cut(double r, int z, double depth, double immersion) {
  Cut cut;
  cut.cutter.kind = CutterKind::Square;
  cut.cutter.r = r;
  cut.cutter.pitch = equal_pitch(z);
  cut.cutter.elements = 1;
  cut.cutter.height = depth;
  cut.n = {-1, 0, 0};  // down-milling: material on the side of +X
  cut.stock.faces = {HalfSpace{cut.n, immersion - r}};
  return cut;
}

// |mu| per tooth of Insperger's slotting system and of the same in two equal directions, by
// Chebyshev collocation with 60 and 90 points, which agree to 1e-11.
struct Multiplier {
  const char* name;
  double immersion;  // of the diameter
  double rpm;
  double depth;  // mm
  double one;    // flexible along the feed
  double two;    // in both directions
};

void PrintTo(const Multiplier& row, std::ostream* out) {
  *out << row.name;
}

class DownMilling : public testing::TestWithParam<Multiplier> {};

TEST_P(DownMilling, MultiplierOfTheDelayEquation) {
  const auto& [name, immersion, rpm, depth, one, two] = GetParam();
  constexpr double r = 10;
  Cut cut = square_cut(r, 2, depth, 2 * r * immersion);
  cut.coefficients = {600, 0, 200, 0, 0, 0};
  cut.feed = 1e-5;
  cut.samples = 8192;
  const Modes mode{{922, 0.011, 1340.049648}};
  const Deflections at_rest(4096, Eigen::Vector2d::Zero());
  const double S = rpm / 60;
  const auto multiplier = [&](const Compliance& compliance) {
    return std::abs(floquet_multiplier(cut, compliance, S, at_rest, Engaging::Frozen));
  };
  EXPECT_NEAR(multiplier({Modes{}, mode, Eigen::Matrix2d::Identity()}), one, 2e-3 * one);
  EXPECT_NEAR(multiplier({mode, mode, Eigen::Matrix2d::Identity()}), two, 2e-3 * two);
}

INSTANTIATE_TEST_SUITE_P(
    Table, DownMilling,
    testing::Values(Multiplier{"Slot5000", 1, 5000, 0.3, 0.907377640, 3.022284535},
                    Multiplier{"Slot10000", 1, 10000, 1, 1.232469219, 4.313453463},
                    Multiplier{"Half8000", 0.5, 8000, 0.5, 0.898765711, 1.587157577},
                    Multiplier{"Tenth9000", 0.1, 9000, 1, 0.897328630, 0.759015625},
                    Multiplier{"Tenth15000", 0.1, 15000, 2, 0.629756032, 1.053131125},
                    Multiplier{"Twentieth10000", 0.05, 10000, 2, 0.527087036, 1.045779301},
                    Multiplier{"Twentieth6000", 0.05, 6000, 1, 0.673135912, 0.906350485}),
    [](const auto& row) { return row.param.name; });

// Mean force of a slot, closed form: Fx = -(z ap/4 Ktc f + z ap/pi Kte), Fy likewise with Kr, Fz =
// -(z ap/pi Kac f + z ap/2 Kae). (17) is circular, not f sin theta: a few tenths of a per cent.
TEST(Benchmark, MeanForceOfASlot) {
  Cut cut = square_cut(5, 4, 3, 10);
  cut.cutter.elements = 64;
  cut.cutter.helix = 0.5;  // of no influence on the mean of a slot
  cut.coefficients = {796.1, 27.7, 168.8, 30.8, 222, 1.4};
  cut.feed = 0.05;
  const Compliance stiff{Modes{}, Modes{}, Eigen::Matrix2d::Identity()};
  const Prediction result = rigid(cut, stiff, 100, Span::Revolution);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& F : result.F) mean += F / static_cast<double>(result.F.size());
  EXPECT_NEAR(mean.x(), -225.221206, 0.004 * 225);
  EXPECT_NEAR(mean.y(), -142.967334, 0.004 * 143);
  EXPECT_NEAR(mean.z(), -50.798877, 0.006 * 51);
}

// Surface location error of a rigid chip, X one mode, Y rigid: U.n where the edge passes the wall,
// by the exact series and by an independent program with 1024 samples.
struct Location {
  const char* name;
  double rpm;
  double down, up;                  // series [um]
  double down_sampled, up_sampled;  // 1024 samples [um]
};

void PrintTo(const Location& row, std::ostream* out) {
  *out << row.name;
}

class SurfaceLocation : public testing::TestWithParam<Location> {};

TEST_P(SurfaceLocation, RigidChipOverOneMode) {
  const Location row = GetParam();
  const Compliance one{Modes{{900, 0.02, 4000}}, Modes{}, Eigen::Matrix2d::Identity()};
  Cut cut = square_cut(5, 2, 2, 0.5);
  cut.coefficients = {800, 0, 240, 0, 0, 0};
  cut.feed = 0.1;
  const auto at_wall = [&](std::size_t sample) {
    const Prediction result = rigid(cut, one, row.rpm / 60, Span::Revolution);
    const double location = 1e3 * result.D[sample].dot(cut.n.head<2>());
    EXPECT_LE(*result.e * 1e3, location + 1e-9);  // the least of the whole arc
    return location;
  };
  const double down = at_wall(512);
  EXPECT_NEAR(down, row.down_sampled, 1e-6);
  EXPECT_NEAR(down, row.down, 0.01);
  cut.n = {1, 0, 0};  // up-milling: the wall is passed at theta = 0
  cut.stock.faces = {HalfSpace{cut.n, 0.5 - cut.cutter.r}};
  const double up = at_wall(0);
  EXPECT_NEAR(up, row.up_sampled, 1e-6);
  EXPECT_NEAR(up, row.up, 0.004);
}

INSTANTIATE_TEST_SUITE_P(
    Table, SurfaceLocation,
    testing::Values(Location{"At4000", 4000, -9.501946, 1.456478, -9.504071, 1.453018},
                    Location{"At6000", 6000, 1.843753, 0.820885, 1.846554, 0.820503},
                    Location{"At9000", 9000, 34.586788, 0.105775, 34.584444, 0.105443},
                    Location{"At13500", 13500, 36.821962, 1.596104, 36.813309, 1.594173}),
    [](const auto& row) { return row.param.name; });

// Least stable depth of a two-flute end mill of 31.75 mm, zeroth order: modes and coefficients as
// published with the program that was the source of the figures.
struct LeastDepth {
  const char* name;
  double entry, exit;  // rad
  double depth, frequency;
};

void PrintTo(const LeastDepth& row, std::ostream* out) {
  *out << row.name;
}

class ZerothOrder : public testing::TestWithParam<LeastDepth> {};

TEST_P(ZerothOrder, LeastStableDepth) {
  const auto& [name, entry, exit, depth, frequency] = GetParam();
  const Compliance measured{Modes{{456.780432115313, 0.111705399393456, 7933.09718086825},
                                  {1448.88914030656, 0.0170370095790783, 14691.7784389479}},
                            Modes{{516.51818914797, 0.0245796327070992, 9374.61381193087},
                                  {1408.44814086966, 0.0313576019295683, 12406.3897145168}},
                            Eigen::Matrix2d::Identity()};
  std::vector<double> frequencies;
  for (int i = 200; i < 8000; ++i) frequencies.push_back(0.5 * i);
  const SteadyEngagement engagement{
      .Kt = 1319.4, .Kr = 788.8, .teeth = 2, .entry = entry, .exit = exit};
  LobePoint least;
  least.depth = 1e9;
  for (const LobePoint& point : zeroth_order_lobes(measured, engagement, frequencies, 1))
    if (point.depth < least.depth) least = point;
  EXPECT_NEAR(least.depth, depth, 2e-6);
  EXPECT_NEAR(least.frequency, frequency, 0.5);
}

constexpr double quarter = 1.5707963267948966;
INSTANTIATE_TEST_SUITE_P(Table, ZerothOrder,
                         testing::Values(LeastDepth{"HalfImmersionDown", quarter, 2 * quarter,
                                                    0.957142, 1440.5},
                                         LeastDepth{"HalfImmersionUp", 0, quarter, 1.815611, 510.5},
                                         LeastDepth{"Slot", 0, 2 * quarter, 0.522969, 1448.0}),
                         [](const auto& row) { return row.param.name; });

// Twice the natural frequency at twice the speed is the same cut: nothing changes.
TEST(Benchmark, SpeedAndFrequencyScaleTogether) {
  int cases = 0;
  for (const char* name :
       {"01-ball-down-milling-1-groove.json", "09-square-down-milling-helix-5.json",
        "11-extensions-stock-limited-chip-3-earlier-teeth.json"}) {
    SCOPED_TRACE(name);
    const nlohmann::json file = oracle::file(name);
    const Cut cut = oracle::cut(file["case"]);
    Compliance compliance = oracle::compliance(file["case"]);
    const double S = file["speed_rpm"].get<double>() / 60;
    const Prediction slow = iterate(cut, compliance, S, {});
    for (Direction* direction : {&compliance.x, &compliance.y})
      for (Mode& mode : std::get<Modes>(*direction)) mode.frequency *= 2;
    const Prediction fast = iterate(cut, compliance, 2 * S, {});
    EXPECT_EQ(slow.loops, fast.loops);
    EXPECT_NEAR(*slow.e, *fast.e, 1e-13 * std::abs(*slow.e));
    ++cases;
  }
  EXPECT_EQ(cases, 3);
}

}  // namespace
}  // namespace ridgeline::cutting
