#include "core/cutting/along.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "core/cutting/carve.hpp"
#include "core/cutting/floquet.hpp"
#include "tests/core/cutting/oracle_case.hpp"

namespace ridgeline::cutting {
namespace {

// Case 01 as a station of a path along +Y: the frame of the cut is the work frame there.
struct Example {
  nlohmann::json file = oracle::file("01-ball-down-milling-1-groove.json");
  Cut cut = oracle::cut(file["case"]);
  Compliance compliance = oracle::compliance(file["case"]);
  double S = file["speed_rpm"].get<double>() / 60;
  Course course;
  Station station;
  Example() {
    course.cutter = cut.cutter;
    course.coefficients = cut.coefficients;
    course.samples = cut.samples;
    station.centre = Eigen::Vector3d::Zero();
    station.direction = feed_direction(cut);
    station.n = cut.n;
    station.feed = cut.feed;
    station.stock = cut.stock;
  }
};

TEST(Along, OneStationIsTheEngagement) {
  const Example example;
  const auto path = along(example.course, {example.station}, example.compliance, example.S, {});
  const Prediction alone = iterate(example.cut, example.compliance, example.S, {});
  ASSERT_EQ(path.size(), 1U);
  EXPECT_NEAR(*path[0].e, *alone.e, 1e-12);
  EXPECT_EQ(path[0].loops, alone.loops);
}

// A flat block as a height map is what its top is as a plane, however the tool leans.
TEST(Along, TiltedToolMeetsTheMapAsThePlane) {
  Example example;
  const double r = example.course.cutter.r;
  Station plane = example.station;
  plane.centre = {0, 0, 0.7 * r};
  plane.direction = Eigen::Vector3d::UnitY();
  plane.n = Eigen::Vector3d::UnitZ();
  plane.stock = {};
  plane.stock.faces = {HalfSpace{Eigen::Vector3d::UnitZ(), 0}};
  Station map = plane;
  map.stock = {};
  map.stock.map = std::make_shared<HeightMap>(block_map({-20, -20, -9}, {20, 20, 0}, 0.5));
  for (const Eigen::Vector3d& lean : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.4, 0, 0),
                                      Eigen::Vector3d(0, -0.5, 0), Eigen::Vector3d(0.3, 0.6, 0)}) {
    SCOPED_TRACE(testing::PrintToString(lean.transpose()));
    example.course.tool_axis = (Eigen::Vector3d::UnitZ() + lean).normalized();
    AlongOptions options;
    options.iterate.alpha = 1e-8;
    const auto by_plane = along(example.course, {plane}, example.compliance, example.S, options);
    const auto by_map = along(example.course, {map}, example.compliance, example.S, options);
    EXPECT_GT(by_plane[0].peak_force.norm(), 1);
    EXPECT_LT((by_plane[0].peak_force - by_map[0].peak_force).norm(),
              0.02 * by_plane[0].peak_force.norm());
    ASSERT_EQ(by_plane[0].e.has_value(), by_map[0].e.has_value());
    if (by_plane[0].e) {
      EXPECT_NEAR(*by_plane[0].e, *by_map[0].e, 0.02 * by_plane[0].peak_deflection.norm());
    }
  }
}

// The same cut on a path that runs the other way, elsewhere: forces turn with it, the error stays.
TEST(Along, TurnsAndMovesWithTheWork) {
  const Example example;
  Station moved = example.station;
  const Eigen::Vector3d to(10, -20, 5);
  const Eigen::Vector3d flip(-1, -1, 1);  // half a turn about Z
  const auto turned = [&flip](const Eigen::Vector3d& v) -> Eigen::Vector3d {
    return v.cwiseProduct(flip);
  };
  moved.centre = to;
  moved.direction = turned(moved.direction);
  moved.n = turned(moved.n);
  for (Face& face : moved.stock.faces) {
    auto& plane = std::get<HalfSpace>(face);
    plane.n = turned(plane.n);
    plane.h += plane.n.dot(to);
  }
  for (Round& groove : moved.stock.grooves) {
    groove.centre = turned(groove.centre) + to;
    groove.axis = turned(groove.axis);
  }
  AlongOptions options;
  options.iterate.alpha = 1e-12;
  options.part = 1;
  const auto path =
      along(example.course, {example.station, moved}, example.compliance, example.S, options);
  EXPECT_NEAR(*path[0].e, *path[1].e, 1e-9);
  EXPECT_LT((turned(path[0].peak_force) - path[1].peak_force).norm(), 1e-5);
}

// Stations of a slope whose tilt changes slowly, in up-milling, which converges slowly.
std::vector<Station> slope(const Example& example, int count, double step = 0.25) {
  std::vector<Station> out;
  for (int i = 0; i < count; ++i) {
    const double tilt = (14 + step * i) * std::numbers::pi / 180;
    Station station = example.station;
    station.feed = 0.2;
    station.direction = {0, -1, 0};
    station.n = {-std::sin(tilt), 0, std::cos(tilt)};
    station.stock.faces = {HalfSpace{station.n, 0.23 - example.course.cutter.r}};
    const Eigen::Vector3d down(-std::cos(tilt), 0, -std::sin(tilt));
    station.stock.grooves = {{0.49 * down, station.direction, example.course.cutter.r}};
    out.push_back(station);
  }
  return out;
}

// Both leave a residual below alpha (10 % rms), so their errors differ by less than that of either.
TEST(Along, SecantsEndWhereAveragesDoInAThirdOfTheLoops) {
  Example example;
  example.course.samples = 512;
  example.course.cutter.elements = 64;
  const Modes mode{{1100, 0.03, 2000}};
  example.compliance = {mode, mode, Eigen::Matrix2d::Identity()};
  const std::vector<Station> stations = slope(example, 24);
  AlongOptions averages, secants;
  averages.iterate.max_loops = 100;
  secants.iterate.mixing = Mixing::Secants;
  constexpr double S = 3000 / 60.0;
  const auto slow = along(example.course, stations, example.compliance, S, averages);
  const auto fast = along(example.course, stations, example.compliance, S, secants);
  int slow_loops = 0, fast_loops = 0, compared = 0;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    slow_loops += slow[i].loops;
    fast_loops += fast[i].loops;
    EXPECT_TRUE(fast[i].converged) << i;
    if (!slow[i].converged) continue;
    EXPECT_NEAR(*fast[i].e, *slow[i].e, 1e-3) << i;
    ++compared;
  }
  EXPECT_GE(compared, 12);
  EXPECT_LT(3 * fast_loops, slow_loops);
}

// A wave of 8 in a period, so many samples later: on the line between samples, within (8 step)^2
// / 8.
TEST(Along, ADeflectionMovesOnByPartsOfASample) {
  const double step = 2 * std::numbers::pi / 512;
  Deflections wave;
  for (int i = 0; i < 512; ++i) wave.emplace_back(std::cos(8 * step * i), std::sin(8 * step * i));
  for (const double later : {0.0, 3.0, 3.25, -2.5, 511.75, -1030.5}) {
    const Deflections moved = moved_on(wave, later);
    for (int i = 0; i < 512; ++i) {
      const double at = 8 * step * (i - later);
      const Eigen::Vector2d expected(std::cos(at), std::sin(at));
      EXPECT_LT((moved[static_cast<std::size_t>(i)] - expected).norm(), 0.00121) << later;
    }
  }
}

// At 1500 rev/min, 22 waves in a tooth period, the engagement that turns with the slope takes the
// vibration with it: 218 loops, and 330 from where the vibration was.
TEST(Along, TheStartMovesOnWithTheEngagement) {
  Example example;
  example.course.samples = 1024;
  example.course.cutter.elements = 64;
  const Modes mode{{1100, 0.03, 2000}};
  example.compliance = {mode, mode, Eigen::Matrix2d::Identity()};
  AlongOptions options;
  options.iterate.mixing = Mixing::Secants;
  int loops = 0;
  for (const StationError& station :
       along(example.course, slope(example, 40, 1.2), example.compliance, 1500 / 60.0, options)) {
    EXPECT_TRUE(station.converged);
    loops += station.loops;
  }
  EXPECT_LT(loops, 270);
}

TEST(Along, TheRigidMethodHasNoMemory) {
  const Example example;
  AlongOptions options;
  options.method = Method::Rigid;
  const auto path = along(example.course, {example.station, example.station}, example.compliance,
                          example.S, options);
  const Prediction alone = rigid(example.cut, example.compliance, example.S, Span::Pitch);
  for (const StationError& station : path) EXPECT_NEAR(*station.e, *alone.e, 1e-12);
}

// The spread by its definition: the rigid method again with other coefficients, a tenth up and
// down.
TEST(Along, TheSpreadOfTheRigidMethodIsThatOfOtherCoefficients) {
  const Example example;
  AlongOptions options;
  options.method = Method::Rigid;
  options.uncertainty = Uncertainty{0.1, 0.2, 0.1};
  const auto path =
      along(example.course, {example.station}, example.compliance, example.S, options);
  const auto error = [&](double cutting, double edge) {
    Cut cut = example.cut;
    tool::Coefficients& k = cut.coefficients;
    for (double* K : {&k.Ktc, &k.Krc, &k.Kac}) *K *= cutting;
    for (double* K : {&k.Kte, &k.Kre, &k.Kae}) *K *= edge;
    return *rigid(cut, example.compliance, example.S, Span::Pitch).e;
  };
  const double by_cutting = (error(1.1, 1) - error(0.9, 1)) / 0.2;
  const double by_edge = (error(1, 1.1) - error(1, 0.9)) / 0.2;
  const double expected = std::hypot(0.1 * by_cutting, 0.2 * by_edge, 0.1 * (by_cutting + by_edge));
  EXPECT_GT(expected, 1e-4);
  EXPECT_NEAR(path[0].spread, expected, 1e-9);
}

TEST(Along, TheTimeDomainAlongAPathIsTheTimeDomainOfEachStation) {
  const Example example;
  AlongOptions options;
  options.method = Method::TimeDomain;
  options.uncertainty = Uncertainty{0.1, 0.2, 0.1};
  options.iterate.alpha = 1e-8;
  Station station = example.station;
  station.borders = {station.n};
  const auto path =
      along(example.course, {station, station}, example.compliance, example.S, options);
  const TimeDomain alone = time_domain(example.cut, example.compliance, example.S, options.time);
  ASSERT_EQ(path.size(), 2U);
  EXPECT_EQ(*path[1].e, *alone.e);
  EXPECT_EQ(path[1].loops, alone.revolutions);
  EXPECT_TRUE(path[1].converged);
  EXPECT_FALSE(path[1].fell_back);
  EXPECT_EQ(path[1].stability, Stability::Stable);
  EXPECT_NEAR(*path[1].border[0], *path[1].e, 1e-5);  // the same surface by the chips of one turn
  AlongOptions iterated = options;
  iterated.method = Method::Iterate;
  const auto same = along(example.course, {station}, example.compliance, example.S, iterated);
  EXPECT_NEAR(path[1].spread, same[0].spread, 0.02 * same[0].spread);
}

// The spread goes on from the deflection of a whole revolution that the time domain found.
TEST(Along, AStationThatFellBackHasTheSpreadOfOneThatDidNot) {
  const Example example;
  AlongOptions options;
  options.uncertainty = Uncertainty{0.1, 0.2, 0.1};
  options.iterate.alpha = 1e-8;
  const auto one = along(example.course, {example.station}, example.compliance, example.S, options);
  options.iterate.max_loops = 2;
  const auto fell =
      along(example.course, {example.station}, example.compliance, example.S, options);
  EXPECT_FALSE(one[0].fell_back);
  ASSERT_TRUE(fell[0].fell_back);
  EXPECT_NEAR(fell[0].spread, one[0].spread, 0.2 * one[0].spread);
}

// Design page: residual at most 5 % of the original error or 0.5 um.
TEST(Along, CorrectionTakesTheErrorAway) {
  const Example example;
  AlongOptions options;
  options.iterate.alpha = 1e-6;
  const auto path =
      corrected(example.course, {example.station}, example.compliance, example.S, options, {});
  EXPECT_GT(path[0].before, 0.009);
  EXPECT_LE(std::abs(*path[0].e), std::max(0.0005, 0.05 * path[0].before));
  Station shifted = example.station;
  shifted.centre -= path[0].shift * shifted.n;
  const auto again = along(example.course, {shifted}, example.compliance, example.S, options);
  EXPECT_NEAR(*again[0].e - path[0].shift, *path[0].e, 2e-4);
}

// B1 of the design page: slot, flexible along the feed, |mu| per tooth by Chebyshev collocation.
TEST(Floquet, InspergerSlot) {
  struct Row {
    double depth, mu;
  };
  for (const auto& [depth, mu] : {Row{0.2, 0.819742784266}, Row{0.5, 1.073975586677},
                                  Row{0.7, 1.221556135687}, Row{1.0, 1.406473525390}}) {
    Cut cut;
    cut.cutter.kind = CutterKind::Square;
    cut.cutter.r = 10;
    cut.cutter.pitch = equal_pitch(2);
    cut.cutter.elements = 1;
    cut.cutter.height = depth;
    cut.coefficients = {600, 0, 200, 0, 0, 0};
    cut.n = {-1, 0, 0};
    cut.feed = 1e-5;
    cut.samples = 4096;
    cut.stock.faces = {HalfSpace{cut.n, cut.cutter.r}};
    const Compliance along_feed{Modes{}, Modes{{922, 0.011, 1340.049648}}};
    const Deflections at_rest(2048, Eigen::Vector2d::Zero());
    const auto multiplier =
        floquet_multiplier(cut, along_feed, 5000 / 60.0, at_rest, Engaging::Frozen);
    EXPECT_NEAR(std::abs(multiplier), mu, 5e-5) << depth << " mm";
  }
}

}  // namespace
}  // namespace ridgeline::cutting
