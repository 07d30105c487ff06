#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "core/units/offset.hpp"
#include "core/units/overlay.hpp"
#include "core/units/passes.hpp"
#include "jobs/answer.hpp"
#include "jobs/units_program.hpp"
#include "tests/core/nc/rs274.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
using units::Region;
using units::TurningMove;
using units::TurningStep;

Json run(const Json& job) {
  return assemble(answer(job.dump(), "json", NoDefinitions()));
}

Json plan_of(const std::string& part) {
  std::ifstream in(RIDGELINE_TESTS "/parts/" + part, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return run({{"job", "units"}, {"product_step", text.str()}});
}

Json nc_of(const Json& program, const Json& output) {
  return run({{"job", "units"}, {"operation", "nc"}, {"program", program}, {"output", output}});
}

/// A line of G-code as letters and numbers; comments apart.
struct Block {
  std::map<char, double> words;
  std::vector<int> g;
  std::string comment;
};

Block block_of(const std::string& line) {
  Block block;
  for (std::size_t i = 0; i < line.size();) {
    if (line[i] == '(') {
      block.comment = line.substr(i + 1, line.find(')', i) - i - 1);
      break;
    }
    if (std::isalpha(static_cast<unsigned char>(line[i])) == 0) {
      ++i;
      continue;
    }
    std::size_t used = 0;
    const double value = std::stod(line.substr(i + 1), &used);
    if (line[i] == 'G')
      block.g.push_back(static_cast<int>(std::lround(value)));
    else
      block.words[line[i]] = value;
    i += 1 + used;
  }
  return block;
}

/// The turning of one unit by one tool, as the text says it: moves of the imaginary tip, X radius.
struct Turned {
  int unit = 0;
  std::string pattern;
  std::vector<TurningMove> moves;
};

std::vector<Turned> turned_in(const std::string& text) {
  std::vector<Turned> steps;
  units::Point at{0, 0};
  int motion = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const Block block = block_of(line);
    std::istringstream comment(block.comment);
    std::string word, kind;
    int unit = 0;
    if (comment >> word >> unit >> kind >> word && !block.comment.empty() &&
        block.comment.starts_with("UNIT"))
      steps.push_back({unit, word, {}});
    for (const int g : block.g)
      if (g <= 3) motion = g;
    if (block.words.count('X') + block.words.count('Z') == 0 || motion > 3) continue;
    units::Point to = at;
    if (block.words.count('X') != 0) to.r = block.words.at('X') / 2;
    if (block.words.count('Z') != 0) to.z = block.words.at('Z');
    TurningMove move;
    move.kind = motion == 0 ? TurningMove::Kind::Rapid : TurningMove::Kind::Feed;
    move.path = {at, to, {}};
    if (motion > 1)
      move.path = units::arc_segment(
          at, to, block.words.at('R'),
          motion == 2 ? units::Sense::Clockwise : units::Sense::CounterClockwise);
    if (!steps.empty()) steps.back().moves.push_back(move);
    at = to;
  }
  return steps;
}

/// Machine coordinates of the tip to the half section and the nose centre.
TurningStep in_section(const Turned& turned, const units::Unit& unit, const units::ToolRow& row,
                       double length) {
  TurningStep step;
  step.tool = row;
  step.approach = unit.kind == units::UnitKind::BarOuter   ? units::Approach::Outer
                  : unit.kind == units::UnitKind::BarInner ? units::Approach::Inner
                  : unit.process == 1                      ? units::Approach::Front
                                                           : units::Approach::Back;
  const double R = row.nose_radius;
  const auto moved = [&](const units::Point& p) {
    const double r = step.approach == units::Approach::Inner ? p.r - R : p.r + R;
    const double z = p.z + R;
    return units::Point{r, unit.process == 1 ? -z : z + length};
  };
  for (TurningMove move : turned.moves) {
    move.path.start = moved(move.path.start);
    move.path.end = moved(move.path.end);
    if (move.path.arc) {
      move.path.arc->centre = moved(move.path.arc->centre);
      if (unit.process == 1)
        move.path.arc->sense = move.path.arc->sense == units::Sense::Clockwise
                                   ? units::Sense::CounterClockwise
                                   : units::Sense::Clockwise;
    }
    step.moves.push_back(move);
  }
  return step;
}

class UnitsNc : public testing::TestWithParam<const char*> {};

TEST_P(UnitsNc, LinuxCncAcceptsBothProgramsAndReadsTheSamePlaces) {
  const Json program = plan_of(GetParam());
  const Json result = nc_of(program, {{"dialect", "linuxcnc"}});
  ASSERT_EQ(result["status"], "ok") << result.dump().substr(0, 600);
  ASSERT_EQ(result["programs"].size(), 2u);
  for (const Json& each : result["programs"]) {
    const std::string text = each["text"];
    const nc::CanonRun canon = nc::run_rs274(text);
    ASSERT_EQ(canon.exit_code, 0) << canon.output.substr(
        canon.output.size() < 1500 ? 0 : canon.output.size() - 1500);
    ASSERT_GT(canon.moves.size(), 50u);
    // every end of a turning move stands in the canonical calls, in the same order
    std::size_t next = 0;
    std::size_t found = 0;
    for (const Turned& turned : turned_in(text)) {
      if (turned.pattern.find("ROUGH") == std::string::npos &&
          turned.pattern.find("FINISH") == std::string::npos)
        continue;
      for (const TurningMove& move : turned.moves) {
        const auto is_same = [&](const nc::CanonMove& canon_move) {
          return std::abs(canon_move.to.x() - move.path.end.r) < 2e-4 &&
                 std::abs(canon_move.to.z() - move.path.end.z) < 2e-4;
        };
        while (next < canon.moves.size() && !is_same(canon.moves[next])) ++next;
        ASSERT_LT(next, canon.moves.size())
            << "X " << move.path.end.r << " Z " << move.path.end.z << " is not reached";
        ++found;
      }
    }
    EXPECT_GT(found, 20u);
  }
}

// The text, read again and swept, cuts no product and leaves of the turned regions only what the
// nose radius and drill points cannot reach; roughing alone leaves the stated allowance.
TEST_P(UnitsNc, EmittedTurningLeavesTheProductAndTheStatedAllowance) {
  const Json document = plan_of(GetParam());
  const UnitsProgram whole = read_program(Value(document));
  const units::Program& program = whole.program;
  const double length = units::box(program.product.shadow).z1;
  const Json result = nc_of(document, {{"dialect", "fanuc"}});
  ASSERT_EQ(result["status"], "ok") << result.dump().substr(0, 600);
  int checked = 0;
  for (const Json& each : result["programs"]) {
    for (const Turned& turned : turned_in(each["text"])) {
      const units::Unit& unit = program.units.at(static_cast<std::size_t>(turned.unit - 1));
      const bool is_rough = turned.pattern.starts_with("ROUGH");
      const bool is_finish = turned.pattern.starts_with("FINISH");
      if (unit.tools.size() != 2 || !(is_rough || is_finish)) continue;
      SCOPED_TRACE(turned.unit);
      const units::ToolRow& row = unit.tools[is_rough ? 0 : 1];
      const TurningStep step = in_section(turned, unit, row, length);
      const Region tool = units::swept(step);
      const double a = is_rough ? row.finish_allowance : 0;
      // a micrometre for the rounding of the text to 4 decimals
      const Region kept = a > 1e-3 ? units::grown(program.product.shadow, a - 1e-3)
                                   : units::shrunk(program.product.shadow, 1e-3);
      EXPECT_LT(units::volume(units::intersection_of(tool, kept)), 1e-2);
      ++checked;
    }
  }
  EXPECT_GE(checked, 6);
  for (const Json& unit : result["units"]) {
    SCOPED_TRACE(unit["number"].get<int>());
    EXPECT_LT(unit["gouge"].get<double>(), 1e-2);
    const units::Unit& planned =
        program.units.at(static_cast<std::size_t>(unit["number"].get<int>() - 1));
    if (planned.kind == units::UnitKind::Hole) continue;
    EXPECT_LT(unit["left"].get<double>(), 0.02 * planned.volume + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Parts, UnitsNc,
                         testing::Values("own_flanged_shaft.step", "own_cross_tube.step",
                                         "own_hard_shaft.step", "tie_rod.step"));

TEST(UnitsNcFanuc, HasTwoProgramsInOneFileAndTiltsForTheObliqueHole) {
  const Json program = plan_of("own_cross_tube.step");
  const Json job = {{"job", "units"}, {"operation", "nc"}, {"program", program}};
  const std::string text = answer(job.dump(), "nc", NoDefinitions()).text;
  EXPECT_NE(text.find("O0001"), std::string::npos);
  EXPECT_NE(text.find("O0002"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '%'), 2);
  EXPECT_NE(text.find("G68.2 X0."), std::string::npos);
  const Json linuxcnc = nc_of(program, {{"dialect", "linuxcnc"}});
  bool has_oblique = false;
  for (const Json& note : linuxcnc["notes"])
    has_oblique |= note.get<std::string>().find("tilted work plane") != std::string::npos;
  EXPECT_TRUE(has_oblique) << linuxcnc["notes"].dump();
}

TEST(UnitsNcFanuc, DepthOfCutThatCannotWorkIsRefused) {
  Json program = plan_of("own_hard_shaft.step");
  program["units"][1]["tools"][0]["depth_of_cut"] = 0;
  const Json result = nc_of(program, {{"dialect", "fanuc"}});
  EXPECT_EQ(result["error"]["code"], "bad_input");
  EXPECT_EQ(result["error"]["field"], "/program/units/1/tools/0/depth_of_cut");
}

Json straight(const Json& start, const Json& end) {
  return {{"pattern", "line"}, {"start", start}, {"end", end}};
}

Json bar(double radius, double length) {
  return {
      {"shape", Json::array({Json::array(
                    {straight({0, 0}, {radius, 0}), straight({radius, 0}, {radius, length}),
                     straight({radius, length}, {0, length}), straight({0, length}, {0, 0})})})}};
}

// A step across half of the end: a cutter as wide as its depth enters only from beyond the arc.
TEST(UnitsNcFanuc, MillsComeInOverAnOpenArc) {
  Json product = bar(15, 60);
  const Json arc = {{"pattern", "arc"},
                    {"start", {0, -15, 50}},
                    {"end", {0, 15, 50}},
                    {"centre", {0, 0, 50}},
                    {"sense", "ccw"}};
  const Json outline = Json::array({straight({0, 15, 50}, {0, -15, 50}), arc});
  product["faces"] = Json::array({{{"form", "step"},
                                   {"normal", {0, 0, 1}},
                                   {"point", {5, 0, 50}},
                                   {"depth", 10},
                                   {"outline", Json::array({outline})},
                                   {"z", {50, 50}}}});
  const Json program = run({{"job", "units"}, {"product", product}});
  ASSERT_EQ(program.at("status"), "ok") << program;
  const Json nc = nc_of(program, {{"dialect", "fanuc"}});
  ASSERT_EQ(nc.at("status"), "ok") << nc;
  EXPECT_EQ(nc.at("notes"), Json::array());
  EXPECT_NE(nc.at("programs").dump().find("FACE MILL"), std::string::npos);
}

TEST(UnitsNcFanuc, TheCutterOfARoundPocketEntersIt) {
  Json product = bar(25, 60);
  const Json circle = {{"pattern", "arc"},
                       {"start", {20, -5, 30}},
                       {"end", {20, -5, 30}},
                       {"centre", {20, 0, 30}},
                       {"sense", "ccw"}};
  product["faces"] = Json::array({{{"form", "pocket"},
                                   {"normal", {1, 0, 0}},
                                   {"point", {20, 0, 30}},
                                   {"depth", 5},
                                   {"outline", Json::array({Json::array({circle})})},
                                   {"z", {25, 35}}}});
  const Json nc = nc_of(run({{"job", "units"}, {"product", product}}), {{"dialect", "fanuc"}});
  ASSERT_EQ(nc.at("status"), "ok") << nc;
  EXPECT_EQ(nc.at("notes"), Json::array());
}

// The far step would be sunk through the hole before it.
TEST(UnitsNcFanuc, NamesAStepBehindANarrowerOne) {
  Json product = bar(30, 40);
  const Json steps =
      Json::array({{{"diameter", 8}, {"length", 10}}, {{"diameter", 16}, {"length", 10}}});
  product["holes"] = Json::array({{{"start", {15, 0, 0}},
                                   {"direction", {0, 0, 1}},
                                   {"diameter", 8},
                                   {"depth", 20},
                                   {"bottom", "flat"},
                                   {"steps", steps}}});
  const Json nc = nc_of(run({{"job", "units"}, {"product", product}}), {{"dialect", "fanuc"}});
  ASSERT_EQ(nc.at("status"), "ok") << nc;
  EXPECT_NE(nc.at("notes").dump().find("16 lies behind 8"), std::string::npos) << nc.at("notes");
  EXPECT_EQ(nc.at("programs").dump().find("COUNTERBORE"), std::string::npos);
}

// What an edit wants of the product is not cut, and does not keep the rest from being written.
TEST(UnitsNcFanuc, FacesEndAtTheProduct) {
  Json program = plan_of("own_flanged_shaft.step");
  const auto edited = [&](const Json& set) {
    return run({{"job", "units"},
                {"operation", "edit"},
                {"program", program},
                {"edits", Json::array({{{"unit", 1}, {"set", set}}})}});
  };
  program = edited({{"shape/0/end", {10, 3}}});
  ASSERT_EQ(program.at("status"), "ok") << program;
  const Json nc = nc_of(program, {{"dialect", "fanuc"}});
  ASSERT_EQ(nc.at("status"), "ok") << nc.at("error");
  EXPECT_LT(nc.at("units").at(0).at("gouge"), 1e-2);
  EXPECT_GT(nc.at("units").at(0).at("left"), 100);
  program = edited({{"process", 2}});
  ASSERT_EQ(program.at("status"), "ok") << program;
  EXPECT_NE(nc_of(program, {{"dialect", "fanuc"}}).at("notes").dump().find("lies in the chuck"),
            std::string::npos);
}

}  // namespace
}  // namespace ridgeline::jobs
