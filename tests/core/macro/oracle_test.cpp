// Programs with variables, positions and alarms from another implementation and from the control's
// documents: tests/oracle/macro.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "core/macro/interpreter.hpp"

namespace ridgeline::macro {
namespace {

std::string read_file(const std::string& name) {
  std::ifstream file(std::string(RIDGELINE_TESTS) + "/oracle/macro/" + name, std::ios::binary);
  EXPECT_TRUE(file.good()) << name;
  return {std::istreambuf_iterator<char>(file), {}};
}

struct OracleCase {
  std::string name;
  nlohmann::json expected;
};

void PrintTo(const OracleCase& oracle, std::ostream* out) {
  *out << oracle.name;
}

std::vector<OracleCase> oracle_cases() {
  std::vector<OracleCase> cases;
  for (const nlohmann::json& expected : nlohmann::json::parse(read_file("expected.json"))) {
    cases.push_back({expected.at("file"), expected});
  }
  return cases;
}

Options options_of(const nlohmann::json& expected) {
  Options options;
  options.profile.calculator_point = expected.at("opts").at("dpi") == 1;
  options.profile.half_turn_angles = expected.at("opts").at("nat") == 1;
  if (expected.at("wcs").is_object()) {
    for (const auto& [name, offset] : expected.at("wcs").items()) {
      int variable = 5221 + 20 * (std::stoi(name) - 54);
      for (const nlohmann::json& coordinate : offset) {
        options.set[variable++] = coordinate.get<double>();
      }
    }
  }
  return options;
}

void expect_near(const Eigen::Vector3d& actual, const nlohmann::json& expected) {
  const auto p = expected.get<std::array<double, 3>>();
  EXPECT_NEAR((actual - Eigen::Vector3d(p[0], p[1], p[2])).norm(), 0, 1e-9)
      << actual.transpose() << " instead of " << expected;
}

class MacroOracle : public testing::TestWithParam<OracleCase> {};

TEST_P(MacroOracle, VariablesPositionsAndAlarmAgree) {
  const nlohmann::json& expected = GetParam().expected;
  const Result result = run(read_file(GetParam().name), options_of(expected));

  if (expected.at("alarm").is_null()) {
    ASSERT_FALSE(result.alarm) << result.alarm->number << " " << result.alarm->message;
  } else {
    ASSERT_TRUE(result.alarm);
    const auto& accepted = expected.at("alarm_accept");
    EXPECT_NE(std::find(accepted.begin(), accepted.end(), result.alarm->number), accepted.end())
        << result.alarm->number;
  }
  for (const auto& [name, value] : expected.at("vars").items()) {
    const auto found = result.variables.find(std::stoi(name));
    ASSERT_NE(found, result.variables.end()) << "#" << name;
    EXPECT_EQ(found->second.vacant, value.is_null()) << "#" << name;
    const double number = value.is_null() ? 0 : value.get<double>();
    EXPECT_NEAR(found->second.number, number, 1e-9) << "#" << name;
  }
  if (!expected.at("pos").is_null()) {
    expect_near(result.position, expected.at("pos"));
  }
  if (!expected.at("ends").is_null()) {
    ASSERT_EQ(result.motion.size(), expected.at("ends").size());
    for (std::size_t i = 0; i < result.motion.size(); ++i) {
      SCOPED_TRACE(i);
      expect_near(machine_of(result, result.motion[i]), expected.at("ends").at(i));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Programs, MacroOracle, testing::ValuesIn(oracle_cases()),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); },
                               '_');
                           return name;
                         });

}  // namespace
}  // namespace ridgeline::macro
