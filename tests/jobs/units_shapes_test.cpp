// Turning of half sections that are hard on paths: bottoms of bores, arcs about points beyond the
// axis, rings, corners that turn by next to nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string_view>

#include "jobs/answer.hpp"
#include "tests/core/nc/rs274.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

Json line(double x0, double z0, double x1, double z1) {
  return {{"pattern", "line"}, {"start", {x0, z0}}, {"end", {x1, z1}}};
}

Json arc(double x0, double z0, double x1, double z1, const char* sense, double xc, double zc) {
  Json row = line(x0, z0, x1, z1);
  row["pattern"] = "arc";
  row["sense"] = sense;
  row["centre"] = {xc, zc};
  row["radius"] = std::hypot(x0 - xc, z0 - zc);
  return row;
}

struct Shape {
  const char* name;
  Json rows;
};
void PrintTo(const Shape& shape, std::ostream* out) {
  *out << shape.name;
}

Json many_corners() {
  Json rows = Json::array({line(0, 0, 10, 0)});
  double x = 10, slope = 0.2;
  for (int z = 0; z < 40; ++z, slope -= 1e-4) {
    rows.push_back(line(x, z, x + slope, z + 1));
    x += slope;
  }
  rows.push_back(line(x, 40, 0, 40));
  rows.push_back(line(0, 40, 0, 0));
  return rows;
}

class UnitsShapes : public testing::TestWithParam<Shape> {};

// The service refuses a path that cuts the product. What is left is no thicker than the corner
// that a nose of 0.4 mm leaves.
TEST_P(UnitsShapes, AreTurnedWithoutACutAndWithoutARest) {
  const auto run = [](const Json& job) {
    return assemble(answer(job.dump(), "json", NoDefinitions()));
  };
  const Json product = {{"name", GetParam().name}, {"shape", Json::array({GetParam().rows})}};
  const Json program = run({{"job", "units"}, {"product", product}});
  ASSERT_EQ(program.at("status"), "ok") << program.at("error");
  for (const char* dialect : {"fanuc", "linuxcnc"}) {
    const Json written = run({{"job", "units"},
                              {"operation", "nc"},
                              {"program", program},
                              {"output", {{"dialect", dialect}}}});
    ASSERT_EQ(written.at("status"), "ok") << written.at("error");
    for (const Json& unit : written.at("units")) EXPECT_LT(unit.at("left_thickness"), 0.5) << unit;
    if (std::string_view(dialect) == "fanuc") continue;
    for (const Json& one : written.at("programs")) {
      const nc::CanonRun canon = nc::run_rs274(one.at("text"));
      EXPECT_EQ(canon.exit_code, 0) << canon.output.substr(canon.output.size() / 2);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sections, UnitsShapes,
    testing::Values(Shape{"blind_bore_with_a_flat_bottom",
                          {line(12, 0, 30, 0), line(30, 0, 30, 80), line(30, 80, 0, 80),
                           line(0, 80, 0, 29), line(0, 29, 12, 29), line(12, 29, 12, 0)}},
                    Shape{"bore_with_a_round_bottom",
                          {line(12, 0, 25, 0), line(25, 0, 25, 40), line(25, 40, 0, 40),
                           line(0, 40, 0, 12), arc(0, 12, 12, 0, "ccw", 0, 0)}},
                    Shape{"ogive_about_a_point_beyond_the_axis",
                          {arc(0, 0, 15, 30, "cw", -22.5, 30), line(15, 30, 15, 50),
                           line(15, 50, 0, 50), line(0, 50, 0, 0)}},
                    Shape{"ring",
                          {arc(30, 0, 38, 8, "ccw", 30, 8), arc(38, 8, 30, 16, "ccw", 30, 8),
                           arc(30, 16, 22, 8, "ccw", 30, 8), arc(22, 8, 30, 0, "ccw", 30, 8)}},
                    // a drill that its cone fits does not pass the neck
                    Shape{"drilled_bottom_behind_a_neck",
                          {line(9, 0, 30, 0), line(30, 0, 30, 80), line(30, 80, 0, 80),
                           line(0, 80, 0, 57.2103), line(0, 57.2103, 12, 50), line(12, 50, 12, 20),
                           line(12, 20, 9, 17), line(9, 17, 9, 0)}},
                    Shape{"corners_of_next_to_nothing", many_corners()}),
    [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace ridgeline::jobs
