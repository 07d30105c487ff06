// The programs and cycle files of clients/examples: every one runs, and what a cycle writes moves
// as it computes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {
namespace {

using nlohmann::json;

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::filesystem::path> files_of(const std::string& folder, const std::string& prefix) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator("clients/examples/" + folder)) {
    if (entry.path().filename().string().starts_with(prefix)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

json answered(const json& job) {
  return assemble(answer(job.dump(), "json", NoDefinitions()));
}

TEST(MacroExamples, EveryProgramRunsAndIsFoundGood) {
  json programs = json::object();
  for (const auto& file : files_of("macro", "O9")) {
    programs[file.stem().string().substr(1)] = read(file);
  }
  int ran = 0;
  for (const auto& file : files_of("macro", "O0")) {
    SCOPED_TRACE(file);
    const json job = {{"job", "macro"}, {"program", read(file)}, {"programs", programs}};
    const json result = answered(job);
    EXPECT_EQ(result.at("status"), "ok") << result.value("alarm", json());
    EXPECT_GT(result.at("motion").size(), 30U);
    json check = job;
    check["operation"] = "check";
    const json checked = answered(check);
    for (const json& finding : checked.at("findings")) {
      EXPECT_EQ(finding.at("severity"), "warning") << finding;
    }
    ++ran;
  }
  EXPECT_EQ(ran, 4);
}

/// Ends of the moves that go somewhere, from the first feed on.
std::vector<std::vector<double>> ends_of(const json& result) {
  std::vector<std::vector<double>> ends;
  bool is_cutting = false;
  std::vector<double> at;
  for (const json& move : result.at("motion")) {
    const std::vector<double> to = move.at("to");
    is_cutting = is_cutting || move.at("kind") != "rapid";
    double way = 1;
    if (!at.empty()) way = std::hypot(to[0] - at[0], to[1] - at[1], to[2] - at[2]);
    if (is_cutting && (move.at("kind") == "arc" || way > 1e-3)) ends.push_back(to);
    at = to;
  }
  return ends;
}

TEST(MacroExamples, EveryCycleWritesAProgramThatMovesAsItComputes) {
  int compared = 0, made = 0;
  for (const auto& file : files_of("cycles", "")) {
    SCOPED_TRACE(file);
    const json job = json::parse(read(file));
    const json computed = answered(job);
    ASSERT_EQ(computed.at("status"), "ok") << computed;
    const Answer program = answer(job.dump(), "nc", NoDefinitions());
    ASSERT_EQ(program.document.at("status"), "ok") << program.document;
    ++made;
    json run = {{"job", "macro"}, {"program", program.text}};
    const std::size_t call = program.text.find("(CALL: ");
    if (call != std::string::npos) {
      const std::string words =
          program.text.substr(call + 7, program.text.find(')', call) - call - 7);
      run["program"] = "O1\nG90 G17\n" + words + "\nM30\n";
      run["programs"] = {{words.substr(5, words.find(' ', 5) - 5), program.text}};
    }
    const json ran = answered(run);
    ASSERT_EQ(ran.at("status"), "ok") << ran.at("alarm") << program.text;
    // A sign never follows an operator: not every control reads that.
    for (const char* pair : {"+-", "--", "*-", "/-", "++"})
      EXPECT_EQ(program.text.find(pair), std::string::npos) << pair << program.text;
    const auto ends = ends_of(ran), expected = ends_of(computed);
    ASSERT_EQ(ends.size(), expected.size());
    for (std::size_t i = 0; i < ends.size(); ++i, ++compared) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(ends[i][axis], expected[i][axis], 0.0016) << i;
    }
  }
  EXPECT_EQ(made, 13);
  EXPECT_GT(compared, 1400);
}

}  // namespace
}  // namespace ridgeline::jobs
