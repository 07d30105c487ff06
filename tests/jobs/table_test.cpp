// The table of the README: every shape of hole, body, edge, side, control and way of writing
// coordinates; what is written is read back and measured.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

constexpr const char* tube = R"({"shape": "thick_walled_cylinder", "inner_radius": 20,
  "outer_radius": 30, "length": 120})";
constexpr const char* block =
    R"({"shape": "manifold_block", "bore_radius": 20, "size": [70, 120, 60]})";
constexpr const char* circle = R"({"shape": "circle", "radius": 6})";
constexpr const char* elongated = R"({"shape": "elongated", "radius": 5, "straight_along": 8})";
constexpr const char* rounded_rectangle = R"({"shape": "rounded_rectangle", "radius": 5,
  "straight_along": 6, "straight_across": 4})";

using Row = std::tuple<const char*, const char*, const char*, const char*>;

class Table : public testing::TestWithParam<Row> {};

TEST_P(Table, WhatIsWrittenForEveryControlKeepsTheWidth) {
  const auto& [body, hole, edge, side] = GetParam();
  Json job = Json::parse(R"({"job": "chamfer", "hole": "H1", "width": 0.5, "tolerance": 0.002,
    "tool": {"number": 12, "shape": "lollipop", "radius": 3, "neck_radius": 1.2,
      "neck_length": 90}})");
  job["edge"] = edge;
  job["side"] = side;
  job["workpiece"] = Json::parse(body);
  job["workpiece"]["holes"] = {Json::parse(hole)};
  job["workpiece"]["holes"][0]["name"] = "H1";
  job["workpiece"]["holes"][0]["eccentric_distance"] = 2;
  for (const char* dialect : {"fanuc", "siemens", "heidenhain", "linuxcnc"}) {
    for (const char* positioning : {"absolute", "incremental"}) {
      SCOPED_TRACE(std::string(dialect) + " " + positioning);
      job["output"] = {{"dialect", dialect}, {"positioning", positioning}};
      const Answer program = answer(job.dump(), "nc", NoDefinitions());
      ASSERT_FALSE(is_error(program)) << program.document;
      const Json verify = {{"job", "verify"}, {"program", program.text}, {"against", job}};
      const Answer measured = answer(verify.dump(), "json", NoDefinitions());
      ASSERT_EQ(measured.document.at("status"), "ok") << measured.document;
      const Json& report = measured.document.at("report");
      EXPECT_NEAR(report.at("width_min").get<double>(), 0.5, 0.003);
      EXPECT_NEAR(report.at("width_max").get<double>(), 0.5, 0.003);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tube, Table,
                         testing::Combine(testing::Values(tube),
                                          testing::Values(circle, elongated, rounded_rectangle),
                                          testing::Values("inner", "outer"),
                                          testing::Values("entry", "exit")));
INSTANTIATE_TEST_SUITE_P(Block, Table,
                         testing::Combine(testing::Values(block),
                                          testing::Values(circle, elongated, rounded_rectangle),
                                          testing::Values("inner", "outer"),
                                          testing::Values("entry", "exit")));

}  // namespace
}  // namespace ridgeline::jobs
