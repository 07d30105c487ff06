// Programs as shops write them, and programs that nobody should write: every one ends with a result
// or an alarm at its line, within the limits.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "core/macro/check.hpp"
#include "core/macro/interpreter.hpp"
#include "core/macro/listing.hpp"

namespace ridgeline::macro {
namespace {

struct Written {
  std::string name;
  std::string text;
  int alarm = 0;  ///< number; 0: none
  int line = 0;   ///< of the alarm
  std::vector<std::pair<int, double>> variables;
};

void PrintTo(const Written& written, std::ostream* out) {
  *out << written.name;
}

std::vector<Written> written_in_shops() {
  return {
      {"AbbreviatedWhile",
       "#1=0\nWH[#1LT5]DO1\n#1=#1+1\nN49END1\n#100=#1\nM30\n",
       0,
       0,
       {{100, 5}}},
      {"RoundTakesHalvesAwayFromZero",
       "#100=ROUND[2.5]\n#101=ROUND[-2.5]\n#102=FIX[-2.5]\n#103=FUP[-2.5]\nM30\n",
       0,
       0,
       {{100, 3}, {101, -3}, {102, -2}, {103, -3}}},
      {"GotoVariable", "#22=30\nGOTO#22\n#100=1\nN30#101=2\nM30\n", 0, 0, {{101, 2}}},
      {"GotoExpression", "#1=2\nGOTO[#1*10]\n#100=1\nN20#101=3\nM30\n", 0, 0, {{101, 3}}},
      {"ComputedGCode",
       "#8=1\nG#8X10.F100.\n#100=#5001\n#101=#4001\nM30\n",
       0,
       0,
       {{100, 10}, {101, 1}}},
      {"CommentInExpression", "#100=[1+(PLUS)2]*3(END)\nM30\n", 0, 0, {{100, 9}}},
      {"LowerCase",
       "o1\n#100=sin[30]\nif[#100eq0.5]then#101=1\nwhile[#102lt3]do1\n#102=#102+1\n"
       "end1\nm30\n",
       0,
       0,
       {{100, 0.5}, {101, 1}, {102, 3}}},
      {"CarriageReturns", "%\r\nO1\r\n#100=1\r\nG00X1.\r\nM30\r\n%\r\n", 0, 0, {{100, 1}}},
      {"NoTapeMarkNoHead", "#100=4", 0, 0, {{100, 4}}},
      {"ByteOrderMark", "\xEF\xBB\xBF%\nO1\n#100=4\nM30\n%", 0, 0, {{100, 4}}},
      {"NamedProgram", "%\n<PART-7>\n#100=1\nM30\n%", 0, 0, {{100, 1}}},
      {"NamedProgramWithO", "%\nO<PART-7>\n#100=1\nM30\n%", 0, 0, {{100, 1}}},
      {"CommentsBeforeHead",
       "(SHOP 4)\n(REV B)\nO0012(TITLE)\n#100=#4115\nM30\n",
       0,
       0,
       {{100, 12}}},
      {"ColonHead", ":100\n#100=1\nM30\n", 0, 0, {{100, 1}}},
      {"OldSubprogramCount", "M98P31000\nM30\nO1000\n#100=#100+1\nM99\n", 0, 0, {{100, 3}}},
      {"PaddedSubprogramCount", "M98P0031000\nM30\nO1000\n#100=#100+1\nM99\n", 0, 0, {{100, 3}}},
      {"SubprogramAfterTapeMark", "M98P1000\nM30\n%\nO1000\n#100=3\nM99\n%\n", 0, 0, {{100, 3}}},
      {"SpacedIf", "IF [#1 EQ #0] GOTO 10\n#100=5\nN10 #101=1\nM30\n", 0, 0, {{101, 1}}},
      {"SemicolonComment", "G0X1. ; over the part\n#100=2 ; width\nM30\n", 0, 0, {{100, 2}}},
      {"SemicolonBlocks", "#100=1;#101=2;G00X1.;\nM30;\n", 0, 0, {{100, 1}, {101, 2}}},
      {"OptionalSkipNumbers", "/1 #100=1\n/ #101=1\nM30\n", 0, 0, {{100, 1}, {101, 1}}},
      {"LeadingZeros", "G00X0010.\nG0091G001X-05.F0100.\n#100=#5001\nM0030\n", 0, 0, {{100, 5}}},
      {"SignedExpressions",
       "#1=3\n#100=-#1+-2\n#101=2*-#1\n#102=-[#1-5]\nM30\n",
       0,
       0,
       {{100, -5}, {101, -6}, {102, 2}}},
      {"IndirectTwice", "#1=102\n#102=7\n#100=#[#1]\n#[#1+1]=8\nM30\n", 0, 0, {{100, 7}, {103, 8}}},
      {"JumpOutOfLoops",
       "#1=1\nDO1\nDO2\n#1=#1+1\nIF[#1GT5]GOTO9\nEND2\nEND1\nN9#100=#1\nM30\n",
       0,
       0,
       {{100, 6}}},
      {"SecondSameLabelIsNearer", "GOTO5\nN5#100=1\nGOTO6\nN5#100=2\nN6M30\n", 0, 0, {{100, 1}}},
      {"RotaryAxesAndFunctions",
       "N100T1M6\nN110G0G90G54X0.Y0.A90.S5000M3\nN120G43H1Z50.M8\nG5.1Q1\nG05.1Q0\n#100=#5003\n"
       "M9\nM30\n",
       0,
       0,
       {{100, 50}}},
      {"DrillingCycle",
       "G90G98G81X10.Y10.Z-5.R2.F100.\nX20.\nG80\n#100=#5001\nM30\n",
       0,
       0,
       {{100, 20}}},
      {"EndsWithoutM30", "#100=1\nG00X1.\n", 0, 0, {{100, 1}}},
      {"NestedComment", "#100=1\nG0X1.(A (NESTED) COMMENT)\nM30\n", 5, 2, {{100, 1}}},
      {"Else", "\nIF[#1 EQ #0]THEN #100=1 ELSE #100=2\nM30\n", 127, 2, {}},
      {"ExponentNotation", "#100=1\n\n#100=1E5\nM30\n", 127, 3, {{100, 1}}},
      {"TwoPoints", "#100=1\nG0X1.5.\nM30\n", 7, 2, {{100, 1}}},
      {"TwoMinus", "G0X--5.\nM30\n", 6, 1, {}},
      {"AddressAlone", "G0X\nM30\n", 5, 1, {}},
      {"UnknownFunction", "\n#100=FOO[1]\nM30\n", 114, 2, {}},
      {"UnknownCharacter", "\n\nG00 X1. @5\nM30\n", 4, 3, {}},
      {"UnterminatedExpression", "#100=[1+2\nM30\n", 114, 1, {}},
      {"BracketTooMany", "#100=1+2]\nM30\n", 114, 1, {}},
      {"ThenAlone", "THEN#100=5\nM30\n", 5, 1, {}},
      {"GotoNothing", "GOTO\nM30\n", 128, 1, {}},
      {"GotoAbsent", "#100=1\nGOTO 77\nM30\n", 78, 2, {{100, 1}}},
      {"ArcStartsCompensation", "G41D1G02X10.Y0R5.F100.\nM30\n", 34, 1, {}},
      {"CrossedLoops", "DO1\nDO2\nEND1\nEND2\nM30\n", 124, 2, {}},
      {"FourDeep", "WHILE[1EQ1]DO4\nEND4\nM30\n", 126, 1, {}},
      {"EndlessRecursion", "M98P1\nM30\nO1\nM98P1\nM99\n", 77, 4, {}},
      {"EndlessMacroRecursion", "G65P1\nM30\nO1\nG65P1\nM99\n", 122, 4, {}},
      {"HugeIndirect", "#100=#[1E9]\nM30\n", 114, 1, {}},
      {"IndirectOutOfRange", "#1=123456789\n#100=#[#1*1000]\nM30\n", 115, 2, {}},
      {"Overflow", "#1=10\nWHILE[1EQ1]DO1\n#1=#1*#1\nEND1\nM30\n", 111, 3, {}},
  };
}

class ShopProgram : public testing::TestWithParam<Written> {};

Limits small_limits() {
  Limits limits;
  limits.steps = 20'000;
  limits.moves = 20'000;
  limits.seconds = 5;
  return limits;
}

TEST_P(ShopProgram, RunsAsOnAControl) {
  const Written& written = GetParam();
  Options options;
  options.limits = small_limits();
  const Result result = run(written.text, options);
  EXPECT_EQ(result.alarm ? result.alarm->number : 0, written.alarm)
      << (result.alarm ? result.alarm->message : "no alarm");
  EXPECT_EQ(result.alarm ? result.alarm->line : 0, written.line);
  for (const auto& [number, value] : written.variables) {
    const auto found = result.variables.find(number);
    ASSERT_NE(found, result.variables.end()) << number;
    EXPECT_FALSE(found->second.vacant);
    EXPECT_EQ(found->second.number, value) << "#" << number;
  }
}

INSTANTIATE_TEST_SUITE_P(Programs, ShopProgram, testing::ValuesIn(written_in_shops()),
                         [](const auto& test) { return test.param.name; });

std::vector<std::string> seeds() {
  std::vector<std::string> texts;
  for (const char* folder : {"/oracle/macro", "/../clients/examples/macro"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(RIDGELINE_TESTS) + folder)) {
      if (entry.path().extension() != ".nc") continue;
      std::ifstream file(entry.path(), std::ios::binary);
      texts.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
  }
  std::sort(texts.begin(), texts.end());
  for (const Written& written : written_in_shops()) texts.push_back(written.text);
  return texts;
}

/// Runs, checks and lists a program. Returns whether it ended without alarm.
bool survives(const std::string& text) {
  Options options;
  options.limits = small_limits();
  options.library = [&](int number) {
    return number % 2 == 0 ? std::optional<std::string>(text) : std::nullopt;
  };
  const Result result = run(text, options);
  if (result.alarm) {
    EXPECT_GE(result.alarm->number, 3);
    EXPECT_FALSE(result.alarm->message.empty() && result.alarm->number < 3000);
    EXPECT_GE(result.alarm->line, 0);
  }
  EXPECT_LE(result.motion.size(), small_limits().moves);
  for (const Move& move : result.motion) EXPECT_TRUE(move.to.allFinite());
  EXPECT_FALSE(nc_text(result).empty());
  EXPECT_FALSE(csv_text(result).empty());
  check(text, options.profile, [](int) { return false; });
  return !result.alarm;
}

constexpr const char* fragments[] = {"#",
                                     "[",
                                     "]",
                                     "#[",
                                     "[[[[[",
                                     "]]]]]",
                                     "-",
                                     "=",
                                     "/",
                                     "*",
                                     "+",
                                     ".",
                                     "%",
                                     "(",
                                     ")",
                                     ";",
                                     "\n",
                                     "O",
                                     "O1\n",
                                     "N10",
                                     "GOTO10",
                                     "GOTO#1",
                                     "IF[",
                                     "]THEN",
                                     "WHILE[1EQ1]DO1\n",
                                     "END1\n",
                                     "DO2\n",
                                     "END2\n",
                                     "G65P9010A1.",
                                     "G66P9010",
                                     "G66.1P9010",
                                     "M98H10",
                                     "G67\n",
                                     "M98P9010L99999999",
                                     "M99\n",
                                     "M99P10\n",
                                     "G41D1",
                                     "G40",
                                     "G68X0Y0R45.",
                                     "G69\n",
                                     "G02X1.Y1.R1.",
                                     "G03I0.J0.",
                                     "G91",
                                     "G20",
                                     "G18",
                                     "G52X1.",
                                     "G53Z0",
                                     "#0",
                                     "#1",
                                     "#33",
                                     "#100",
                                     "#5001",
                                     "#13001=1e9",
                                     "#3000=1",
                                     "#99999999999999999999",
                                     "ATAN[",
                                     "SQRT[",
                                     "POW[2,",
                                     "999999999999",
                                     "99999999999999999999999999999",
                                     "-.",
                                     "\x01",
                                     "\xff",
                                     ",R5.",
                                     ",C-1.",
                                     "G10L2P1X1e9",
                                     "G73Z-1.R0Q0F1.",
                                     "G83Z-1.R1.Q.001F1.",
                                     "G51X0Y0P0",
                                     "G16",
                                     "F0",
                                     "F-1.",
                                     "#3001=0"};

// Inserted, deleted, replaced and doubled pieces of the oracle's and the shops' programs. A fixed
// seed: the same programs every time.
TEST(Robustness, MutatedProgramsEndWithAResultOrAnAlarm) {
  const std::vector<std::string> texts = seeds();
  ASSERT_GT(texts.size(), 60U);
  std::mt19937 random(20240607);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  constexpr int programs = 6000;
  int clean = 0;
  for (int i = 0; i < programs; ++i) {
    std::string text = texts[below(texts.size())];
    for (std::size_t n = 1 + below(5); n > 0; --n) {
      const std::size_t at = below(text.size() + 1);
      switch (below(5)) {
        case 0: text.insert(at, fragments[below(std::size(fragments))]); break;
        case 1: text.erase(at, 1 + below(8)); break;
        case 2: text.insert(at, text.substr(below(text.size() + 1), below(60))); break;
        case 3:
          if (at < text.size()) text[at] = static_cast<char>(32 + below(95));
          break;
        default: {
          const std::string& other = texts[below(texts.size())];
          text.insert(at, other.substr(below(other.size() + 1), below(80)));
        }
      }
    }
    SCOPED_TRACE(text);
    clean += survives(text) ? 1 : 0;
    ASSERT_FALSE(testing::Test::HasFailure());
  }
  EXPECT_GT(clean, programs / 50);
  EXPECT_LT(clean, programs);
}

TEST(Robustness, DeepAndLongTextsAreHandled) {
  const auto repeated = [](const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  };
  constexpr int many = 20'000;
  EXPECT_FALSE(survives("#1=" + repeated("[", many) + "1" + repeated("]", many) + "\nM30\n"));
  EXPECT_FALSE(survives("#1=" + repeated("#[", many) + "1\nM30\n"));
  EXPECT_FALSE(survives("#1=" + repeated("SIN[", many) + "1\nM30\n"));
  EXPECT_FALSE(survives("#1=" + repeated("IF[1EQ1]THEN ", many) + "#1=1\nM30\n"));
  EXPECT_TRUE(survives("#1=" + repeated("1+", many) + "1\nM30\n"));
  EXPECT_TRUE(survives("(" + repeated("(", many) + ")\nM30\n"));
  EXPECT_TRUE(survives("N1" + repeated("\n", many) + "M30\n"));
  EXPECT_TRUE(survives(repeated("%\n", many) + "M30\n"));
  EXPECT_TRUE(survives(repeated("O1\n", many) + "M30\n"));
  EXPECT_FALSE(survives(repeated("WHILE[1EQ1]DO1\n", many)));
  EXPECT_FALSE(survives(repeated("#1=0\nIF[#1EQ0]GOTO1\n", many / 10) + "N2M30\n"));
}

TEST(Robustness, NumbersBeyondAnIntAreNamedAsTheyAreWritten) {
  const auto message = [](const std::string& text) {
    const Result result = run(text);
    return result.alarm ? result.alarm->message : "no alarm";
  };
  const auto ends_with = [&](const std::string& text, const std::string& end) {
    return message(text).ends_with(end) ? "" : message(text);
  };
  EXPECT_EQ(ends_with("SETVN 999999999999[A]\nM30\n", "#999999999999"), "");
  EXPECT_EQ(ends_with("SETVN 2147483647[A,B]\nM30\n", "#2147483647"), "");
  EXPECT_EQ(ends_with("G65P1G99999999999A1\nM30\n", "G99999999999"), "");
  const std::vector<Finding> findings =
      check("G65P99999999999A1\nM30\n", {}, [](int) { return false; });
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].message.find("O99999999999 "), 0U);
}

// A jump searches all labels: many jumps over many labels still end at once.
TEST(Robustness, JumpsAmongManyLabelsAreQuick) {
  std::string text = "#1=0\nN1#1=#1+1\nIF[#1GT20000]GOTO99999\nGOTO1\n";
  for (int i = 2; i < 60'000; ++i) text += "N" + std::to_string(i) + "\n";
  text += "N99999#100=#1\nM30\n";
  const Result result = run(text);
  ASSERT_FALSE(result.alarm);
  EXPECT_EQ(result.variables.at(100).number, 20001);
}

// An endless program says how it began; where it was stopped is in the alarm and the position.
TEST(Robustness, EndlessMotionKeepsItsBeginning) {
  Options options;
  options.limits = small_limits();
  options.limits.kept = 100;
  const Result result = run("O1\nDO1\n#1=#1+1\nM8\nM9\nG0X#1A#1\nEND1\nM30", options);
  ASSERT_TRUE(result.alarm);
  EXPECT_EQ(result.alarm->number, static_cast<int>(AlarmNumber::StepLimit));
  ASSERT_EQ(result.motion.size(), 100U);
  EXPECT_EQ(result.motion[99].to.x(), 100);
  EXPECT_EQ(result.events.size(), 100U);
  EXPECT_EQ(result.axes.size(), 100U);
  EXPECT_GT(result.position.x(), 3000);
  EXPECT_EQ(result.warnings.size(), 2U);
  options.limits.steps = 300;
  EXPECT_EQ(run("O1\nDO1\n#1=#1+1\nG0X#1\nEND1\nM30", options).motion.size(), 75U);
}

}  // namespace
}  // namespace ridgeline::macro
