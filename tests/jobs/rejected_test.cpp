#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {
namespace {

// tests/rejected/<code>.<what is wrong>.json: jobs that must be refused with that code.
std::vector<std::string> rejected_files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(RIDGELINE_TESTS "/rejected"))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

std::string text_of(const std::string& name) {
  const std::ifstream stream(RIDGELINE_TESTS "/rejected/" + name + ".json", std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

class Rejected : public testing::TestWithParam<std::string> {};

TEST_P(Rejected, IsRefusedWithTheCodeOfItsName) {
  const std::string code = GetParam().substr(0, GetParam().find('.'));
  const Answer result = answer(text_of(GetParam()), "json", NoDefinitions());
  ASSERT_EQ(result.document.value("status", ""), "error") << to_json(result).substr(0, 2000);
  const nlohmann::json& error = result.document.at("error");
  EXPECT_EQ(error.at("code"), code) << error;
  EXPECT_NE(error.at("message"), "");
  EXPECT_TRUE(result.arrays.empty());
}

INSTANTIATE_TEST_SUITE_P(Files, Rejected, testing::ValuesIn(rejected_files()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::ranges::replace(name, '.', '_');
                           return name;
                         });

// What a bad field's error object has to say beside its code.
TEST(RejectedFields, NameFieldValueAndLimit) {
  struct Case {
    const char* file;
    const char* field;
    const char* value;
  };
  const std::vector<Case> cases = {
      {"bad_input.unknown_key", "/colour", "\"red\""},
      {"bad_input.unknown_key_in_output", "/output/dialekt", "\"fanuc\""},
      {"bad_input.unknown_key_in_hole", "/workpiece/holes/0/angle", "3"},
      {"bad_input.edge_missing", "/edge", "missing"},
      {"bad_input.width_and_cutting_amount", "/cutting_amount", "0.3"},
      {"bad_input.width_huge", "/width", "1e+300"},
      {"bad_input.tolerance_zero", "/tolerance", "0"},
      {"bad_input.position_infinite", "/workpiece/position/2", "1e999"},
      {"bad_input.passes_descend", "/passes/1", "0.25"},
      {"bad_input.section_angle_table_row", "/section_angle/0", "[0,45,1]"},
      {"bad_input.tool_wear_takes_the_ball", "/tool/wear", "-3"},
      {"inconsistent_eccentricity.sign", "/workpiece/holes/0/eccentric_distance", "-4"},
      {"unknown_hole.name", "/hole", "H2"},
      {"unknown_tool.number", "/tool", "13"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.file);
    const Answer result = answer(text_of(c.file), "json", NoDefinitions());
    const nlohmann::json& error = result.document.at("error");
    EXPECT_EQ(error.at("field"), c.field);
    EXPECT_EQ(error.at("value"), c.value);
    EXPECT_NE(error.at("limit"), "");
  }
}

}  // namespace
}  // namespace ridgeline::jobs
