#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {
namespace {

using nlohmann::json;

json answered(const json& job, const std::string& format = "json") {
  return assemble(answer(job.dump(), format, NoDefinitions()));
}

/// The moves that go somewhere.
std::vector<json> moves_of(const json& result) {
  std::vector<json> moves;
  json at;
  for (const json& move : result.at("motion")) {
    if (move.at("kind") == "arc" || move.at("machine") != at) moves.push_back(move);
    at = move.at("machine");
  }
  return moves;
}

TEST(MacroJob, RunGivesMotionVariablesAndState) {
  const json result =
      answered({{"job", "macro"},
                {"program",
                 "O1\nT5 M06\nS800 M03\nG00 X1. Y2. Z3.\nG01 X4. F100\n#101=#100*2\n"
                 "#102=#0\n#3006=1(LOOK)\nG04 P500\nG02 X4. Y6. J2.\nM30\n"},
                {"set", {{"#100", 5}}}});
  ASSERT_EQ(result.at("status"), "ok") << result.dump();
  EXPECT_EQ(result.at("variables").at("101"), 10);
  EXPECT_TRUE(result.at("variables").at("102").is_null());
  EXPECT_EQ(result.at("messages"), json::array({"LOOK"}));
  EXPECT_EQ(result.at("tool"), 5);
  EXPECT_EQ(result.at("spindle_speed"), 800);
  EXPECT_EQ(result.at("position"), json::array({4, 6, 3}));
  const json& motion = result.at("motion");
  ASSERT_EQ(motion.size(), 4U);
  EXPECT_EQ(motion[0], json({{"kind", "rapid"},
                             {"to", {1, 2, 3}},
                             {"machine", {1, 2, 3}},
                             {"feed", 0},
                             {"program", 1},
                             {"line", 4}}));
  EXPECT_EQ(motion[1].at("feed"), 100);
  EXPECT_EQ(motion[2].at("kind"), "dwell");
  EXPECT_EQ(motion[2].at("seconds"), 0.5);
  EXPECT_EQ(motion[3].at("plane"), "XY");
  EXPECT_EQ(motion[3].at("sense"), "cw");
  EXPECT_EQ(motion[3].at("centre"), json::array({4, 4, 3}));
  EXPECT_EQ(motion[3].at("turns"), 0);
}

TEST(MacroJob, AnAlarmKeepsWhatWasDone) {
  const json result = answered({{"job", "macro"}, {"program", "O7\nG00 X1.\n#1=5/[#2-#2]\nM30\n"}});
  EXPECT_EQ(result.at("status"), "alarm");
  EXPECT_EQ(result.at("alarm").at("number"), 112);
  EXPECT_EQ(result.at("alarm").at("program"), 7);
  EXPECT_EQ(result.at("alarm").at("line"), 3);
  EXPECT_EQ(result.at("alarm").at("column"), 5);
  EXPECT_EQ(result.at("motion").size(), 1U);
}

TEST(MacroJob, SubprogramsProfilesOffsetsAndToolsComeWithTheJob) {
  const json result =
      answered({{"job", "macro"},
                {"program", "G65 P9100 A3.\nG55 G00 X1.\n#110=#5021\n#111=#13002\nM30\n"},
                {"programs", {{"9100", "O9100\n#100=#1\nM99\n"}}},
                {"profile", "0i"},
                {"wcs", {{"55", {100, 0, 0}}}},
                {"tools", {{"2", {{"D", 4.5}}}}}});
  ASSERT_EQ(result.at("status"), "ok") << result.dump();
  EXPECT_EQ(result.at("variables").at("100"), 3);
  EXPECT_EQ(result.at("variables").at("110"), 101);
  EXPECT_EQ(result.at("variables").at("111"), 4.5);
}

TEST(MacroJob, ParametersOfTheControlAndProgramsByName) {
  json job = {{"job", "macro"},
              {"program", "O1\nG100A5.\nM98<Sub-1>\n#102=PRM[1240]/[3]+PRM[3401,0]\nM30"},
              {"programs", {{"9010", "#100=#1\nM99"}, {"sub-1", "#101=7\nM99"}}},
              {"profile", {{"parameters", {{"6050", 100}, {"1240", {0, 0, 25}}, {"3401#0", 1}}}}}};
  const json result = answered(job);
  ASSERT_EQ(result.at("status"), "ok") << result.dump();
  EXPECT_EQ(result.at("variables"), (json{{"100", 5}, {"101", 7}, {"102", 26}}));
  job["profile"]["parameters"]["6050"] = 100.5;
  EXPECT_EQ(answered(job).at("error").at("field"), "/profile/parameters/6050");
  job["profile"]["parameters"] = {{"3401", 1e10}, {"3401#0", 1}};
  EXPECT_EQ(answered(job).at("error").at("field"), "/profile/parameters/3401#0");
  job["profile"]["parameters"] = {{"x", 1}};
  EXPECT_EQ(answered(job).at("error").at("code"), "bad_input");
}

TEST(MacroJob, RefusesWhatItDoesNotKnow) {
  const auto field = [](const json& job) {
    const json result = answered(job);
    return result.at("status") == "error" ? result.at("error").value("field", "") : "no error";
  };
  EXPECT_EQ(field({{"job", "macro"}, {"program", "M30"}, {"profile", "99i"}}), "/profile");
  EXPECT_EQ(field({{"job", "macro"}, {"program", "M30"}, {"set", {{"x", 1}}}}), "/set");
  EXPECT_EQ(field({{"job", "macro"}, {"program", 5}}), "/program");
  EXPECT_EQ(field({{"job", "macro"}}), "/program");
  EXPECT_EQ(field({{"job", "macro"}, {"program", "M30"}, {"extra", 1}}), "/extra");
}

TEST(MacroJob, ExpandedCodeRunsToTheSameMotion) {
  const json job = {{"job", "macro"},
                    {"program",
                     "G90 G54 G00 X0 Y0 Z5.\nG43 H1 Z2.\n#1=0\nWHILE[#1 LT 5]DO1\nG01 X[#1*10] "
                     "Y[SIN[#1*20]] F300\n#1=#1+1\nEND1\nG03 X0 Y0 R30.\nG52 X1.\nG02 X4. I2.5 "
                     "J0\nG55 G00 X3. Y0 Z1.\nG19 G03 Y5. Z3. K2. J2.1\nG53 Z0\nG91 G28 X0\nM30\n"},
                    {"wcs", {{"54", {1, 2, 3}}, {"55", {-10, 20, 0}}}},
                    {"tools", {{"H1", 50}}}};
  const Answer expanded = answer(job.dump(), "nc", NoDefinitions());
  json again = job;
  again["program"] = expanded.text;
  const json run = answered(job);
  const json run_again = answered(again);
  ASSERT_EQ(run.at("status"), "ok") << run.at("alarm");
  ASSERT_EQ(run_again.at("status"), "ok") << run_again.at("alarm") << "\n" << expanded.text;
  const std::vector<json> first = moves_of(run), second = moves_of(run_again);
  EXPECT_EQ(first.size(), 12U);
  ASSERT_EQ(first.size(), second.size()) << expanded.text;
  for (std::size_t i = 0; i < first.size(); ++i) {
    SCOPED_TRACE(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(first[i].at("machine")[axis].get<double>(),
                  second[i].at("machine")[axis].get<double>(), 1e-3);
    }
    EXPECT_EQ(first[i].at("kind"), second[i].at("kind"));
    EXPECT_EQ(first[i].value("sense", ""), second[i].value("sense", ""));
    EXPECT_EQ(first[i].value("plane", ""), second[i].value("plane", ""));
  }
}

TEST(MacroJob, CheckReportsLikelyMistakes) {
  const json result = answered(
      {{"job", "macro"},
       {"operation", "check"},
       {"program",
        "O1\n#1=0.1\nWHILE[#1 NE 1]DO1\n#1=#1+0.1\nEND1\nGOTO 99\nG00 X1.\nN5 #2=#5021\nWHILE[#2 "
        "GT 1]DO2\nM30\n"}});
  ASSERT_EQ(result.at("status"), "ok");
  std::vector<std::pair<std::string, int>> found;
  for (const json& finding : result.at("findings")) {
    found.emplace_back(finding.at("rule"), finding.at("line"));
  }
  const std::vector<std::pair<std::string, int>> expected = {
      {"real_equality", 3}, {"adds_up", 4},    {"goto_target", 6},
      {"unreachable", 7},   {"look_ahead", 8}, {"missing_end", 9}};
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace ridgeline::jobs
