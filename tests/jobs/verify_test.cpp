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

INSTANTIATE_TEST_SUITE_P(Controls, VerifyOwn,
                         testing::Values("fanuc", "siemens", "heidenhain", "linuxcnc"));

}  // namespace
}  // namespace ridgeline::jobs
