#include <algorithm>
#include <map>
#include <string>

#include "core/nc/reader.hpp"
#include "jobs/answer.hpp"
#include "tests/jobs/refusal_of.hpp"
#include "tests/support/named_tube.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

/// The library of the calls below.
class Shop : public Definitions {
public:
  std::optional<Definition> find(std::string_view kind, std::string_view name) const override {
    const auto found = all_.find(std::string(kind) + "/" + std::string(name));
    if (found == all_.end()) return std::nullopt;
    return Definition{found->second, 1};
  }
  std::vector<std::string> names(std::string_view) const override { return {"1", "tube-40"}; }

private:
  static Json tube(const char* name) {
    Json result = named_tube(name);
    result["holes"].push_back(
        {{"name", "drain"}, {"shape", "circle"}, {"radius", 6}, {"position", {0, 30, 0}}});
    return result;
  }
  std::map<std::string, Json> all_ = {
      {"workpiece/1", tube("1")},
      {"workpiece/tube-40", tube("tube-40")},
      {"tool/12", {{"kind", "tool"}, {"number", 12}, {"shape", "ball"}, {"radius", 3}}}};
};

Json expanded(const std::string& program, const Json& binding = nullptr) {
  Json job = {{"job", "expand"}, {"program", program}};
  if (!binding.is_null()) job["binding"] = binding;
  return assemble(answer(job.dump(), "json", Shop()));
}

std::string motion_of(const Json& job) {
  Json inline_job = job;
  inline_job["output"] = {{"positioning", "absolute"}};
  return answer(inline_job.dump(), "nc", Shop()).text;
}

/// The blocks of a program that move, from the first feed on: before it a main program has its tool
/// length.
std::string moves_in(const std::string& program) {
  std::string moves;
  for (std::size_t at = 0; at < program.size();) {
    const std::size_t end = std::min(program.find('\n', at), program.size());
    const std::string line = program.substr(at, end - at);
    if (line.find_first_of("XYZ") != line.npos && line.find_first_of("(H") == line.npos)
      moves += line + "\n";
    at = end + 1;
  }
  return moves.substr(moves.find("G1 "));
}

constexpr char head[] = "%\nO1000 (ROUGH)\nN10 G21 G90 G54\nT12 M6\nG43 H12\nS8000 M3\n";
constexpr char tail[] = "G0 Z100.\nM30\n%\n";

TEST(Expand, LeavesAllElseToTheByteAndMovesAsTheJobDoes) {
  const Json result = expanded(std::string(head) + "G65 P9100 W1 H1 T12 Q0.35 E1\n" + tail);
  ASSERT_EQ(result.at("status"), "ok") << result;
  const std::string program = result.at("program");
  EXPECT_TRUE(program.starts_with(head));
  EXPECT_TRUE(program.ends_with(tail));
  EXPECT_EQ(program.find("G65"), program.npos);
  const std::string alone = motion_of({{"job", "chamfer"},
                                       {"workpiece", "1"},
                                       {"hole", "H1"},
                                       {"edge", "inner"},
                                       {"tool", 12},
                                       {"cutting_amount", 0.35}});
  const std::string inside =
      program.substr(sizeof head - 1, program.size() - sizeof head - sizeof tail + 2);
  EXPECT_EQ(moves_in(inside), moves_in(alone));
  ASSERT_EQ(result.at("calls").size(), 1u);
  EXPECT_EQ(result.at("calls")[0].at("line"), 7);
  EXPECT_NEAR(result.at("calls")[0].at("report").at("width_max").get<double>(), 0.35 * M_SQRT2,
              0.0075);
}

// What a call describes itself gives the same motion as the same part from the library.
TEST(Expand, DescribesThePartInTheCall) {
  const Json named = expanded("G65 P9100 W1 H1 T12 Q0.35 E2 S2\n");
  const Json described = expanded("G65 P9100 I20. J30. K100. R5. T12 D3. Q0.35 E2 S2\n");
  ASSERT_EQ(named.at("status"), "ok") << named;
  ASSERT_EQ(described.at("status"), "ok") << described;
  EXPECT_EQ(moves_in(named.at("program")), moves_in(described.at("program")));
}

TEST(Expand, NamesAndDefaultsComeFromTheBinding) {
  const Json binding = Json::parse(R"({"macros": [{"number": 8200,
    "letters": {"A": "workpiece", "B": "hole", "C": "tool", "D": "width"},
    "names": {"A": {"7": "tube-40"}, "B": {"3": "drain"}},
    "job": {"edge": "outer", "tolerance": 0.002, "feed": 120}}]})");
  const Json result =
      expanded("G65 P8200 A7 B3 C12 D0.4 (EDGE)\nG65 P9100 W1 H1 T12 Q1.\n", binding);
  ASSERT_EQ(result.at("status"), "ok") << result;
  const std::string program = result.at("program");
  EXPECT_NE(program.find("HOLE DRAIN"), program.npos);
  EXPECT_NE(program.find("(EDGE)"), program.npos);
  EXPECT_NE(program.find("G65 P9100 W1 H1 T12 Q1."), program.npos) << "an unbound macro stays";
  // The second hole of the list, by its place.
  const Json second = expanded("G65 P9100 W1 H2 T12 V0.4 E2\n");
  ASSERT_EQ(second.at("status"), "ok") << second;
  EXPECT_NE(second.at("program").get<std::string>().find("HOLE DRAIN"), std::string::npos);
}

struct BadCall {
  const char* name;
  const char* call;
  const char* code;
  const char* said;  ///< in the message
};
void PrintTo(const BadCall& call, std::ostream* out) {
  *out << call.name;
}
class ExpandRefuses : public testing::TestWithParam<BadCall> {};

TEST_P(ExpandRefuses, WithLineAndReason) {
  const Json result = expanded(std::string("O1\n") + GetParam().call + "\nM30\n");
  ASSERT_EQ(result.at("status"), "error");
  EXPECT_EQ(result.at("error").at("code"), GetParam().code);
  const std::string message = result.at("error").at("message");
  EXPECT_NE(message.find("line 2"), message.npos) << message;
  EXPECT_NE(message.find(GetParam().said), message.npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Calls, ExpandRefuses,
    testing::Values(
        BadCall{"unknown_workpiece", "G65 P9100 W9 H1 T12 Q0.35", "unknown_workpiece", "\"9\""},
        BadCall{"unknown_tool", "G65 P9100 W1 H1 T99 Q0.35", "unknown_tool", "99"},
        BadCall{"unknown_hole", "G65 P9100 W1 H7 T12 Q0.35", "unknown_hole", "\"7\""},
        BadCall{"edge_of_three", "G65 P9100 W1 H1 T12 Q0.35 E3", "bad_input", "1 (inner) or 2"},
        BadCall{"no_width", "G65 P9100 W1 H1 T12", "bad_input", "width"},
        BadCall{"hole_half", "G65 P9100 W1 H1.5 T12 Q0.35", "bad_input", "a whole number"},
        BadCall{"radii_and_name", "G65 P9100 W1 I20. R5. T12 Q0.35", "bad_input", "left out"},
        BadCall{"place_without_radii", "G65 P9100 W1 H1 X5. T12 Q0.35", "bad_input",
                "inner_radius"},
        BadCall{"tool_too_large", "G65 P9100 W1 H1 T12 D6. Q0.35", "tool_too_large", "G65"}),
    [](const auto& call) { return call.param.name; });

TEST(Expand, RefusesABindingByField) {
  const Json binding = Json::parse(R"({"macros": [{"number": 8200, "letters": {"A": "colour"}}]})");
  const Json result = expanded("M30\n", binding);
  EXPECT_EQ(result.at("error").at("field"), "/binding/macros/0/letters/A");
  const Json twice = Json::parse(R"({"macros": [{"number": 1}, {"number": 1}]})");
  EXPECT_EQ(expanded("M30\n", twice).at("error").at("field"), "/binding/macros/1/number");
}

}  // namespace
}  // namespace ridgeline::jobs
