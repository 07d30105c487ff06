// System variables (design of a control: modal state by group, positions, offsets, clocks), each
// with the value that the program's own words give it.
#include <gtest/gtest.h>

#include <ctime>
#include <string>

#include "tests/core/macro/snippet.hpp"

namespace ridgeline::macro {
namespace {

class SystemVariable : public testing::TestWithParam<Snippet> {};

TEST_P(SystemVariable, HoldsWhatTheProgramSaid) {
  expect_as_said(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Modal, SystemVariable,
    testing::Values(
        Snippet{"at_power_on",
                "O1\n#101=#4001\n#102=#4002\n#103=#4003\n#104=#4004\n#105=#4005\n#106=#4006\n"
                "#107=#4007\n#108=#4008\n#109=#4009\n#110=#4010\n#111=#4011\n#112=#4012\n"
                "#113=#4013\n#114=#4014\n#115=#4015\n#116=#4016\n#117=#4017\n#122=#4022\nM30",
                {{101, 0},
                 {102, 17},
                 {103, 90},
                 {104, 23},
                 {105, 94},
                 {106, 21},
                 {107, 40},
                 {108, 49},
                 {109, 80},
                 {110, 98},
                 {111, 50},
                 {112, 67},
                 {113, 97},
                 {114, 54},
                 {115, 64},
                 {116, 69},
                 {117, 15},
                 {122, 50.1}}},
        Snippet{"groups_after_their_codes",
                "O1\nG1G19G91G22G95G20G42D3G44H4G99G96G55G61F2.5\n#101=#4001\n#102=#4002\n"
                "#103=#4003\n#104=#4004\n#105=#4005\n#106=#4006\n#107=#4007\n#108=#4008\n"
                "#110=#4010\n#113=#4013\n#114=#4014\n#115=#4015\nM30",
                {{101, 1},
                 {102, 19},
                 {103, 91},
                 {104, 22},
                 {105, 95},
                 {106, 20},
                 {107, 42},
                 {108, 44},
                 {110, 99},
                 {113, 96},
                 {114, 55},
                 {115, 61}}},
        Snippet{"cutting_modes",
                "O1\nG62\n#100=#4015\nG63\n#101=#4015\nG64\n#102=#4015\nM30",
                {{100, 62}, {101, 63}, {102, 64}}},
        Snippet{"geometry_modes",
                "O1\nG16\n#100=#4017\nG15\nG51X0Y0P2.\n#101=#4011\nG50\n#102=#4011\nG51.1X0\n"
                "#103=#4022\nG50.1X0\n#104=#4022\nG68X0Y0R10.\n#105=#4016\nG69\n#106=#4016\n"
                "G18\n#107=#4002\nM30",
                {{100, 16},
                 {101, 51},
                 {102, 50},
                 {103, 51.1},
                 {104, 50.1},
                 {105, 68},
                 {106, 69},
                 {107, 18}}},
        Snippet{"other_addresses",
                "O7\nN12G43H4T8S1500F250.M8\nG41D6\nG40E3.B20.\n#100=#4102\n#101=#4107\n"
                "#102=#4108\n#103=#4109\n#104=#4111\n#105=#4113\n#106=#4114\n#107=#4115\n"
                "#108=#4119\n#109=#4120\nG54.1P5\n#110=#4130\nM30",
                {{100, 20},
                 {101, 6},
                 {102, 3},
                 {103, 250},
                 {104, 4},
                 {105, 8},
                 {106, 12},
                 {107, 7},
                 {108, 1500},
                 {109, 8},
                 {110, 5}}},
        Snippet{"of_the_running_and_of_the_interrupted_block",
                "O1\nG1G91F9.\n#100=#4201\n#101=#4403\n#102=#4309\nM30",
                {{100, 1}, {101, 91}, {102, 9}}},
        Snippet{"main_program_within_a_call",
                "O5\nM98P6\nM30\nO6\n#100=#4000\n#101=#4115\nM99",
                {{100, 5}, {101, 6}}},
        Snippet{"of_a_group_of_other_machines", "O1\n#100=#4030\nM30", {{100, 0}}},
        Snippet{"axes_of_g22_and_of_g05_1_are_no_moves",
                "O1\nG0X1.\nG22X50.Y50.Z50.I-50.J-50.K-50.\n#100=#5001\n#101=#4004\nG23\n"
                "#102=#4004\nG5.1Q2X0Y0Z0\n#103=#5001\nM30",
                {{100, 1}, {101, 22}, {102, 23}, {103, 1}}},
        Snippet{"no_such_address", "O1\n\n#100=#4140\nM30", {}, 115, 3},
        Snippet{"written", "O1\n#4001=1\nM30", {}, 116, 2}),
    [](const auto& sample) { return sample.param.name; });

// G54 X100, external X1, H2 = 30 + 0.5: at G43 X10 Z5 the machine stands at X 10 + 101 and
// Z 5 + 30.5; present positions (#5041, #5061) hold the tool's length, programmed ones do not.
const std::string placed = "O1\n#5221=100.\n#5201=1.\n#11002=30.\n#10002=.5\nG0G43H2X10.Z5.A45.\n";

INSTANTIATE_TEST_SUITE_P(
    Positions, SystemVariable,
    testing::Values(Snippet{"of_the_block_s_end",
                            placed + "#100=#5001\n#101=#5002\n#102=#5003\n#103=#5004\nM30",
                            {{100, 10}, {101, 0}, {102, 5}, {103, 45}}},
                    Snippet{"of_the_machine",
                            placed + "#100=#5021\n#101=#5022\n#102=#5023\n#103=#5024\nM30",
                            {{100, 111}, {101, 0}, {102, 35.5}, {103, 45}}},
                    Snippet{"present_with_the_length",
                            placed + "#100=#5041\n#101=#5043\n#102=#5044\nM30",
                            {{100, 10}, {101, 35.5}, {102, 45}}},
                    Snippet{"of_the_length_offset",
                            placed + "#100=#5081\n#101=#5083\nG49\n#102=#5083\nM30",
                            {{100, 0}, {101, 30.5}, {102, 0}}},
                    Snippet{"of_the_length_offset_of_g44",
                            "O1\n#11002=30.\nG0G44H2Z5.\n#100=#5083\n#101=#5023\nM30",
                            {{100, -30}, {101, -25}}},
                    Snippet{"skipped_with_the_length",
                            placed + "G31X12.Z4.F100.\nG0X0Z50.\n#100=#5061\n#101=#5063\nM30",
                            {{100, 12}, {101, 34.5}}},
                    Snippet{"servo_and_distance_to_go_are_zero",
                            placed + "#100=#5101\n#101=#5121\n#102=#5181\nM30",
                            {{100, 0}, {101, 0}, {102, 0}}},
                    // 1 inch: the machine stands at 25.4 mm; rotary axes keep degrees.
                    Snippet{
                        "in_inches",
                        "O1\nG20\nG0X1.A30.\n#100=#5001\n#101=#5021\n#102=#5004\nG21\n#103=#5001\n"
                        "#104=#5004\nM30",
                        {{100, 1}, {101, 1}, {102, 30}, {103, 25.4}, {104, 30}}},
                    Snippet{"offsets_in_inches",
                            "O1\nG20\n#13001=1.\n#5222=2.\nG21\n#100=#13001\n#101=#5222\nM30",
                            {{100, 25.4}, {101, 50.8}}},
                    Snippet{"of_an_axis_too_many", "O1\n#100=#5010\nM30", {}, 115, 2},
                    Snippet{"of_no_kind", "O1\n#100=#5141\nM30", {}, 115, 2},
                    Snippet{"written_position", "O1\n#5001=1\nM30", {}, 116, 2}),
    [](const auto& sample) { return sample.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Offsets, SystemVariable,
    testing::Values(
        // C: #10000 H wear, #11000 H geometry, #12000 D wear, #13000 D geometry; #2000 and #2200
        // are the first two under their short numbers.
        Snippet{"memory_c",
                "O1\n#10003=.1\n#11003=50.\n#12003=.2\n#13003=4.\n#100=#2003\n#101=#2203\n"
                "G0G43H3Z0\n#102=#5023\nM30",
                {{100, 0.1}, {101, 50}, {102, 50.1}}},
        Snippet{.name = "memory_b",
                .text = "O1\n#10003=.1\n#11003=50.\n#100=#2003\n#101=#2203\nG0G43H3Z0\n"
                        "#102=#5023\nM30",
                .variables = {{100, 0.1}, {101, 50}, {102, 50.1}},
                .offset_memory = OffsetMemory::B},
        Snippet{.name = "memory_b_has_no_radii",
                .text = "O1\n#13003=4.\nM30",
                .variables = {},
                .alarm = 115,
                .line = 2,
                .offset_memory = OffsetMemory::B},
        Snippet{.name = "memory_a",
                .text = "O1\n#2003=50.\n#100=#10003\nG0G43H3Z0\n#101=#5023\nM30",
                .variables = {{100, 50}, {101, 50}},
                .offset_memory = OffsetMemory::A},
        Snippet{.name = "memory_a_has_no_geometry",
                .text = "O1\n#11003=4.\nM30",
                .variables = {},
                .alarm = 115,
                .line = 2,
                .offset_memory = OffsetMemory::A},
        Snippet{"work_offsets_by_axis",
                "O1\n#2500=1.\n#2501=2.\n#2606=3.\n#100=#5201\n#101=#5221\n#102=#5322\nM30",
                {{100, 1}, {101, 2}, {102, 3}}},
        Snippet{"additional_work_offsets",
                "O1\n#7001=5.\n#14021=6.\n#100=#14001\n#101=#7021\nM30",
                {{100, 5}, {101, 6}}},
        Snippet{"work_offset_moves_the_position",
                "O1\nG0X10.\n#5221=4.\n#100=#5001\n#101=#5021\nM30",
                {{100, 6}, {101, 10}}},
        Snippet{"offset_number_too_high", "O1\n#100=#14000\nM30", {}, 115, 2}),
    [](const auto& sample) { return sample.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Others, SystemVariable,
    testing::Values(
        Snippet{"constants",
                "O1\n#100=#3101\n#101=#3102\n#1=5\n#1=#3100\nIF[#1EQ#0]THEN#102=1\nM30",
                {{100, 3.14159265358979323846}, {101, 2.71828182845904523536}, {102, 1}}},
        Snippet{"written_constant", "O1\n#3101=3\nM30", {}, 116, 2},
        Snippet{"written_clock", "O1\n#3012=3\nM30", {}, 116, 2},
        Snippet{"outputs_are_kept", "O1\n#1100=1\n#100=#1100+#1101\nM30", {{100, 1}}},
        Snippet{"inputs_are_zero", "O1\n#100=#1000\nM30", {{100, 0}}},
        Snippet{"written_input", "O1\n#1000=1\nM30", {}, 116, 2},
        Snippet{
            "control_of_execution", "O1\n#3003=1\n#3004=2\n#100=#3003*10+#3004\nM30", {{100, 12}}},
        Snippet{"alarm_and_message_read_zero", "O1\n#100=#3000+#3006\nM30", {{100, 0}}},
        Snippet{"unknown_number", "O1\n#100=#9999\nM30", {}, 115, 2},
        Snippet{"unknown_number_written", "O1\n#9999=1\nM30", {}, 115, 2}),
    [](const auto& sample) { return sample.param.name; });

double common(const Result& result, int number) {
  EXPECT_FALSE(result.alarm) << result.alarm->message;
  return result.variables.at(number).number;
}

// 1.5 s of dwell between the preset and the reading, and a block of about 1 ms or two.
TEST(Clock, MillisecondsCountFromTheirPreset) {
  const Result result =
      run("O1\nG4P9000\n#3001=0\nG4P1500\n#100=#3001\n#3001=100\n#101=#3001\nM30");
  EXPECT_GE(common(result, 100), 1500);
  EXPECT_LE(common(result, 100), 1510);
  EXPECT_GE(common(result, 101), 100);
  EXPECT_LE(common(result, 101), 110);
  EXPECT_EQ(result.warnings.size(), 2U);  // a control reads ahead
}

TEST(Clock, HoursCountFromTheirPreset) {
  const Result result = run("O1\n#3002=2.5\nG4X7200.\n#100=#3002\nM30");
  EXPECT_NEAR(common(result, 100), 4.5, 1e-5);
}

// The date as a number 20240607 and the time 153059, read twice around the program's reading.
TEST(Clock, DateAndTimeAreThoseOfTheMachine) {
  const auto now = [] {
    const std::time_t time = std::time(nullptr);
    std::tm local{};
    localtime_r(&time, &local);
    char text[32];
    std::strftime(text, sizeof text, "%Y%m%d %H%M%S", &local);
    return std::string(text);
  };
  const std::string before = now();
  const Result result =
      run("O1\n#100=#3011\n#101=#3012\nIF[#3011EQ#100]GOTO9\n#100=#3011\n#101=#3012\nN9M30");
  const std::string after = now();
  const auto padded = [](double number, std::size_t digits) {
    std::string text = std::to_string(static_cast<int>(number));
    return std::string(digits - text.size(), '0') + text;
  };
  const std::string read = padded(common(result, 100), 8) + " " + padded(common(result, 101), 6);
  EXPECT_LE(before, read);
  EXPECT_LE(read, after);
}

// What a caller says before the run: inputs, the tool in the spindle, where a probe met the part.
TEST(Preset, CallerSetsWhatAProgramCannot) {
  Options options;
  options.set = {{7, 3.0}, {1003, 1.0}, {4120, 12.0}, {5062, 7.25}, {2504, 9.0}};
  const Result result =
      run("O1\n#100=#7\n#101=#1003\n#102=#4120\n#103=#5062\n#104=#5281\nM30", options);
  EXPECT_EQ(common(result, 100), 3);
  EXPECT_EQ(common(result, 101), 1);
  EXPECT_EQ(common(result, 102), 12);
  EXPECT_EQ(common(result, 103), 7.25);
  EXPECT_EQ(common(result, 104), 9);
}

TEST(Preset, VariableThatIsNotThereIsRefused) {
  for (const int number : {0, 34, 200, 1000000}) {
    Options options;
    options.set = {{number, 1.0}};
    EXPECT_THROW(run("O1\nM30", options), Error) << number;
  }
}

}  // namespace
}  // namespace ridgeline::macro
