#include <gtest/gtest.h>

#include <complex>
#include <filesystem>
#include <fstream>

#include "jobs/answer.hpp"
#include "tests/jobs/predict_refusal.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

Json file(const std::filesystem::path& path) {
  std::ifstream in(path);
  return Json::parse(in);
}

Json run(const Json& job, std::string_view format = "json") {
  return assemble(answer(job.dump(), format, NoDefinitions()));
}

// The job of an oracle file: its own keys under "job": "predict".
Json job_of(const Json& oracle) {
  Json job = {{"job", "predict"}, {"stability", "none"}};
  for (const char* key : {"case", "speed_rpm", "options", "warm_from"})
    if (oracle.contains(key)) job[key] = oracle[key];
  return job;
}

Json oracle_job() {
  return job_of(file(RIDGELINE_TESTS "/oracle/error/01-ball-down-milling-1-groove.json"));
}

void expect_equal(double actual, const Json& expected) {
  EXPECT_NEAR(actual, expected.get<double>(), 1e-9 * std::abs(expected.get<double>()));
}

void expect_rows(const Json& actual, const Json& expected, std::size_t every) {
  ASSERT_EQ(actual.size(), expected.size() * every);
  double greatest = 0;
  for (const Json& row : expected)
    for (const Json& value : row) greatest = std::max(greatest, std::abs(value.get<double>()));
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (std::size_t c = 0; c < expected[i].size(); ++c)
      EXPECT_NEAR(actual[i * every][c].get<double>(), expected[i][c].get<double>(),
                  1e-9 * greatest);
}

// The whole contract of interfaces.md, key for key, on every file of the oracle.
TEST(PredictJob, AnswersTheOracleKeyForKey) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(RIDGELINE_TESTS "/oracle/error")) {
    const Json oracle = file(entry.path());
    if (!oracle.contains("iterate")) continue;
    SCOPED_TRACE(entry.path().filename().string());
    ++files;
    const Json result = run(job_of(oracle));
    const Json& expected = oracle["iterate"];
    ASSERT_EQ(result["status"], "ok") << result.dump();
    EXPECT_EQ(result["job"], "predict");
    EXPECT_EQ(result["method"], "iterate");
    expect_equal(result["e_mm"], expected["e_mm"]);
    for (const char* key : {"loops", "converged", "w1_final", "weight_changes"})
      EXPECT_EQ(result[key], expected[key]) << key;
    ASSERT_EQ(result["A"].size(), expected["A"].size());
    for (std::size_t i = 0; i < result["A"].size(); ++i) {
      expect_equal(result["A"][i], expected["A"][i]);
      expect_equal(result["e_hist"][i], expected["e_hist"][i]);
    }
    const auto every = oracle["sample_every"].get<std::size_t>();
    expect_rows(result["F"], expected["F"], every);
    expect_rows(result["D"], expected["D"], every);
    EXPECT_TRUE(result["stability"].is_null());
    EXPECT_GT(result["solve_seconds"].get<double>(), 0);
  }
  EXPECT_EQ(files, 6);
}

TEST(PredictJob, RigidAndTimeDomainAreChoices) {
  const Json oracle = file(RIDGELINE_TESTS "/oracle/error/09-square-down-milling-helix-5.json");
  Json job = job_of(oracle);
  job["method"] = "rigid";
  const Json rigid = run(job);
  expect_equal(rigid["e_mm"], oracle["rigid"]["e_mm"]);
  EXPECT_EQ(rigid["loops"], 1);
  EXPECT_EQ(rigid["method"], "rigid");
  job["method"] = "time_domain";
  const Json stepped = run(job);
  EXPECT_EQ(stepped["method"], "time_domain");
  EXPECT_NEAR(stepped["e_mm"].get<double>(), 0.0053171297, 1e-9 * 5);
  EXPECT_EQ(stepped["revolutions"], 12);
}

// Fixed weights do not converge here (case 05); asked to, the answer comes from the time domain.
TEST(PredictJob, FallsBackToTheTimeDomainAndSaysSo) {
  Json job =
      job_of(file(RIDGELINE_TESTS "/oracle/error/05-same-fixed-weights-not-converging.json"));
  job["options"]["fall_back"] = true;
  const Json result = run(job);
  EXPECT_EQ(result["method"], "time_domain");
  EXPECT_EQ(result["fell_back"], true);
  EXPECT_EQ(result["converged"], false);
  EXPECT_EQ(result["loops"], 60);
  EXPECT_NEAR(result["e_mm"].get<double>(), 0.012901207, 1e-8);
}

// At one speed the vibration outgrows the tool, which alone is refused; the other has its answer.
TEST(PredictJob, SweepTellsTheSpeedThatOutgrowsTheTool) {
  Json job = Json::parse(R"({"job": "predict", "speeds_rpm": [6000, 100000], "case": {
    "tool": {"kind": "square", "r": 5, "z": 4, "helix_deg": 30, "nq": 32,
             "pitch_deg": [85, 95, 88, 92]}, "N": 256, "feed_per_tooth": 0.05,
    "coef": {"Ktc": 796.1, "Krc": 168.8, "Kac": 222, "Kte": 27.7, "Kre": 30.8, "Kae": 1.4},
    "engagement": {"normal": [-1, 0, 0], "a": 0.5, "ap": 4},
    "modes_x": [[900, 0.02, 4000]], "modes_y": [[950, 0.02, 5000]]}})");
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump();
  EXPECT_TRUE(result["e_mm"][0].is_null());
  EXPECT_TRUE(result["e_mm"][1].is_number());
  EXPECT_EQ(result["stability"], Json({"unstable", "stable"}));
  EXPECT_EQ(result["converged"], Json({false, true}));
  job.erase("speeds_rpm");
  job["speed_rpm"] = 6000;
  EXPECT_EQ(run(job)["error"]["code"], "not_converged");
}

TEST(PredictJob, SweepsTheSpeedAndFlagsChatter) {
  Json job = oracle_job();
  job.erase("speed_rpm");
  job.erase("stability");
  job["case"]["N"] = 512;
  job["speeds_rpm"] = {{"from", 7500}, {"to", 13700}, {"step", 6200}};
  const Json result = run(job);
  ASSERT_EQ(result["speed_rpm"], Json({7500, 13700}));
  EXPECT_EQ(result["stability"], Json({"stable", "flip"}));
  const Answer drawn = answer(job.dump(), "svg", NoDefinitions());
  EXPECT_NE(drawn.text.find("<svg"), std::string::npos);
}

// Insperger's slot, flexible along the feed; |mu| as in tests/core/cutting/benchmark_test.cpp.
TEST(PredictJob, DrawsTheLobes) {
  Json job = Json::parse(R"({
    "job": "predict", "stability": "none", "engaging": "frozen",
    "case": {"tool": {"kind": "square", "r": 10, "z": 2, "nq": 1}, "N": 512, "feed_per_tooth": 1e-5,
             "coef": {"Ktc": 600, "Krc": 200}, "engagement": {"normal": [-1, 0, 0], "a": 20, "ap": 1},
             "modes_x": [], "modes_y": [[922, 0.011, 1340.049648]]},
    "speeds_rpm": [5000, 10000], "depths": {"from": 0.1, "to": 1.5, "steps": 14}})");
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump();
  EXPECT_EQ(result["depth_of"], "ap");
  const double slow = result["depth_limit"][0].get<double>();
  EXPECT_GT(slow, 0.3);                                  // |mu| = 0.91 there
  EXPECT_LT(slow, 0.5);                                  // 1.07
  EXPECT_LT(result["depth_limit"][1].get<double>(), 1);  // 1.23 at 1 mm
  job["depths"] = {{"from", 0.05}, {"to", 0.1}, {"steps", 1}};
  EXPECT_TRUE(run(job)["depth_limit"][0].is_null());
  const Answer drawn = answer(job.dump(), "svg", NoDefinitions());
  EXPECT_NE(drawn.text.find("Stability lobes"), std::string::npos);
  job["depths"]["of"] = "c";
  EXPECT_EQ(run(job)["error"]["field"], "/depths/of");
}

// A response measured every 5 Hz gives nearly what its mode does, and the modes fitted to it the
// stability.
TEST(PredictJob, MeasuredResponseInPlaceOfModes) {
  Json job = oracle_job();
  job.erase("stability");
  const Json modal = run(job);
  Json lines = Json::array();
  for (int i = 0; i < 4000; ++i) {
    const double f = 5.0 * i;
    const std::complex<double> G =
        1 / 2000.0 / std::complex<double>(1 - f * f / 1.21e6, 0.06 * f / 1100);
    lines.push_back({f, G.real(), G.imag()});
  }
  for (const char* axis : {"x", "y"}) {
    job["case"].erase(std::string("modes_") + axis);
    job["case"][std::string("frf_") + axis] = lines;
  }
  const Json measured = run(job);
  ASSERT_EQ(measured["status"], "ok") << measured["error"].dump();
  EXPECT_NEAR(measured["e_mm"].get<double>(), modal["e_mm"].get<double>(), 1e-5);
  EXPECT_EQ(measured["stability"], modal["stability"]);
  EXPECT_NE(measured["warnings"].dump().find("fitted"), std::string::npos);
}

class PredictEngagementRefusal : public testing::TestWithParam<PredictRefusal> {};

TEST_P(PredictEngagementRefusal, NamesTheField) {
  expect_refused(oracle_job(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Table, PredictEngagementRefusal,
    testing::Values(
        PredictRefusal{"NoCase", R"({"case": null})", "bad_input", "/case"},
        PredictRefusal{"UnknownKey", R"({"case": {"speed": 1}})", "bad_input", "/case/speed"},
        PredictRefusal{"NoTeeth", R"({"case": {"tool": {"z": 0}}})", "bad_input", "/case/tool/z"},
        PredictRefusal{"NegativeFeed", R"({"case": {"feed_per_tooth": -0.1}})", "bad_input",
                       "/case/feed_per_tooth"},
        PredictRefusal{"PitchThatDoesNotClose", R"({"case": {"tool": {"pitch_deg": [170, 180]}}})",
                       "bad_input", "/case/tool/pitch_deg"},
        PredictRefusal{"RunoutOfOneTooth", R"({"case": {"tool": {"runout_mm": [0.01]}}})",
                       "bad_input", "/case/tool/runout_mm"},
        PredictRefusal{"TooManyPlaces", R"({"case": {"N": 65536, "tool": {"nq": 4096}}})",
                       "bad_input", "/case/N"},
        PredictRefusal{"StockWithoutDepth", R"({"case": {"engagement": {"c": null}}})", "bad_input",
                       "/case/engagement/c"},
        PredictRefusal{"NoModes", R"({"case": {"modes_x": null}})", "bad_input", "/case/modes_x"},
        PredictRefusal{"UndampedMode", R"({"case": {"modes_x": [[1000, 0, 2000]]}})", "bad_input",
                       "/case/modes_x/0/1"},
        PredictRefusal{"LowPassThroughTheResonance", R"({"options": {"kappa": 0.5}})", "bad_input",
                       "/options/kappa"},
        PredictRefusal{"NoSpeed", R"({"speed_rpm": null})", "bad_input", "/speed_rpm"}),
    [](const auto& refused) { return refused.param.name; });

}  // namespace
}  // namespace ridgeline::jobs
