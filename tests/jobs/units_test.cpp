#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

std::string content(const std::string& name) {
  std::ifstream in(RIDGELINE_TESTS "/parts/" + name, std::ios::binary);
  EXPECT_TRUE(in.good()) << name;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Json run(const Json& job) {
  return assemble(answer(job.dump(), "json", NoDefinitions()));
}

/// The case of design 2.5: stock by equation (1).
Json flanged_job() {
  return {
      {"job", "units"},
      {"product_step", content("own_flanged_shaft.step")},
      {"parameters", {{"radial_allowance", 4}, {"end_allowance", 5}, {"stock_rule", "document"}}},
      {"split", {{"outer", 40}, {"inner", 70}, {"outer_overlap", 5}, {"inner_overlap", 5}}}};
}

Json edited(const Json& program, const Json& edits) {
  return run({{"job", "units"}, {"operation", "edit"}, {"program", program}, {"edits", edits}});
}

std::string listed(const Json& program) {
  std::string text;
  for (const Json& unit : program["units"])
    text += unit["kind"].get<std::string>() + std::to_string(unit["process"].get<int>()) + " ";
  return text;
}

int count(const Json& program, const std::string& state) {
  int n = 0;
  for (const Json& unit : program["units"]) n += unit["state"] == state;
  return n;
}

TEST(UnitsJob, FlangedShaftFromItsStepFileHasTheUnitsAndVolumesOfTheDesign) {
  const Json program = run(flanged_job());
  ASSERT_EQ(program["status"], "ok") << program.dump();
  EXPECT_EQ(listed(program),
            "face_front1 bar_outer1 bar_inner1 hole1 hole1 hole1 hole1 "
            "face_back2 bar_outer2 bar_inner2 face_mill2 face_mill2 face_mill2 face_mill2 "
            "face_mill2 face_mill2 face_mill2 face_mill2 hole2 hole2 hole2 hole2 hole2 hole2 ");
  const Json& v = program["volumes"];
  const double removed = v["stock"].get<double>() - v["product"].get<double>();
  EXPECT_NEAR(removed, 2578676.468, 1e-2);
  EXPECT_NEAR(v["turned"].get<double>(), 2565560.6546, 1e-3);
  EXPECT_NEAR(v["overlap_declared"].get<double>(), 128409.8, 0.05);
  EXPECT_NEAR(v["overlap_undeclared"].get<double>(), 0, 1e-6);
  EXPECT_NEAR(v["left"].get<double>(), 0, 1e-6);
  EXPECT_NEAR(v["unexplained"].get<double>(), 0, 1e-6 * removed);
  EXPECT_NEAR(v["units"].get<double>() - v["overlap_declared"].get<double>(), removed,
              1e-6 * removed);
}

TEST(UnitsJob, FindingsOfTheFlangedShaftHaveTheParametersOfItsDrawing) {
  const Json product = run(flanged_job())["product"];
  ASSERT_EQ(product["holes"].size(), 10u);
  int nines = 0, sixes = 0;
  for (const Json& hole : product["holes"]) {
    const double d = hole["diameter"];
    const double r = std::hypot(hole["start"][0].get<double>(), hole["start"][1].get<double>());
    const bool is_nine = std::abs(d - 9) < 5e-5;
    nines += is_nine;
    sixes += std::abs(d - 6) < 5e-5;
    EXPECT_NEAR(r, is_nine ? 46 : 51, 5e-5);
    EXPECT_NEAR(hole["depth"].get<double>(), is_nine ? 12 : 10, 5e-5);
    EXPECT_NEAR(hole["start"][2].get<double>(), is_nine ? 30 : 50, 5e-5);
    EXPECT_NEAR(hole["direction"][2].get<double>(), is_nine ? 1 : -1, 1e-9);
    EXPECT_EQ(hole["bottom"], "cone");
    EXPECT_NEAR(hole["point_angle"].get<double>(), 118, 5e-5);
  }
  EXPECT_EQ(nines, 4);
  EXPECT_EQ(sixes, 6);
  ASSERT_EQ(product["faces"].size(), 8u);
  for (const Json& face : product["faces"]) {
    EXPECT_NEAR(face["depth"].get<double>(), 2, 5e-5);
    EXPECT_NEAR(face["z"][0].get<double>(), 60, 5e-5);
    EXPECT_NEAR(face["z"][1].get<double>(), 90, 5e-5);
    EXPECT_NEAR(face["normal"][2].get<double>(), 0, 1e-9);
  }
}

// Document 004, figures 28 and 40: one number is set, the row that met it follows.
TEST(UnitsJob, LongerBoreKeepsNineteenUnitsAndOnlyTheDeclaredOverlap) {
  const Json program = run(flanged_job());
  const Json after = edited(program, {{{"unit", 3}, {"set", {{"shape/2/end", {12, 125}}}}}});
  ASSERT_EQ(after["status"], "ok") << after.dump();
  EXPECT_EQ(listed(after), listed(program));
  EXPECT_EQ(count(after, "kept"), 19);
  EXPECT_EQ(count(after, "frozen"), 2);
  EXPECT_EQ(count(after, "edited"), 1);
  EXPECT_EQ(count(after, "auto"), 2);
  EXPECT_NEAR(after["volumes"]["overlap_undeclared"].get<double>(), 0, 1e-6);
  EXPECT_NEAR(after["volumes"]["left"].get<double>(), 0, 1e-6);
  EXPECT_NEAR(after["units"][7]["shape"][0]["end"][0].get<double>(), 12, 1e-9);
  EXPECT_NEAR(after["units"][9]["shape"].back()["end"][1].get<double>(), 91, 1e-9);
  EXPECT_EQ(after["revision"], 1);
}

TEST(UnitsJob, ProgramsReadBackAsTheyWereWritten) {
  const Json program = run(flanged_job());
  const Json again = run({{"job", "units"}, {"operation", "show"}, {"program", program}});
  ASSERT_EQ(again["status"], "ok") << again.dump();
  ASSERT_EQ(again["units"].size(), program["units"].size());
  for (std::size_t i = 0; i < program["units"].size(); ++i) {
    EXPECT_EQ(again["units"][i]["shape"], program["units"][i]["shape"]);
    EXPECT_EQ(again["units"][i]["tools"], program["units"][i]["tools"]);
  }
  for (const auto& [key, value] : program["volumes"].items())
    EXPECT_NEAR(again["volumes"][key].get<double>(), value.get<double>(), 1e-6) << key;
}

TEST(UnitsJob, PartValuesPlanAsTheFileThatTheyCameFrom) {
  const Json program = run(flanged_job());
  Json job = flanged_job();
  job.erase("product_step");
  job["product"] = program["product"];
  const Json again = run(job);
  ASSERT_EQ(again["status"], "ok") << again.dump();
  EXPECT_EQ(listed(again), listed(program));
  EXPECT_NEAR(again["volumes"]["units"].get<double>(), program["volumes"]["units"].get<double>(),
              1e-6);
}

TEST(UnitsJob, UndoTakesEditsBackOneListAtATime) {
  const Json program = run(flanged_job());
  const Json once = edited(program, {{{"unit", 3}, {"set", {{"shape/2/end", {12, 125}}}}}});
  const Json twice = edited(once, {{{"remove", 5}}});
  ASSERT_EQ(twice["status"], "ok") << twice.dump();
  EXPECT_EQ(twice["revision"], 2);
  EXPECT_EQ(twice["units"].size(), 23u);
  const auto undo = [](const Json& of, int n) {
    return run({{"job", "units"}, {"operation", "edit"}, {"program", of}, {"undo", n}});
  };
  EXPECT_EQ(undo(twice, 1)["units"], once["units"]);
  EXPECT_EQ(undo(twice, 2)["units"], program["units"]);
  EXPECT_EQ(undo(program, 1)["error"]["code"], "bad_input");
}

TEST(UnitsJob, ToolsOfKeptUnitsOutliveEdits) {
  const Json program = run(flanged_job());
  const Json with_feed =
      edited(program, {{{"unit", 9}, {"set", {{"tools/0/feed_per_revolution", 0.25}}}}});
  EXPECT_EQ(with_feed["units"][8]["state"], "auto");
  const Json after = edited(with_feed, {{{"unit", 3}, {"set", {{"shape/2/end", {12, 125}}}}}});
  EXPECT_EQ(after["units"][8]["state"], "kept");
  EXPECT_DOUBLE_EQ(after["units"][8]["tools"][0]["feed_per_revolution"].get<double>(), 0.25);
}

struct BadJob {
  const char* name;
  const char* code;
  const char* field;
  Json job;
};
void PrintTo(const BadJob& bad, std::ostream* out) {
  *out << bad.name;
}

Json with_step(const std::string& text) {
  return {{"job", "units"}, {"product_step", text}};
}

std::vector<BadJob> bad_jobs() {
  const std::string step = content("own_hard_shaft.step");
  const std::string several = content("nist_ctc_01_ap203.stp");
  Json metres = with_step(step);
  std::string& text = metres["product_step"].get_ref<std::string&>();
  const std::size_t unit = text.find("SI_UNIT(.MILLI.,.METRE.)");
  EXPECT_NE(unit, std::string::npos);
  text.replace(unit, 24, "SI_UNIT(.KILO.,.METRE.)");
  return {
      {"not STEP", "bad_file", "/product_step", with_step("solid cube\n")},
      {"empty", "bad_file", "/product_step", with_step("")},
      {"blank", "bad_file", "/product_step", with_step("  \n ")},
      {"header only", "bad_file", "/product_step", with_step("ISO-10303-21;\nHEADER;\nENDSEC;\n")},
      {"truncated", "bad_file", "/product_step", with_step(step.substr(0, step.size() / 2))},
      {"no solid", "bad_file", "/product_step",
       with_step("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n")},
      {"not turned", "not_turned", "/product_step", with_step(several)},
      {"kilometres", "absurd_size", "/product_step", metres},
      {"no product", "bad_input", "/product", {{"job", "units"}}},
      {"a path at the service",
       "unknown_definition",
       "/product",
       {{"job", "units"}, {"product", "/etc/passwd"}}},
      {"part without shape",
       "bad_input",
       "/product/shape",
       {{"job", "units"}, {"product", {{"shape", Json::array()}}}}},
      {"unknown key",
       "bad_input",
       "/split/iner",
       {{"job", "units"}, {"split", {{"outer", 1}, {"iner", 2}}}}},
  };
}

// A barrel: the middle of its arc, radius 60, lies 50 mm beyond the axis. pi times the integral of
// (sqrt(3600 - t^2) - 50)^2 from -20 to 20.
TEST(UnitsJob, TakesAnArcAboutAMiddleBeyondTheAxis) {
  const double r = std::sqrt(3200.0) - 50;
  const auto line = [](double x0, double z0, double x1, double z1) {
    return Json{{"pattern", "line"}, {"start", {x0, z0}}, {"end", {x1, z1}}};
  };
  const Json arc = {{"pattern", "arc"}, {"start", {r, 40}},    {"end", {r, 0}},
                    {"radius", 60},     {"centre", {-50, 20}}, {"sense", "ccw"}};
  const Json shape = {line(0, 0, 0, 40), line(0, 40, r, 40), arc, line(r, 0, 0, 0)};
  const Json program = run({{"job", "units"}, {"product", {{"shape", Json::array({shape})}}}});
  ASSERT_EQ(program["status"], "ok") << program.dump().substr(0, 400);
  const double volume = M_PI * (6100 * 40 - 2 * 8000 / 3.0 -
                                100 * (20 * std::sqrt(3200.0) + 3600 * std::asin(1 / 3.0)));
  EXPECT_NEAR(program["volumes"]["product"].get<double>(), volume, 1e-9 * volume);
  EXPECT_NEAR(program["volumes"]["left"].get<double>(), 0, 1e-9);
  EXPECT_EQ(program["volumes"]["overlap_undeclared"].get<double>(), 0);
}

class BadUnitsJob : public testing::TestWithParam<BadJob> {};

TEST_P(BadUnitsJob, IsRefusedByName) {
  const Json result = run(GetParam().job);
  ASSERT_EQ(result["status"], "error") << result.dump().substr(0, 400);
  EXPECT_EQ(result["error"]["code"], GetParam().code) << result["error"].dump();
  EXPECT_EQ(result["error"]["field"], GetParam().field) << result["error"].dump();
}

INSTANTIATE_TEST_SUITE_P(Cases, BadUnitsJob, testing::ValuesIn(bad_jobs()));

struct BadEdit {
  const char* name;
  const char* field;
  Json edits;
};
void PrintTo(const BadEdit& bad, std::ostream* out) {
  *out << bad.name;
}

class BadUnitsEdit : public testing::TestWithParam<BadEdit> {};

TEST_P(BadUnitsEdit, IsRefusedByName) {
  static const Json program = run(flanged_job());
  const Json result = edited(program, GetParam().edits);
  ASSERT_EQ(result["status"], "error") << result.dump().substr(0, 400);
  EXPECT_EQ(result["error"]["code"], "bad_input") << result["error"].dump();
  EXPECT_EQ(result["error"]["field"], GetParam().field) << result["error"].dump();
}

INSTANTIATE_TEST_SUITE_P(
    Cases, BadUnitsEdit,
    testing::Values(
        BadEdit{"no edit", "/edits", Json::array()},
        BadEdit{"no such unit", "/edits/0/unit", {{{"unit", 25}, {"set", {{"process", 1}}}}}},
        BadEdit{"no such path",
                "/edits/0/set/shape~17~1end",
                {{{"unit", 3}, {"set", {{"shape/7/end", {12, 125}}}}}}},
        BadEdit{"volume", "/edits/0/set/volume", {{{"unit", 3}, {"set", {{"volume", 1}}}}}},
        BadEdit{"not a point",
                "/edits/0/set/shape/2/end/1",
                {{{"unit", 3}, {"set", {{"shape/2/end", {12, "x"}}}}}}},
        BadEdit{"nothing known", "/edits/0", {{{"delete", 5}}}},
        BadEdit{"remove none", "/edits/0/remove", {{{"remove", 0}}}},
        BadEdit{"insert without kind",
                "/edits/0/unit/kind",
                {{{"insert_after", 1}, {"unit", Json::object()}}}}));

TEST(UnitsJob, PictureAndTreeNameEveryUnit) {
  const std::string job = flanged_job().dump();
  const std::string svg = answer(job, "svg", NoDefinitions()).text;
  const std::string tree = answer(job, "text", NoDefinitions()).text;
  for (int i = 1; i <= 24; ++i)
    EXPECT_NE(svg.find("class=\"unit" + std::to_string(i) + "\""), std::string::npos) << i;
  EXPECT_NE(tree.find("24 hole  diameter 6"), std::string::npos) << tree;
}

// The drawing of the part: design of units, section 4. Nine round mouths, two slots and one of
// equal diameters where cylinders meet, and one that is not closed on one wall.
TEST(UnitsJob, MouthsOfAManifoldComeWithTheirParameters) {
  const Json found = run(
      {{"job", "units"}, {"operation", "holes"}, {"product_step", content("own_manifold.step")}});
  ASSERT_EQ(found["status"], "ok") << found.dump();
  std::map<std::string, int> kinds;
  bool has_eccentric = false, has_oblique = false;
  for (const Json& mouth : found["mouths"]) {
    ++kinds[mouth["kind"]];
    const double wall = mouth["wall"]["radius"];
    const double radius = mouth["radius"];
    const double angle = mouth["crossing_angle"];
    const double aside = mouth["eccentric_distance"];
    const auto is = [](double a, double b) { return std::abs(a - b) < 5e-5; };
    has_eccentric |= is(wall, 10) && is(radius, 5) && is(angle, 90) && is(aside, 4);
    has_oblique |= is(wall, 10) && is(radius, 4) && is(angle, 45) && is(aside, 0);
    if (mouth["kind"] == "slot") {
      EXPECT_NEAR(mouth["length"].get<double>(), 26, 5e-5);
    }
  }
  EXPECT_TRUE(has_eccentric);
  EXPECT_TRUE(has_oblique);
  EXPECT_GE(kinds["round"], 9);
  EXPECT_EQ(kinds["slot"], 2);
  EXPECT_EQ(kinds["equal_diameters"], 1);
}

}  // namespace
}  // namespace ridgeline::jobs
