// The macro of a chamfer job, run by the interpreter, goes through the centres of the section
// method.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {
namespace {

using nlohmann::json;

json chamfer_job() {
  return json::parse(R"({"job": "chamfer", "method": "section", "points": 48, "width": 0.4,
    "workpiece": {"shape": "thick_walled_cylinder", "inner_radius": 20, "outer_radius": 30,
      "length": 100, "position": [7, -4, 12], "holes": [{"name": "H1", "shape": "circle", "radius": 6,
      "position": [7, -4, 12]}]},
    "hole": "H1", "edge": "inner", "feed": 350,
    "tool": {"number": 12, "shape": "lollipop", "radius": 3, "neck_radius": 1, "neck_length": 70}})");
}

struct Variant {
  std::string name;
  json patch;  ///< JSON merge patch of the job
};
void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name;
}

std::vector<Variant> variants() {
  return {{"Inner", json::object()},
          {"InnerExit", {{"side", "exit"}}},
          {"Outer", {{"edge", "outer"}}},
          {"OuterExit", {{"edge", "outer"}, {"side", "exit"}}},
          {"Conventional", {{"direction", "conventional"}, {"start_angle", 40}}},
          {"ConstantAngle", {{"section_angle", 45}}},
          {"Turned", {{"workpiece", {{"arrangement_angle", 30}}}}},
          {"ThroughTheHole", {{"tool_axis", "hole"}}}};
}

class ChamferMacro : public testing::TestWithParam<Variant> {};

/// Smallest distance of a point to the points of a list.
double nearest(const std::vector<double>& p, const json& points) {
  double least = 1e9;
  for (const json& q : points) {
    least = std::min(least, std::hypot(p[0] - q[0].get<double>(), p[1] - q[1].get<double>(),
                                       p[2] - q[2].get<double>()));
  }
  return least;
}

TEST_P(ChamferMacro, GoesThroughTheCentresOfTheSectionMethod) {
  json job = chamfer_job();
  job.merge_patch(GetParam().patch);
  const json computed = assemble(answer(job.dump(), "json", NoDefinitions()));
  ASSERT_EQ(computed.at("status"), "ok") << computed;
  const Answer made = answer(job.dump(), "macro", NoDefinitions());
  ASSERT_EQ(made.document.at("status"), "ok") << made.document;
  const std::size_t call = made.text.find("(CALL: ") + 7;
  const std::string words = made.text.substr(call, made.text.find(')', call) - call);
  const std::string number = words.substr(5, words.find(' ', 5) - 5);  // after "G65 P"
  const json run = {{"job", "macro"},
                    {"program", "O77\nG90 G17\n" + words + "\nM30\n"},
                    {"programs", {{number, made.text}}},
                    {"tools", {{"D12", 3}}}};
  const json result = assemble(answer(run.dump(), "json", NoDefinitions()));
  ASSERT_EQ(result.at("status"), "ok") << result.at("alarm") << made.text;
  // Rounded to 0.001 in each axis; the program drives the tip, 3 below the centre.
  constexpr double tolerance = 0.0005 * 1.7320508 + 1e-6;
  int checked = 0;
  for (const json& move : result.at("motion")) {
    if (move.at("kind") != "line" || move.at("feed") != 350) continue;
    std::vector<double> centre = move.at("to");
    centre[2] += 3;
    EXPECT_LE(nearest(centre, computed.at("centres")), tolerance) << json(centre);
    ++checked;
  }
  EXPECT_EQ(checked, 49);
}

INSTANTIATE_TEST_SUITE_P(Jobs, ChamferMacro, testing::ValuesIn(variants()),
                         [](const auto& test) { return test.param.name; });

TEST(ChamferMacroForm, RefusesWhatItsArithmeticDoesNotHave) {
  const auto field = [](const json& patch) {
    json job = chamfer_job();
    job.merge_patch(patch);
    const json document = answer(job.dump(), "macro", NoDefinitions()).document;
    return document.at("status") == "error" ? document.at("error").value("field", "?") : "none";
  };
  EXPECT_EQ(field(json::object()), "none");
  EXPECT_EQ(field({{"section_angle", json::parse("[[0, 45], [90, 50]]")}}), "/section_angle");
  EXPECT_EQ(field({{"output", {{"dialect", "siemens"}}}}), "/output/dialect");
  EXPECT_EQ(field({{"output", {{"control_point", "centre"}}}}), "/output/control_point");
}

TEST(ChamferMacroForm, LinuxCncGetsAMainProgram) {
  json job = chamfer_job();
  job["output"] = {{"dialect", "linuxcnc"}};
  const std::string text = answer(job.dump(), "macro", NoDefinitions()).text;
  EXPECT_NE(text.find("endwhile"), std::string::npos);
  EXPECT_EQ(text.find("G65"), std::string::npos);
}

}  // namespace
}  // namespace ridgeline::jobs
