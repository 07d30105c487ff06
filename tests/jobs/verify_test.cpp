#include <gtest/gtest.h>

#include <string>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

class VerifyOwn : public testing::TestWithParam<const char*> {};

// What a job writes for any control keeps that job, without a word about offsets or tools.
TEST_P(VerifyOwn, ProgramKeepsItsJobWithoutWarnings) {
  Json job = Json::parse(R"({"job": "chamfer",
    "workpiece": {"shape": "thick_walled_cylinder", "inner_radius": 20, "outer_radius": 30,
      "length": 100, "holes": [{"name": "H1", "shape": "circle", "radius": 5}]},
    "hole": "H1", "edge": "inner", "width": 0.5, "tool": {"number": 12, "shape": "lollipop",
      "radius": 3, "neck_radius": 1.5, "neck_length": 60, "shank_radius": 1.5,
      "holder_radius": 10, "stickout": 70}})");
  for (const char* offset : {"G54", "G56"}) {
    job["output"] = {{"dialect", GetParam()}, {"work_offset", offset}};
    const Answer program = answer(job.dump(), "nc", NoDefinitions());
    ASSERT_FALSE(is_error(program)) << program.document;
    const Json verify = {{"job", "verify"}, {"program", program.text}, {"against", job}};
    const Answer measured = answer(verify.dump(), "json", NoDefinitions());
    EXPECT_EQ(measured.document.at("status"), "ok") << measured.document;
    EXPECT_EQ(measured.document.at("warnings"), Json::array());
    // Another offset is worth a word.
    Json other = job;
    other["output"]["work_offset"] = "G55";
    const Json against_other = {{"job", "verify"}, {"program", program.text}, {"against", other}};
    const Answer warned = answer(against_other.dump(), "json", NoDefinitions());
    ASSERT_EQ(warned.document.at("warnings").size(), 1u);
  }
}

// A tool along an oblique hole: arcs of the tilted work plane, or of the work frame where the
// control follows the tool. The program says them so that its reader finds the width again.
TEST_P(VerifyOwn, ArcsAboutATiltedToolKeepTheJob) {
  Json job = Json::parse(R"({"job": "chamfer",
    "workpiece": {"shape": "thick_walled_cylinder", "inner_radius": 20, "outer_radius": 30,
      "length": 100, "arrangement_angle": 25, "holes": [{"name": "H1", "shape": "circle",
      "radius": 5, "penetration_angle": 15}]},
    "hole": "H1", "edge": "inner", "width": 0.5, "tolerance": 0.002, "tool_axis": "hole",
    "tool": {"number": 12, "shape": "lollipop", "radius": 2, "neck_radius": 0.8,
      "neck_length": 60, "shank_radius": 0.8, "holder_radius": 10, "stickout": 90}})");
  int kept = 0;
  for (const char* tilted : {"work_plane", "work_frame"}) {
    SCOPED_TRACE(tilted);
    const bool has_plane = std::string(GetParam()) != "linuxcnc";
    if (!has_plane && std::string(tilted) == "work_plane") continue;
    job["output"] = {{"dialect", GetParam()}, {"tilted", tilted}, {"arcs", true}};
    const Answer solved = answer(job.dump(), "json", NoDefinitions());
    ASSERT_FALSE(is_error(solved)) << solved.document;
    EXPECT_EQ(solved.document.contains("plane_axes"), std::string(tilted) == "work_plane");
    EXPECT_LT(solved.document.at("report").at("points"), 45);
    const Answer program = answer(job.dump(), "nc", NoDefinitions());
    const Json verify = {{"job", "verify"}, {"program", program.text}, {"against", job}};
    const Answer measured = answer(verify.dump(), "json", NoDefinitions());
    EXPECT_EQ(measured.document.at("status"), "ok") << measured.document;
    for (const char* width : {"width_min", "width_max"}) {
      EXPECT_NEAR(measured.document.at("report").at(width).get<double>(), 0.5, 0.003);
    }
    ++kept;
  }
  EXPECT_GE(kept, 1);
}

INSTANTIATE_TEST_SUITE_P(Controls, VerifyOwn,
                         testing::Values("fanuc", "siemens", "heidenhain", "linuxcnc"));

}  // namespace
}  // namespace ridgeline::jobs
