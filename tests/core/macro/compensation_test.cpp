#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/macro/interpreter.hpp"

namespace ridgeline::macro {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Plane {
  std::string name;
  const char* g;
  char first, second;
  int first_axis, second_axis;
};
void PrintTo(const Plane& plane, std::ostream* out) {
  *out << plane.name;
}

const Plane planes[] = {
    {"XY", "G17", 'X', 'Y', 0, 1}, {"ZX", "G18", 'Z', 'X', 2, 0}, {"YZ", "G19", 'Y', 'Z', 1, 2}};

std::string point(const Plane& plane, const nlohmann::json& p) {
  return plane.first + std::to_string(p.at(0).get<double>()) + plane.second +
         std::to_string(p.at(1).get<double>());
}

// The path of a contour of cutter_compensation.json: from the first point with G41 or G42, the last
// move cancels.
std::string program_of(const nlohmann::json& contour, const Plane& plane) {
  std::string text = "#13001=" + std::to_string(contour.at("radius").get<double>()) + "\nG90 " +
                     plane.g + " G00 " + point(plane, contour.at("path").at(0)) + "\nG01 " +
                     contour.at("side").get<std::string>() + " D1 F1000 ";
  for (std::size_t i = 1; i < contour.at("path").size(); ++i) {
    if (i + 1 == contour.at("path").size()) text += "G40 ";
    text += point(plane, contour.at("path").at(i)) + "\n";
  }
  return text + "M30\n";
}

nlohmann::json contours() {
  std::ifstream file(std::string(RIDGELINE_TESTS) + "/oracle/macro/cutter_compensation.json");
  return nlohmann::json::parse(file);
}

class CompensationPlane : public testing::TestWithParam<Plane> {};

TEST_P(CompensationPlane, ContoursOfTheOracleAgree) {
  const Plane& plane = GetParam();
  const nlohmann::json oracle = contours();
  int checked = 0;
  for (const auto& [name, contour] : oracle.items()) {
    SCOPED_TRACE(name);
    Options options;
    options.profile.interference_check = false;
    const Result result = run(program_of(contour, plane), options);
    ASSERT_FALSE(result.alarm) << result.alarm->message;
    const nlohmann::json& expected = contour.at("fanuc_expected");
    ASSERT_EQ(result.motion.size(), expected.size() + 1);
    for (std::size_t i = 0; i < expected.size(); ++i, ++checked) {
      const auto p = expected.at(i).at(1).get<std::array<double, 2>>();
      EXPECT_NEAR(result.motion[i + 1].to[plane.first_axis], p[0], 1e-9) << i;
      EXPECT_NEAR(result.motion[i + 1].to[plane.second_axis], p[1], 1e-9) << i;
    }
  }
  EXPECT_EQ(checked, 25);
}

INSTANTIATE_TEST_SUITE_P(Planes, CompensationPlane, testing::ValuesIn(planes),
                         [](const auto& test) { return test.param.name; });

TEST(Compensation, ASlotNarrowerThanTheToolAlarms) {
  const Result result = run(program_of(contours().at("g42_concave_slot_too_narrow"), planes[0]));
  ASSERT_TRUE(result.alarm);
  EXPECT_EQ(result.alarm->number, 41);
  ASSERT_EQ(result.motion.size(), 3U);  // what was done before: start-up and the first wall
  EXPECT_NEAR((result.motion.back().to - Vector3d(5, 5, 0)).norm(), 0, 1e-9);
}

Result run_ok(const std::string& text) {
  Result result = run(text);
  EXPECT_FALSE(result.alarm) << result.alarm->number << " " << result.alarm->message << " line "
                             << result.alarm->line;
  return result;
}

int alarm_of(const std::string& text) {
  const Result result = run(text);
  return result.alarm ? result.alarm->number : 0;
}

// Every point of the compensated path is one radius from the contour or farther, and the path
// touches each contour piece: an identity of offset curves, for lines and arcs mixed.
TEST(Compensation, PathKeepsOneRadiusFromAContourOfLinesAndArcs) {
  // An open outline with convex and concave corners between lines and arcs, material on the right.
  const std::string text =
      "#13001=2.\nG90 G17 G00 X-20. Y-30.\nG01 G41 D1 X0 Y-30. F500\n"
      "Y20.\n"
      "G02 X20. Y30. R15.\n"  // leaves the line at an angle
      "G03 X40. Y30. R20.\n"  // arc and arc
      "G01 X50. Y30.\n"
      "X50. Y0.\n"
      "G02 X30. Y-5. R40.\n"
      "G01 X30. Y-30.\n"
      "G40 X60. Y-30.\nM30\n";
  const Result result = run_ok(text);
  // The contour itself, from the same program without compensation.
  std::string plain = text;
  plain.replace(plain.find("#13001=2."), 9, "#13001=0.");
  const Result contour = run_ok(plain);

  const auto sampled = [](const Result& r, std::size_t first, std::size_t last) {
    std::vector<Vector2d> points;
    for (std::size_t i = first; i <= last; ++i) {
      const Vector2d a = r.motion[i - 1].to.head<2>();
      const Vector2d b = r.motion[i].to.head<2>();
      constexpr int n = 400;
      if (r.motion[i].kind != MoveKind::Arc) {
        for (int k = 0; k <= n; ++k) points.push_back(a + (b - a) * k / n);
        continue;
      }
      const ArcDetail& arc = arc_of(r, r.motion[i]);
      const Vector2d c = arc.centre.head<2>();
      const double start = std::atan2(a.y() - c.y(), a.x() - c.x());
      double sweep = std::atan2(b.y() - c.y(), b.x() - c.x()) - start;
      const bool left = arc.sense == path::ArcSense::CounterClockwise;
      if (left && sweep < 0) sweep += 2 * M_PI;
      if (!left && sweep > 0) sweep -= 2 * M_PI;
      for (int k = 0; k <= n; ++k) {
        const double angle = start + sweep * k / n;
        points.push_back(c + (a - c).norm() * Vector2d(std::cos(angle), std::sin(angle)));
      }
    }
    return points;
  };
  // Moves 2.. of the contour up to the one before the cancel are compensated.
  const std::vector<Vector2d> wall = sampled(contour, 2, contour.motion.size() - 2);
  const std::vector<Vector2d> path = sampled(result, 2, result.motion.size() - 2);
  double nearest_of_all = 1e9, farthest_of_all = 0;
  for (const Vector2d& p : path) {
    double nearest = 1e9;
    for (const Vector2d& q : wall) nearest = std::min(nearest, (p - q).norm());
    nearest_of_all = std::min(nearest_of_all, nearest);
    farthest_of_all = std::max(farthest_of_all, nearest);
  }
  EXPECT_NEAR(nearest_of_all, 2, 1e-3);
  EXPECT_LT(farthest_of_all, 2 * 1.6);  // outside corners go farther, up to sqrt(2)
}

// A round pocket: start-up from the centre, a full circle with G41, back. The tool's circle is
// smaller by the radius.
TEST(Compensation, AFullCircleInAPocketBecomesSmallerByTheRadius) {
  const Result result =
      run_ok("#13001=3.\nG90 G00 X0 Y0\nG01 G41 D1 X10. F100\nG03 I-10. J0\nG01 G40 X0\nM30\n");
  ASSERT_EQ(result.motion.size(), 4U);
  EXPECT_NEAR((result.motion[1].to - Vector3d(7, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((result.motion[2].to - Vector3d(7, 0, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(arc_of(result, result.motion[2]).turns, 1);
  EXPECT_NEAR(arc_of(result, result.motion[2]).centre.norm(), 0, 1e-12);
  EXPECT_NEAR(result.motion[3].to.norm(), 0, 1e-12);
}

// A negative radius changes sides: G41 with -r goes where G42 with r goes.
TEST(Compensation, ANegativeRadiusChangesSides) {
  const std::string path = " D1 X0 Y0 F100\nX30.\nY20.\nX0\nG40 X-20. Y20.\nM30\n";
  const Result left = run_ok("#13001=-2.\nG90 G00 X-20. Y-10.\nG01 G41" + path);
  const Result right = run_ok("#13001=2.\nG90 G00 X-20. Y-10.\nG01 G42" + path);
  ASSERT_EQ(left.motion.size(), right.motion.size());
  for (std::size_t i = 0; i < left.motion.size(); ++i) {
    EXPECT_NEAR((left.motion[i].to - right.motion[i].to).norm(), 0, 1e-12) << i;
  }
}

// One block without motion in the plane is looked past; the tool goes down at the corner.
TEST(Compensation, OneBlockOutsideThePlaneKeepsTheCorner) {
  const Result result = run_ok(
      "#13001=2.\nG90 G00 X-10. Y0 Z5.\nG01 G41 D1 X0 Y0 F100\nX20.\nZ-1.\nY20.\nG40 X40.\nM30\n");
  ASSERT_EQ(result.motion.size(), 6U);
  EXPECT_NEAR((result.motion[2].to - Vector3d(18, 2, 5)).norm(), 0, 1e-12);
  EXPECT_NEAR((result.motion[3].to - Vector3d(18, 2, -1)).norm(), 0, 1e-12);
  EXPECT_NEAR((result.motion[4].to - Vector3d(18, 20, -1)).norm(), 0, 1e-12);
}

// Two such blocks blind the control: the first wall ends perpendicular (design section 2.5).
TEST(Compensation, TwoBlocksOutsideThePlaneEndPerpendicular) {
  const Result result = run_ok(
      "#13001=2.\nG90 G00 X-10. Y0 Z5.\nG01 G41 D1 X0 Y0 F100\nX20.\nZ-1.\nM08\nY20.\nG40 "
      "X40.\nM30\n");
  EXPECT_NEAR((result.motion[2].to - Vector3d(20, 2, 5)).norm(), 0, 1e-12);
}

TEST(Compensation, AlarmsOfThePage) {
  EXPECT_EQ(alarm_of("#13001=2.\nG01 G41 D1 X10. F100\nG17 Y10.\nG18 X20.\nM30\n"), 37);
  EXPECT_EQ(alarm_of("#13001=2.\nG02 G41 D1 X10. R8. F100\nG01 X20.\nM30\n"), 34);
  EXPECT_EQ(alarm_of("#13001=2.\nG01 G41 D1 X10. F100\nY10.\nG03 G40 X20. R8.\nM30\n"), 34);
  EXPECT_EQ(
      alarm_of("#13001=5.\nG01 G41 D1 X10. F100\nX20.\nG03 X20. Y6. R3.\nG01 X0\nY20.\nM30\n"), 41);
  EXPECT_EQ(alarm_of("G01 G41 D2000 X10. F100\nM30\n"), 30);
}

// G53 and G28 go without compensation and the next move starts it again.
TEST(Compensation, MachineMovesInterruptIt) {
  const Result result = run_ok(
      "#13001=2.\nG90 G00 X-10. Y0\nG01 G41 D1 X0 Y0 F100\nX20.\nG53 G00 X0 Y50.\nG01 X0 Y20. "
      "F100\nX20.\nG40 X40.\nM30\n");
  ASSERT_EQ(result.motion.size(), 7U);
  EXPECT_NEAR((result.motion[2].to - Vector3d(20, 2, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((result.motion[3].to - Vector3d(0, 50, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((result.motion[4].to - Vector3d(0, 22, 0)).norm(), 0, 1e-12);
}

// A change of sides: up to the perpendicular on one side, then to the other.
TEST(Compensation, FromG41ToG42CrossesAtTheCorner) {
  const Result result =
      run_ok("#13001=2.\nG90 G00 X-10. Y0\nG01 G41 D1 X0 Y0 F100\nX20.\nG42 X40.\nG40 X60.\nM30\n");
  ASSERT_EQ(result.motion.size(), 6U);
  EXPECT_NEAR((result.motion[2].to - Vector3d(20, 2, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((result.motion[3].to - Vector3d(20, -2, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((result.motion[4].to - Vector3d(40, -2, 0)).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace ridgeline::macro
