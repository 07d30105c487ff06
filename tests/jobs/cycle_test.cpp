// Cycles against tests/oracle/cycles: contact, normal and tip of every station there, to 1e-9 mm.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {
namespace {

using nlohmann::json;

json read_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  return json::parse(file);
}

std::vector<std::string> oracle_names() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(RIDGELINE_TESTS) + "/oracle/cycles")) {
    const std::string name = entry.path().stem().string();
    if (name.find("hole_edge") == std::string::npos) names.push_back(name);  // hole_edge_test.cpp
  }
  std::sort(names.begin(), names.end());
  return names;
}

json answered(const json& job, const std::string& format = "json") {
  return assemble(answer(job.dump(), format, NoDefinitions()));
}

double number(const json& value) {
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

/// Every number of `expected` is in `actual` at the same place; counts them.
void expect_numbers(const json& expected, const json& actual, const std::string& at, int& count) {
  if (expected.is_object()) {
    for (const auto& [key, value] : expected.items()) {
      ASSERT_TRUE(actual.contains(key)) << at << "/" << key;
      expect_numbers(value, actual.at(key), at + "/" + key, count);
    }
  } else if (expected.is_array()) {
    ASSERT_EQ(expected.size(), actual.size()) << at;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      expect_numbers(expected.at(i), actual.at(i), at + "/" + std::to_string(i), count);
    }
  } else if (expected.is_boolean()) {
    EXPECT_EQ(expected, actual) << at;
  } else {
    EXPECT_NEAR(number(expected), number(actual), 1e-9) << at;
    ++count;
  }
}

class CycleOracle : public testing::TestWithParam<std::string> {};

TEST_P(CycleOracle, PointsAgree) {
  const json oracle =
      read_json(std::string(RIDGELINE_TESTS) + "/oracle/cycles/" + GetParam() + ".json");
  const json result = answered({{"job", "cycle"},
                                {"family", oracle.at("family")},
                                {"method", oracle.at("method")},
                                {"params", oracle.at("params")}});
  ASSERT_EQ(result.at("status"), "ok") << result.dump();
  int count = 0;
  expect_numbers(oracle.at("points"), result.at("points"), "/points", count);
  EXPECT_GE(count, 21);
  // Further numbers of the oracle under the same names.
  for (const char* key : {"cusp", "cusp_normal", "cusp_leading_order_at_lower_edge", "A", "B", "C",
                          "b", "c", "bottom_contact", "overrun_below_edge", "x_last", "passes",
                          "slope_length", "turns", "phi_limit_deg", "unreached_height_above_floor",
                          "bottom_rest_for_bull", "reach_from_deg"}) {
    if (!oracle.contains(key)) continue;
    ASSERT_TRUE(result.contains(key)) << key;
    expect_numbers(oracle.at(key), result.at(key), key, count);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, CycleOracle, testing::ValuesIn(oracle_names()),
                         [](const auto& test) { return test.param; });

// path_head_tail of the oracle: A, B, C, A of the first two and the last two passes.
TEST(Cycle, StraightTaper1TracesTheTriangleOfTheOracle) {
  for (const char* name : {"01_taper_straight_1_bull", "03_taper_straight_1_flat"}) {
    SCOPED_TRACE(name);
    const json oracle =
        read_json(std::string(RIDGELINE_TESTS) + "/oracle/cycles/" + name + ".json");
    const json result = answered({{"job", "cycle"},
                                  {"family", oracle.at("family")},
                                  {"method", oracle.at("method")},
                                  {"params", oracle.at("params")}});
    const json& motion = result.at("motion");
    const json& path = oracle.at("path_head_tail");
    int count = 0;
    for (std::size_t i = 0; i < path.size() / 2; ++i) {
      expect_numbers(path.at(i), motion.at(i).at("to"), "head", count);
      expect_numbers(path.at(path.size() - 1 - i), motion.at(motion.size() - 1 - i).at("to"),
                     "tail", count);
    }
    EXPECT_EQ(count, 48);
  }
}

}  // namespace
}  // namespace ridgeline::jobs
