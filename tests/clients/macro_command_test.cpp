#include <gtest/gtest.h>

#include <algorithm>

#include "tests/clients/process.hpp"

namespace ridgeline::tests {
namespace {

using Json = nlohmann::json;

Finished macro(std::vector<std::string> arguments, const std::string& in = {}) {
  arguments.insert(arguments.begin(), {"macro"});
  arguments.emplace_back("--local");
  return ridgeline(arguments, in);
}

/// Ends of the moves that go somewhere.
std::vector<std::vector<double>> ends_of(const Json& result) {
  std::vector<std::vector<double>> ends;
  for (const Json& move : result.at("motion")) {
    const std::vector<double> to = move.at("to");
    if (ends.empty() || ends.back() != to) ends.push_back(to);
  }
  return ends;
}

constexpr const char* folder = "clients/examples/macro";
constexpr const char* bolt_circle = "clients/examples/macro/O0100.nc";
constexpr const char* taper = "clients/examples/cycles/taper.json";

TEST(MacroCommand, RunsAProgramWithTheProgramsOfAFolder) {
  const Finished finished = macro({"run", bolt_circle, "--library-dir", folder});
  ASSERT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(finished.err, "");
  const Json result = finished.json();
  EXPECT_EQ(result.at("status"), "ok");
  EXPECT_EQ(result.at("variables").at("100"), 8);
  EXPECT_EQ(result.at("tool"), 3);
  EXPECT_EQ(result.at("spindle_speed"), 1200);
  int holes = 0;
  for (const Json& move : result.at("motion"))
    holes += move.at("kind") == "line" && move.at("to")[2] == -12 ? 1 : 0;
  EXPECT_EQ(holes, 8);
  EXPECT_EQ(result.at("position")[2], 50);
}

TEST(MacroCommand, SetGivesVariablesBeforeTheRun) {
  const std::string program = "#110=#100*2\n#111=#101\nIF[#102 EQ #0]THEN #112=7\nM30\n";
  const Finished finished =
      macro({"run", "-", "--set", "#100=5", "--set", "101=-2.5", "--set", "#102="}, program);
  ASSERT_EQ(finished.status, 0) << finished.err;
  const Json variables = finished.json().at("variables");
  EXPECT_EQ(variables.at("110"), 10);
  EXPECT_EQ(variables.at("111"), -2.5);
  EXPECT_EQ(variables.at("112"), 7);
}

TEST(MacroCommand, ParametersChooseTheCodesThatCall) {
  const std::string program =
      "O1\nG100A5.\nM50\n#102=PRM[1240]/[3]\nM30\nO9010\n#100=#1\nM99\nO9001\n#101=7\nM99\n";
  const Finished finished = macro({"run", "-", "--parameter", "6050=100", "--parameter", "6071=50",
                                   "--parameter", "1240=0,0,25"},
                                  program);
  ASSERT_EQ(finished.status, 0) << finished.out;
  EXPECT_EQ(finished.json().at("variables"), (Json{{"100", 5}, {"101", 7}, {"102", 25}}));
  for (const char* bad : {"6050", "6050=x", "=1", "6050=1,"}) {
    EXPECT_EQ(macro({"run", "-", "--parameter", bad}, program).status, 2) << bad;
  }
}

TEST(MacroCommand, BadVariablesAreUsage) {
  for (const char* set : {"100", "#=5", "#100=five", "=5", "#100=5x"}) {
    const Finished finished = macro({"run", "-", "--set", set}, "M30\n");
    EXPECT_EQ(finished.status, 2) << set;
    EXPECT_NE(finished.err.find("--set takes"), std::string::npos) << finished.err;
  }
  const Finished unknown = macro({"run", "-", "--set", "#99999=5"}, "M30\n");
  EXPECT_EQ(unknown.status, 1);
}

TEST(MacroCommand, AnAlarmIsStatus1WithItsPlace) {
  const Finished finished = macro({"run", "-"}, "O7\nG00 X1.\n#1=5/0\nM30\n");
  EXPECT_EQ(finished.status, 1);
  const Json alarm = finished.json().at("alarm");
  EXPECT_EQ(alarm.at("number"), 112);
  EXPECT_EQ(alarm.at("program"), 7);
  EXPECT_EQ(alarm.at("line"), 3);
  EXPECT_EQ(alarm.at("column"), 5);
  EXPECT_NE(finished.err.find("alarm 112"), std::string::npos) << finished.err;
}

TEST(MacroCommand, AProgramThatIsNotThereIsAlarm78) {
  const Finished finished = macro({"run", bolt_circle});
  EXPECT_EQ(finished.status, 1);
  EXPECT_EQ(finished.json().at("alarm").at("number"), 78);
  const Finished no_folder = macro({"run", bolt_circle, "--library-dir", "absent"});
  EXPECT_EQ(no_folder.status, 2);
}

TEST(MacroCommand, ProfilesDiffer) {
  const std::string program = "#100=ATAN[-1]/[-1]\n#101=POW[2,3]\nM30\n";
  EXPECT_EQ(macro({"run", "-"}, program).json().at("variables").at("101"), 8);
  const Finished old = macro({"run", "-", "--profile", "18i"}, program);
  EXPECT_EQ(old.status, 1);
  EXPECT_EQ(macro({"run", "-", "--nat", "1"}, program).json().at("variables").at("100"), -135);
  EXPECT_EQ(macro({"run", "-", "--profile", "99i"}, program).status, 1);
  const std::string move = "G00 X10\nM30\n";
  EXPECT_EQ(macro({"run", "-"}, move).json().at("position")[0], 0.01);
  EXPECT_EQ(macro({"run", "-", "--dpi", "1"}, move).json().at("position")[0], 10);
}

// The plain G code of a run, run again, ends with the same moves.
TEST(MacroCommand, ExpandedCodeRunsAgain) {
  const Finished nc = macro({"run", bolt_circle, "--library-dir", folder, "--format", "nc"});
  ASSERT_EQ(nc.status, 0) << nc.err;
  EXPECT_EQ(nc.out.find('#'), std::string::npos);
  EXPECT_EQ(nc.out.find("G65"), std::string::npos);
  const Json first = macro({"run", bolt_circle, "--library-dir", folder}).json();
  const Json again = macro({"run", "-"}, nc.out).json();
  ASSERT_EQ(again.at("status"), "ok");
  EXPECT_GT(ends_of(first).size(), 24U);
  EXPECT_EQ(ends_of(first), ends_of(again));
}

TEST(MacroCommand, TraceTellsWhatEveryBlockAssigned) {
  const std::string program = "O5\n#1=2\n#100=#1+1\nG00 X#1\nM30\n";
  const Finished text = macro({"run", "-", "--format", "trace"}, program);
  EXPECT_EQ(text.status, 0);
  EXPECT_NE(text.out.find("O5:3  #100=#1+1    #100=3\n"), std::string::npos) << text.out;
  const Json result = macro({"run", "-", "--trace"}, program).json();
  ASSERT_EQ(result.at("trace").size(), 4U);
  EXPECT_EQ(result.at("trace")[1].at("set"), Json::parse(R"({"100": 3})"));
  EXPECT_EQ(result.at("trace")[1].at("line"), 3);
  EXPECT_EQ(result.at("trace")[3].at("moves"), 1);
}

TEST(MacroCommand, EveryFormatGoesToItsFile) {
  const TemporaryFolder files;
  for (const char* format : {"json", "nc", "csv", "svg", "trace"}) {
    const std::string file = files.file(std::string("run.") + format);
    const Finished finished =
        macro({"run", bolt_circle, "--library-dir", folder, "--format", format, "-o", file});
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_EQ(finished.out, "");
    EXPECT_GT(read(file).size(), 300U) << format;
  }
  const std::string csv = read(files.file("run.csv"));
  EXPECT_EQ(csv.substr(0, 12), "kind,x,y,z,m");
  EXPECT_EQ(read(files.file("run.svg")).substr(0, 4), "<svg");
}

TEST(MacroCommand, CheckNamesRuleAndPlace) {
  const std::string program =
      "O1\n#1=0.1\nWHILE[#1 NE 1]DO1\n#1=#1+0.1\nEND1\nGOTO 99\nG00 X1.\nM30\n";
  const Finished text = macro({"check", "-"}, program);
  EXPECT_EQ(text.status, 0);
  EXPECT_NE(text.out.find("[real_equality]"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.substr(0, 2), "3:");
  const Json json = macro({"check", "-", "--format", "json"}, program).json();
  EXPECT_EQ(json.at("findings")[0].at("rule"), "real_equality");
  const Finished clean = macro({"check", bolt_circle, "--library-dir", folder});
  EXPECT_EQ(clean.status, 0);
  EXPECT_EQ(clean.out, "");
}

// What make writes, run by its own call, moves as make computes.
TEST(MacroCommand, MadeProgramMovesAsMadeMotion) {
  const TemporaryFolder files;
  const Finished made = macro({"make", taper, "--format", "nc", "-o", files.file("O9801.nc")});
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string text = read(files.file("O9801.nc"));
  const std::size_t call = text.find("(CALL: ") + 7;
  const std::string main =
      "O1\nG90 G17\n" + text.substr(call, text.find(')', call) - call) + "\nM30\n";
  const Json run = macro({"run", "-", "--library-dir", files.file("")}, main).json();
  ASSERT_EQ(run.at("status"), "ok") << run.at("alarm");
  auto ends = ends_of(run);
  auto expected = ends_of(macro({"make", taper}).json());
  if (ends.front() != expected.front()) ends.erase(ends.begin());  // G00 X Y before Z
  ASSERT_EQ(ends.size(), expected.size());
  ASSERT_GT(ends.size(), 100U);
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(ends[i][axis], expected[i][axis], 0.00051) << i;
}

TEST(MacroCommand, MakeWritesEveryFormat) {
  for (const char* format : {"json", "nc", "csv", "svg"}) {
    const Finished finished = macro({"make", taper, "--format", format});
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_GT(finished.out.size(), 500U) << format;
  }
}

TEST(MacroCommand, MakeRefusesWithTheField) {
  Json job = Json::parse(read(taper));
  job["params"]["r"] = 6;
  const Finished finished = macro({"make", "-"}, job.dump());
  EXPECT_EQ(finished.status, 1);
  EXPECT_EQ(finished.json().at("error").at("field"), "/params/r");
  EXPECT_EQ(macro({"make", "-"}, "{").status, 2);
}

TEST(MacroCommand, WrongUsageIsStatus2) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{}, {"run"}, {"run", "-", "--format", "apt"}, {"jog", "-"}}) {
    EXPECT_EQ(macro(arguments).status, 2) << testing::PrintToString(arguments);
  }
  EXPECT_EQ(macro({"run", "absent.nc"}).status, 2);
}

}  // namespace
}  // namespace ridgeline::tests
