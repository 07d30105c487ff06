#include <gtest/gtest.h>

#include <cmath>

#include "core/nc/reader.hpp"
#include "jobs/answer.hpp"
#include "tests/jobs/predict_refusal.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

Json run(const Json& job) {
  return assemble(answer(job.dump(), "json", NoDefinitions()));
}

// A cut that is stable: aluminium, a short tool whose modes are given.
Json chamfer_job() {
  return Json::parse(R"({
    "job": "predict",
    "along": {
      "job": "chamfer",
      "workpiece": {"shape": "thick_walled_cylinder", "inner_radius": 10, "outer_radius": 18,
                    "length": 80, "holes": [{"name": "port", "shape": "circle", "radius": 4,
                                             "eccentric_distance": 3}]},
      "hole": "port", "edge": "inner",
      "tool": {"number": 12, "shape": "lollipop", "radius": 2.9, "neck_radius": 1.75,
               "neck_length": 40, "shank_radius": 3, "stickout": 60, "flutes": 3,
               "helix_angle": 30},
      "cutting_amount": 0.2, "points": 12, "feed": 1200, "spindle_speed": 8000},
    "material": {"name": "aluminium", "Ktc": 796.1, "Krc": 168.8, "Kte": 27.7, "Kre": 30.8},
    "dynamics": {"modes": [[2200, 0.03, 4000]]},
    "N": 512, "nq": 128})");
}

TEST(PredictChamfer, AnswersArraysAlongTheEdge) {
  const Json result = run(chamfer_job());
  ASSERT_EQ(result["status"], "ok") << result.dump(1);
  EXPECT_EQ(result["along"], "chamfer");
  for (const char* key : {"position", "force", "deflection", "error", "stability", "width", "way",
                          "centre", "normal", "parameter", "loops"})
    EXPECT_EQ(result[key].size(), 12U) << key;
  for (const Json& stability : result["stability"]) EXPECT_EQ(stability, "stable");
  EXPECT_EQ(result["dynamics"]["estimate"], false);
  EXPECT_EQ(result["material"]["Ktc"], 796.1);
  // The ball centre stands above the tip, which the program drives, along Z.
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_NEAR(result["centre"][i][2].get<double>() - result["position"][i][2].get<double>(), 2.9,
                1e-9);
}

// A rigid tool cuts the chamfer that was asked for.
TEST(PredictChamfer, RigidToolKeepsTheWidth) {
  Json job = chamfer_job();
  job["dynamics"] = {{"modes", Json::array()}};
  job["nq"] = 512;
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump(1);
  for (const Json& width : result["width"])
    EXPECT_NEAR(width.get<double>(), std::sqrt(2.0) * 0.2, 0.002);
}

// The time domain knows nothing of the iteration but the chips.
TEST(PredictChamfer, TheTimeDomainAgreesWithTheIterationAlongTheEdge) {
  Json job = chamfer_job();
  job["along"]["points"] = 4;
  const Json iterated = run(job);
  job["method"] = "time_domain";
  const Json stepped = run(job);
  ASSERT_EQ(stepped["status"], "ok") << stepped.dump(1);
  EXPECT_EQ(stepped["method"], "time_domain");
  EXPECT_EQ(stepped["report"]["stability_tested"], 4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(stepped["error"][i].get<double>(), iterated["error"][i].get<double>(), 5e-4);
    EXPECT_NEAR(stepped["width"][i].get<double>(), iterated["width"][i].get<double>(), 1e-3);
    EXPECT_GT(stepped["loops"][i].get<int>(), 2);
  }
}

TEST(PredictChamfer, CorrectionLeavesLittleAndMovesTheProgram) {
  Json job = chamfer_job();
  const Json before = run(job);
  job["correct"] = true;
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump(1);
  const Json& corrected = result["corrected"];
  int moved = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    const double original = before["error"][i].get<double>();
    EXPECT_EQ(result["error"][i], before["error"][i]);
    EXPECT_LE(std::abs(corrected["error"][i].get<double>()),
              std::max(0.0005, 0.05 * std::abs(original)));
    double shift = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double by = corrected["shift"][i][c].get<double>();
      EXPECT_NEAR(
          corrected["position"][i][c].get<double>() - result["position"][i][c].get<double>(), by,
          1e-12);
      shift += by * by;
    }
    moved += shift > 0 ? 1 : 0;
  }
  EXPECT_GT(moved, 6);
}

// Aimed at the width, the correction leaves less of its error than one of the surface does.
TEST(PredictChamfer, CorrectionAimsAtTheWidth) {
  const auto worst_width = [](const Json& correct) {
    Json job = chamfer_job();
    job["correct"] = correct;
    const Json result = run(job);
    EXPECT_EQ(result["status"], "ok") << result.dump(1);
    double worst = 0;
    for (const Json& width : result["corrected"]["width"])
      worst = std::max(worst, std::abs(width.get<double>() - std::sqrt(2.0) * 0.2));
    return worst;
  };
  const double by_surface = worst_width(true);
  const double by_width = worst_width({{"aim", "width"}});
  EXPECT_LT(by_width, by_surface);
  EXPECT_LT(by_width, 0.003);
}

// The corrected program, predicted again, cuts what was wanted.
TEST(PredictChamfer, WritesTheCorrectedProgram) {
  Json job = chamfer_job();
  job["correct"] = true;
  const Answer corrected = answer(job.dump(), "nc", NoDefinitions());
  ASSERT_FALSE(is_error(corrected)) << corrected.document.dump(1);
  EXPECT_NE(corrected.text.find("CORRECTED FOR TOOL DEFLECTION"), std::string::npos);
  const Answer nominal = answer(job["along"].dump(), "nc", NoDefinitions());
  ASSERT_FALSE(is_error(nominal)) << nominal.document.dump(1);
  EXPECT_NE(corrected.text, nominal.text);
}

TEST(PredictChamfer, DrawsAndLists) {
  const Json job = chamfer_job();
  const Answer list = answer(job.dump(), "csv", NoDefinitions());
  EXPECT_EQ(std::count(list.text.begin(), list.text.end(), '\n'), 13);
  EXPECT_EQ(list.text.find("nan"), std::string::npos);
  EXPECT_EQ(list.text.find(",-0,"), std::string::npos);
  const Answer drawing = answer(job.dump(), "svg", NoDefinitions());
  EXPECT_NE(drawing.text.find("Width of the chamfer"), std::string::npos);
  EXPECT_EQ(drawing.text.find("nan"), std::string::npos);
}

TEST(PredictChamfer, SpreadFollowsTheUncertainty) {
  Json job = chamfer_job();
  EXPECT_FALSE(run(job).contains("spread"));
  job["uncertainty"] = {{"Kc", 0.1}, {"Ke", 0.2}, {"stiffness", 0.1}};
  const Json once = run(job)["spread"];
  job["uncertainty"] = {{"Kc", 0.2}, {"Ke", 0.4}, {"stiffness", 0.2}};
  const Json twice = run(job)["spread"];
  ASSERT_EQ(once.size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_GT(once[i].get<double>(), 0);
    EXPECT_NEAR(twice[i].get<double>(), 2 * once[i].get<double>(), 1e-12);
  }
}

// Once more round cuts what deflection left: less force, less error. The time domain, which knows
// no iteration, says the same; the widths come nearer to the wanted one.
TEST(PredictChamfer, SpringPassTakesMostOfTheErrorAway) {
  Json job = chamfer_job();
  job["stability"] = "none";
  const Json plain = run(job);
  job["along"]["spring_pass"] = true;
  const Json spring = run(job);
  job["method"] = "time_domain";
  const Json by_time = run(job);
  ASSERT_EQ(spring["status"], "ok") << spring.dump(1);
  ASSERT_EQ(spring["error"].size(), 12U);
  for (std::size_t i = 0; i < 12; ++i) {
    SCOPED_TRACE(i);
    const double before = plain["error"][i], after = spring["error"][i];
    EXPECT_GT(after, 0);
    EXPECT_LT(after, before / 2);
    EXPECT_NEAR(by_time["error"][i].get<double>(), after, 0.05 * after);
    const double width = std::sqrt(2.0) * 0.2;
    EXPECT_LT(std::abs(spring["width"][i].get<double>() - width),
              std::abs(plain["width"][i].get<double>() - width));
  }
}

// The pass that finishes is the one that is shifted: what is left after it is within the limit, by
// less of a shift than without the spring pass, and the finishing pass stays where it was.
TEST(PredictChamfer, CorrectsTheSpringPass) {
  Json job = chamfer_job();
  job["along"]["spring_pass"] = true;
  job["correct"] = {{"residual", 1e-4}};
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump(1);
  Json plain = job;
  plain["along"]["spring_pass"] = false;
  const Json alone = run(plain);
  const auto length = [](const Json& row) {
    return Eigen::Vector3d(row[0], row[1], row[2]).norm();
  };
  int moved = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    SCOPED_TRACE(i);
    EXPECT_LE(std::abs(result["corrected"]["error"][i].get<double>()), 1e-4);
    EXPECT_LT(length(result["corrected"]["shift"][i]), length(alone["corrected"]["shift"][i]));
    EXPECT_EQ(length(result["corrected"]["finish_shift"][i]), 0);
    moved += length(result["corrected"]["shift"][i]) > 0 ? 1 : 0;
  }
  EXPECT_GT(moved, 6);
  // Of the program only the last pass has moved.
  const Answer written = answer(job.dump(), "nc", NoDefinitions());
  ASSERT_FALSE(is_error(written)) << written.document;
  const Answer nominal = answer(job["along"].dump(), "nc", NoDefinitions());
  const std::vector<path::Move> was = nc::read(nominal.text).motion.moves;
  const std::vector<path::Move> is = nc::read(written.text).motion.moves;
  ASSERT_EQ(is.size(), was.size());
  std::size_t same = 0;
  while (same < is.size() && is[same].to == was[same].to) ++same;
  EXPECT_GT(same, 12U);              // the way in and a whole round
  EXPECT_LT(same, is.size() - 12U);  // another round and the way out
}

// Where the finishing pass cuts too deep nothing is left for the spring pass: there it is drawn
// back itself, elsewhere it stays, and the edge ends within the limit all round.
TEST(PredictChamfer, DrawsBackAFinishThatCutsTooDeep) {
  Json job = chamfer_job();
  job["speed_rpm"] = 15000;
  job["correct"] = {{"residual", 1e-4}};
  const Json finish = run(job);
  job["along"]["spring_pass"] = true;
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump(1);
  int drawn_back = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    SCOPED_TRACE(i);
    EXPECT_LE(std::abs(result["corrected"]["error"][i].get<double>()), 1e-4);
    const Json &shift = result["corrected"]["finish_shift"][i], &n = result["normal"][i];
    double out = 0;
    for (std::size_t c = 0; c < 3; ++c) out += shift[c].get<double>() * n[c].get<double>();
    const bool too_deep = finish["error"][i].get<double>() < -1e-4;
    EXPECT_EQ(out > 0, too_deep);
    EXPECT_GE(out, 0);
    drawn_back += too_deep ? 1 : 0;
  }
  EXPECT_GE(drawn_back, 1);
}

// A rigid tool leaves nothing: the spring pass has no more than the cusps of the feed to cut.
TEST(PredictChamfer, SpringPassOfARigidToolChangesNothing) {
  Json job = chamfer_job();
  job["dynamics"] = {{"modes", Json::array()}};
  job["along"]["spring_pass"] = true;
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump(1);
  for (const Json& error : result["error"]) {
    if (error.is_null()) continue;              // nothing of the surface is left to be made
    EXPECT_NEAR(error.get<double>(), 0, 1e-4);  // the grid of N and nq
  }
}

// A tool of which only the shape is known is estimated, and says so.
TEST(PredictChamfer, BeamFromGeometryIsAnEstimate) {
  Json job = chamfer_job();
  job.erase("dynamics");
  job["stability"] = "none";
  job["method"] = "rigid";
  const Json result = run(job);
  ASSERT_EQ(result["status"], "ok") << result.dump(1);
  EXPECT_EQ(result["dynamics"]["estimate"], true);
  EXPECT_FALSE(result["dynamics"]["modes_x"].empty());
  EXPECT_NE(result["warnings"].dump().find("estimate"), std::string::npos);
}

class PredictChamferRefusal : public testing::TestWithParam<PredictRefusal> {};

TEST_P(PredictChamferRefusal, NamesTheField) {
  expect_refused(chamfer_job(), GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Table, PredictChamferRefusal,
    testing::Values(
        PredictRefusal{"NoMaterial", R"({"material": null})", "bad_input", "/material"},
        PredictRefusal{"UnknownMaterial", R"({"material": "unobtainium"})", "unknown_material",
                       "/material"},
        PredictRefusal{"UnknownPath", R"({"along": {"job": "dance"}})", "bad_input", "/along/job"},
        PredictRefusal{"PathWithoutWidth", R"({"along": {"cutting_amount": null}})", "bad_input",
                       "/along/width"},
        PredictRefusal{"FeedBeyondTheTool", R"({"along": {"feed": 500000}})", "bad_input",
                       "/along/feed"},
        PredictRefusal{"TooManyPlaces", R"({"N": 65536, "nq": 1024})", "bad_input", "/N"},
        PredictRefusal{"UnknownKey", R"({"steel": 1})", "bad_input", "/steel"},
        PredictRefusal{"NegativeCoefficient", R"({"material": {"Ktc": -1}})", "bad_input",
                       "/material/Ktc"},
        PredictRefusal{"OneDirectionOnly",
                       R"({"dynamics": {"modes": null, "modes_x": [[1000, 0.03, 1000]]}})",
                       "bad_input", "/dynamics/modes_y"},
        PredictRefusal{"SoftToolChatters",
                       R"({"dynamics": {"modes": [[600, 0.03, 150]]}, "correct": true})",
                       "not_converged", "/correct"},
        PredictRefusal{"NoSpeed", R"({"along": {"spindle_speed": 0}})", "bad_input", "/speed_rpm"}),
    [](const auto& refused) { return refused.param.name; });

}  // namespace
}  // namespace ridgeline::jobs
