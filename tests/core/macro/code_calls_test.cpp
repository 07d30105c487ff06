#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/macro/interpreter.hpp"
#include "core/macro/parameters.hpp"

namespace ridgeline::macro {
namespace {

Options with(std::map<int, std::vector<double>> parameters) {
  Options options;
  options.profile.parameters = std::move(parameters);
  apply_parameters(options.profile);
  return options;
}

double common(const Result& result, int number) {
  EXPECT_FALSE(result.alarm) << result.alarm->message;
  const auto found = result.variables.find(number);
  return found == result.variables.end() || found->second.vacant ? -1 : found->second.number;
}

std::vector<std::string> functions(const Result& result) {
  std::vector<std::string> words;
  for (const Event& event : result.events) words.push_back(event.word);
  return words;
}

TEST(CodeCalls, GCodeOfAParameterCallsAMacro) {
  const Result result = run("O1\nG90G81.3A5.B2L2\nM30\nO9012\n#100=#100+#1\n#101=#2\nM99",
                            with({{6052, {0}}, {6041, {813}}, {6042, {9012}}, {6043, {1}}}));
  EXPECT_EQ(common(result, 100), 10);
  EXPECT_EQ(common(result, 101), 0.002);
}

TEST(CodeCalls, MinusMakesItModal) {
  const Result result = run("O1\nG101A3.\nG0X1.\nX2.\nG67\nX3.\nM30\nO9010\n#100=#100+#1\nM99",
                            with({{6050, {-101}}}));
  EXPECT_EQ(common(result, 100), 6);
}

// Inside the macro the code is the control's own: G81 drills there.
TEST(CodeCalls, CodesAreThemselvesInsideWhatTheyCall) {
  const Result result = run("O1\nG81X1.Z-5.R2.\nM30\nO9010\nG81X#24Z#26R#18F100\nG80\n#100=1\nM99",
                            with({{6050, {81}}}));
  EXPECT_EQ(common(result, 100), 1);
  EXPECT_EQ(result.motion.size(), 4U);  // over the hole, to R, down, up
}

TEST(CodeCalls, MCodeOfAParameterCallsAMacroWithArguments) {
  const Options options = with({{6080, {50}}, {6047, {70}}, {6048, {9100}}, {6049, {2}}});
  const Result result =
      run("O1\nM50A1.5\nM71A2.\nM30\nO9020\n#100=#1\nM99\nO9101\n#101=#1\nM99", options);
  EXPECT_EQ(common(result, 100), 1.5);
  EXPECT_EQ(common(result, 101), 2);
  EXPECT_EQ(functions(result), std::vector<std::string>{"M30"});  // the codes go no farther
}

// A subprogram is called after the rest of the block, with the caller's locals.
TEST(CodeCalls, MCodeOfAParameterCallsASubprogram) {
  const Result result =
      run("O1\n#1=4\nG0X3.M8M60\nM30\nO9001\n#100=#5001+#1\nM60\nM99", with({{6071, {60}}}));
  EXPECT_EQ(common(result, 100), 7);
  EXPECT_EQ(functions(result), (std::vector<std::string>{"M8", "M60", "M30"}));
}

TEST(CodeCalls, TCodeCallsO9000WithTheToolIn149) {
  const std::string program = "O1\nT12\nM30\nO9000\n#100=#149\nT#149\nM99";
  const Result result = run(program, with({{6001, {32}}}));
  EXPECT_EQ(common(result, 100), 12);
  EXPECT_EQ(result.tool, 12);
  EXPECT_EQ(common(run("O1\nT12\n#100=#149\nM30"), 100), -1);
}

TEST(CodeCalls, ProgramThatIsNotThereAlarmsAtTheCode) {
  const Result result = run("O1\n\nM50\nM30", with({{6080, {50}}}));
  ASSERT_TRUE(result.alarm);
  EXPECT_EQ(result.alarm->number, 78);
  EXPECT_EQ(result.alarm->line, 3);
}

TEST(Parameters, ReadBackAndDecideWhatTheControlDoes) {
  const Options options =
      with({{3401, {1}}, {6004, {1}}, {1241, {0, 0, 250}}, {5000, {7, 8, 9}}, {7001, {5}}});
  const Result result =
      run("O1\nG0X10\n#100=#5001\n#101=ATAN[-1]/[-1]\nG30Z0\n#102=#5023\n#103=PRM[5000]/[2]\n"
          "#104=PRM[7001,2]+PRM[7001,1]\n#105=PRM[3401]+PRM[6004,0]\nM30",
          options);
  EXPECT_EQ(common(result, 100), 10);
  EXPECT_EQ(common(result, 101), -135);
  EXPECT_EQ(common(result, 102), 250);
  EXPECT_EQ(common(result, 103), 8);
  EXPECT_EQ(common(result, 104), 1);
  EXPECT_EQ(common(result, 105), 2);
}

TEST(Parameters, RefuseCodesThatDoNotExist) {
  EXPECT_THROW(with({{6050, {100.5}}}), Error);
  EXPECT_THROW(with({{6071, {-3}}}), Error);
  EXPECT_THROW(with({{6001, {256}}}), Error);
}

}  // namespace
}  // namespace ridgeline::macro
