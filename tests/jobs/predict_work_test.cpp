#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/nc/reader.hpp"
#include "jobs/answer.hpp"
#include "tests/jobs/predict_refusal.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

Json run(const Json& job) {
  return assemble(answer(job.dump(), "json", NoDefinitions()));
}

// Two passes of a ball over the flat top of a block.
Json program_job() {
  Json job = Json::parse(R"({
    "job": "predict",
    "along": {"job": "program", "program": "", "step": 2,
              "stock": {"min": [0, -6, -10], "max": [20, 6, 0], "cell": 0.1}},
    "tool": {"number": 3, "shape": "ball", "radius": 3, "flutes": 2, "helix_angle": 30},
    "material": {"Ktc": 796.1, "Krc": 168.8, "Kte": 27.7, "Kre": 30.8},
    "dynamics": {"modes": [[1100, 0.03, 4000]]},
    "stability": "none", "N": 512, "nq": 128})");
  job["along"]["program"] =
      "%\nO7\nG90 G54\nS8000 M3\nG0 Z20.\nG0 X-4. Y0.\nG0 Z2.\nG1 Z-0.3 F500.\nX24. F1600.\nZ2.\n"
      "G0 X-4. Y0.5\nG1 Z-0.3 F500.\nX24. F1600.\nG0 Z20.\nM30\n%\n";
  return job;
}

double mean_force(const Json& result, std::size_t i) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += std::pow(result["mean_force"][i][c].get<double>(), 2);
  return std::sqrt(sum);
}

// Station of a pass over the middle of the block.
std::size_t at_middle(const Json& result, double y) {
  for (std::size_t i = 0; i < result["position"].size(); ++i) {
    const Json& p = result["position"][i];
    if (std::abs(p[1].get<double>() - y) < 1e-9 && std::abs(p[0].get<double>() - 10) < 1.1)
      return i;
  }
  ADD_FAILURE() << "no station in the middle of the pass at y = " << y;
  return 0;
}

TEST(PredictProgram, FindsWhatEachPassCuts) {
  const Json result = run(program_job());
  ASSERT_EQ(result["status"], "ok") << result.dump(1);
  EXPECT_EQ(result["along"], "program");
  EXPECT_EQ(result["speed_rpm"], 8000);
  const std::size_t first = at_middle(result, 0), second = at_middle(result, 0.5);
  // The second pass finds the first one's groove: it cuts far less.
  EXPECT_GT(mean_force(result, second), 0);
  EXPECT_LT(mean_force(result, second), 0.8 * mean_force(result, first));
  // Before the block and after it nothing is cut, and the floor is made only where there is stock.
  int silent = 0;
  for (std::size_t i = 0; i < result["position"].size(); ++i) {
    const double x = result["position"][i][0].get<double>();
    EXPECT_EQ(result["error"][i].is_null(), x < 0 || x > 20) << x;
    silent += mean_force(result, i) == 0 ? 1 : 0;
  }
  EXPECT_GT(silent, 2);
  EXPECT_LT(result["report"]["error"]["max"].get<double>(), 0.05);
}

// The height map and the exact plane are the same stock: a slot in the flat top, bilinear cells.
TEST(PredictProgram, AgreesWithTheExactPlane) {
  const Json along = run(program_job());
  const std::size_t i = at_middle(along, 0);
  Json job = Json::parse(R"({
    "job": "predict", "speed_rpm": 8000, "stability": "none",
    "case": {"tool": {"kind": "ball", "r": 3, "z": 2, "helix_deg": 30, "nq": 128}, "N": 512,
             "feed_per_tooth": 0.1, "coef": {"Ktc": 796.1, "Krc": 168.8, "Kte": 27.7, "Kre": 30.8},
             "engagement": {"normal": [0, 0, 1], "c": 0.3},
             "modes_x": [[1100, 0.03, 4000]], "modes_y": [[1100, 0.03, 4000]]},
    "options": {"alpha": 1e-4}})");
  const Json exact = run(job);
  ASSERT_EQ(exact["status"], "ok") << exact.dump(1);
  EXPECT_NEAR(along["error"][i].get<double>(), exact["e_mm"].get<double>(), 2e-4);
}

TEST(PredictProgram, WritesTheCorrectedProgram) {
  Json job = program_job();
  job["correct"] = true;
  job["along"]["normal"] = {0, 0, 1};
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump().substr(0, 600);
  const Answer written = answer(job.dump(), "nc", NoDefinitions());
  const nc::Reading reading = nc::read(written.text);
  const nc::Reading nominal = nc::read(job["along"]["program"].get<std::string>());
  EXPECT_EQ(reading.motion.moves.back().to, nominal.motion.moves.back().to);
  double deepest = 0;
  for (const path::Move& move : reading.motion.moves) deepest = std::min(deepest, move.to.z());
  EXPECT_LE(deepest, -0.3);
  for (const Json& error : result["corrected"]["error"])
    if (!error.is_null()) {
      EXPECT_LE(std::abs(error.get<double>()), 0.0005);
    }
}

// A work plane leaning by so many degrees over the flat top of a block.
Json tilted_job(int degrees) {
  Json job = program_job();
  job["along"]["program"] =
      "%\nO1\nG21 G90 G17\nT12 M6\nS8000 M3\nG54\nG68.2 X0. Y0. Z0. I90. J" +
      std::to_string(degrees) +
      ". K-90.\nG53.1\nG0 G43 H12 Z20.\nG0 X0. Y-6.\nG0 Z5.\nG1 Z-0.1 F300\nG1 Y6. F800\n"
      "G0 Z20.\nG69\nM30\n%\n";
  job["along"]["stock"] = {{"min", {-12, -12, -6}}, {"max", {12, 12, 0}}, {"cell", 0.2}};
  job["along"]["step"] = 3;
  return job;
}

// The ball's centre stands off the tip along the leaning axis.
TEST(PredictProgram, FollowsATiltedTool) {
  const Json job = tilted_job(20);
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump().substr(0, 600);
  ASSERT_GT(result["centre"].size(), 2U);
  const double lean = 20 * 3.14159265358979 / 180, r = job["tool"]["radius"];
  for (std::size_t i = 0; i < result["centre"].size(); ++i) {
    const Json &centre = result["centre"][i], &tip = result["position"][i];
    EXPECT_NEAR(centre[0].get<double>() - tip[0].get<double>(), r * std::sin(lean), 1e-9);
    EXPECT_NEAR(centre[2].get<double>() - tip[2].get<double>(), r * std::cos(lean), 1e-9);
    EXPECT_GT(result["force"][i][2].get<double>(), 0);
  }
}

TEST(PredictProgram, SaysWhichAxisComesFromBelow) {
  Json job = program_job();
  job["along"]["tool_axis"] = {0, 0.6, -0.8};
  const Json error = run(job).at("error");
  EXPECT_EQ(error["code"], "unsupported");
  EXPECT_EQ(error["value"], "an axis with Z -0.8");
  EXPECT_NE(error["message"].get<std::string>().find("is an axis with Z -0.8"), std::string::npos)
      << error;
}

// The corrected program of a leaning tool, predicted itself, leaves the shift and what the
// correction said is left: both along the same normal. It says its plane, and moves nothing else.
TEST(PredictProgram, CorrectsATiltedTool) {
  const double lean = 25 * 3.14159265358979 / 180;
  Json job = tilted_job(25);
  const Json before = run(job);
  job["correct"] = {{"residual", 2e-4}, {"relative", 0.0}};
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump().substr(0, 600);
  const Json& after = result["corrected"];
  const Answer written = answer(job.dump(), "nc", NoDefinitions());
  ASSERT_FALSE(is_error(written)) << written.document;
  EXPECT_NE(written.text.find("G68.2"), std::string::npos);
  const nc::Reading reading = nc::read(written.text);
  ASSERT_TRUE(reading.tool_axis);
  EXPECT_NEAR(reading.tool_axis->x(), std::sin(lean), 1e-6);
  Json again = job;
  again.erase("correct");
  again["along"]["program"] = written.text;
  again["along"]["step"] = 3.1;  // its blocks are the stations, a little longer for the shift
  const Json predicted = run(again);
  ASSERT_EQ(predicted["status"], "ok") << predicted.dump().substr(0, 600);
  ASSERT_EQ(predicted["error"].size(), result["error"].size());
  int compared = 0;
  for (std::size_t i = 0; i < predicted["error"].size(); ++i) {
    EXPECT_EQ(result["error"][i], before["error"][i]);
    if (after["error"][i].is_null()) continue;
    EXPECT_LE(std::abs(after["error"][i].get<double>()), 2e-4);
    const double shift = -after["shift"][i][2].get<double>();  // down, into the flat floor
    EXPECT_NEAR(after["shift"][i][0].get<double>(), 0, 1e-12);
    EXPECT_GT(shift, 1e-3);
    if (predicted["error"][i].is_null()) continue;
    EXPECT_NEAR(predicted["error"][i].get<double>() - shift, after["error"][i].get<double>(), 5e-4);
    ++compared;
  }
  EXPECT_GE(compared, 2);
}

// Bottom R of the oracle's cycle 15, in a block that leaves something on its wall and floor.
TEST(PredictCycle, TakesTheNormalsOfTheCycle) {
  std::ifstream in(RIDGELINE_TESTS "/oracle/cycles/15_bottomR_straight_1_ball.json");
  const Json oracle = Json::parse(in);
  Json job = program_job();
  job["along"] = {{"job", "cycle"},
                  {"family", oracle["family"]},
                  {"method", oracle["method"]},
                  {"params", oracle["params"]},
                  {"stock", {{"min", {-12, -14, -30}}, {"max", {12, 8, 0}}, {"cell", 0.2}}},
                  {"step", 5}};
  job["along"]["params"]["x_pitch"] = "5";
  job["tool"]["radius"] = 4;
  job["speed_rpm"] = 8000;
  job["method"] = "rigid";
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump().substr(0, 600);
  EXPECT_EQ(result["along"], "cycle");
  int slanted = 0;
  for (const Json& n : result["normal"]) {
    const double y = n[1].get<double>(), z = n[2].get<double>();
    EXPECT_NEAR(n[0].get<double>() * n[0].get<double>() + y * y + z * z, 1, 1e-9);
    slanted += std::abs(y) > 0.3 && std::abs(z) > 0.3 ? 1 : 0;
  }
  EXPECT_GT(slanted, 5);
  EXPECT_GT(result["report"]["stations_cutting"].get<int>(), 0);
  job["tool"]["radius"] = 3;
  EXPECT_EQ(run(job)["error"]["field"], "/along/params/r");
}

class PredictProgramRefusal : public testing::TestWithParam<PredictRefusal> {};

TEST_P(PredictProgramRefusal, NamesTheField) {
  expect_refused(program_job(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Table, PredictProgramRefusal,
    testing::Values(
        PredictRefusal{"NoTool", R"({"tool": null})", "bad_input", "/tool"},
        PredictRefusal{"NoStock", R"({"along": {"stock": null}})", "bad_input", "/along/stock"},
        PredictRefusal{"StockInsideOut", R"({"along": {"stock": {"max": [-1, 0, 0]}}})",
                       "bad_input", "/along/stock/max"},
        PredictRefusal{"TooFineStock", R"({"along": {"stock": {"cell": 0.001}}})", "bad_input",
                       "/along/stock/cell"},
        PredictRefusal{"NotAProgram", R"({"along": {"program": "hello"}})", "bad_file", "line 1"},
        PredictRefusal{
            "NothingCuts",
            R"({"along": {"program": "S8000 M3\nG90 G54\nG0 X0. Y0. Z5.\nG0 X9.\nM30\n"}})",
            "bad_input", "/along"},
        PredictRefusal{"NoKey", R"({"along": {"speed": 1}})", "bad_input", "/along/speed"}),
    [](const auto& refused) { return refused.param.name; });

}  // namespace
}  // namespace ridgeline::jobs
