// Codes that set coordinates: G10, G92, G52, mirror image, scaling, rotation, reference positions.
#include <gtest/gtest.h>

#include "tests/core/macro/snippet.hpp"

namespace ridgeline::macro {
namespace {

class Setting : public testing::TestWithParam<Snippet> {};

TEST_P(Setting, LeavesWhatItSays) {
  expect_as_said(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Preset, Setting,
    testing::Values(
        // The machine at X10 is called X2: X1 is machine X9.
        Snippet{"g92_names_the_place",
                "O1\nG0X10.Y5.\nG92X2.\n#100=#5001\n#101=#5002\n#102=#5021\nG0X1.\n#103=#5021\nM30",
                {{100, 2}, {101, 5}, {102, 10}, {103, 9}}},
        Snippet{"g92_in_g91_too", "O1\nG0X10.\nG91G92X2.\n#100=#5001\nM30", {{100, 2}}},
        Snippet{"g92_twice", "O1\nG0X10.\nG92X2.\nG92X7.\nG0X0\n#100=#5021\nM30", {{100, 3}}},
        Snippet{"g92_in_all_work_systems",
                "O1\n#5241=100.\nG0X10.\nG92X0\nG55G0X0\n#100=#5021\nM30",
                {{100, 110}}},
        Snippet{"g92_with_the_tool_s_length",
                "O1\n#11001=30.\nG0G43H1Z20.\nG92Z0\n#100=#5003\nG0Z-1.\n#101=#5023\nM30",
                {{100, 0}, {101, 49}}},
        Snippet{"g92_s_is_a_limit", "O1\nS100\nG92S3000\n#100=#4119\nM30", {{100, 100}}},
        Snippet{"g92_of_a_rotary_axis",
                "O1\nG0A90.\nG92A0\n#100=#5004\n#101=#5024\nM30",
                {{100, 0}, {101, 90}}},
        // G52 X5 ends on X, that of Y stays.
        Snippet{"g92_ends_g52_of_its_axes",
                "O1\nG52X5.Y6.\nG92X0\n#100=#5001\nG52X0\n#101=#5001\n#102=#5002\nM30",
                {{100, 0}, {101, 0}, {102, -6}}},
        Snippet{"g92_1_of_one_axis",
                "O1\nG92X5.Y6.\nG92.1X0\n#100=#5001\n#101=#5002\nM30",
                {{100, 0}, {101, 6}}},
        Snippet{"g92_1_ends_g52", "O1\nG52X5.\nG92.1X0\n#100=#5001\nM30", {{100, 0}}},
        Snippet{"g92_1_of_all_axes",
                "O1\nG92X5.Y6.\nG92.1\n#100=#5001\n#101=#5002\nM30",
                {{100, 0}, {101, 0}}},
        Snippet{"g52_shifts_all_work_systems",
                "O1\nG52X5.\n#100=#5001\nG55G0X1.\n#101=#5021\nG52X0\nG0X1.\n#102=#5021\nM30",
                {{100, -5}, {101, 6}, {102, 1}}}),
    [](const auto& sample) { return sample.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Data, Setting,
    testing::Values(
        Snippet{"work_offset",
                "O1\nG10L2P2X100.Y50.\n#100=#5241\n#101=#5242\n#102=#5221\nM30",
                {{100, 100}, {101, 50}, {102, 0}}},
        Snippet{"external_offset_moves_the_position",
                "O1\nG10L2P0X3.\n#100=#5201\n#101=#5001\nM30",
                {{100, 3}, {101, -3}}},
        Snippet{"work_offset_in_steps",
                "O1\nG10L2P1X10.\nG91G10L2P1X2.5\n#100=#5221\nM30",
                {{100, 12.5}}},
        Snippet{"active_work_offset_without_p", "O1\nG55\nG10L2Z4.\n#100=#5243\nM30", {{100, 4}}},
        Snippet{"additional_work_offset",
                "O1\nG10L20P3X7.\nG10L20P300Y8.\n#100=#14041\n#101=#19982\nG54.1P3G0X1.\n"
                "#102=#5021\nM30",
                {{100, 7}, {101, 8}, {102, 8}}},
        Snippet{"work_offset_too_high", "O1\nG10L2P7X1.\nM30", {}, 119, 2},
        Snippet{"additional_work_offset_too_high", "O1\nG10L20P301X1.\nM30", {}, 119, 2},
        Snippet{"additional_work_offset_0", "O1\nG10L20P0X1.\nM30", {}, 119, 2},
        Snippet{"no_such_l", "O1\nG10L99P1R1.\nM30", {}, 119, 2},
        Snippet{"negative_l", "O1\nG10L-2P1X1.\nM30", {}, 119, 2},
        Snippet{"no_such_additional_system", "O1\nG54.1P301\nM30", {}, 119, 2},
        Snippet{"memory_c",
                "O1\nG10L10P3R50.\nG10L11P3R.1\nG10L12P3R4.\nG10L13P3R.2\n#100=#11003\n"
                "#101=#10003\n#102=#13003\n#103=#12003\nM30",
                {{100, 50}, {101, 0.1}, {102, 4}, {103, 0.2}}},
        Snippet{"old_l1_is_wear", "O1\nG10L1P3R.1\n#100=#10003\nM30", {{100, 0.1}}},
        Snippet{.name = "memory_b",
                .text = "O1\nG10L10P3R50.\nG10L11P3R.1\n#100=#11003\n#101=#10003\nM30",
                .variables = {{100, 50}, {101, 0.1}},
                .offset_memory = OffsetMemory::B},
        Snippet{.name = "memory_a",
                .text = "O1\nG10L11P3R50.\n#100=#10003\nG0G43H3Z1.\n#101=#5023\nG10P4R3.\n"
                        "#102=#2004\nM30",
                .variables = {{100, 50}, {101, 51}, {102, 3}},
                .offset_memory = OffsetMemory::A},
        Snippet{
            "offset_in_steps", "O1\nG10L12P3R4.\nG91G10L12P3R-.5\n#100=#13003\nM30", {{100, 3.5}}},
        Snippet{"offset_in_inches", "O1\nG20\nG10L12P3R1.\nG21\n#100=#13003\nM30", {{100, 25.4}}},
        Snippet{"offset_without_a_number", "O1\nG10L12R4.\nM30", {}, 30, 2},
        Snippet{"offset_number_too_high", "O1\nG10L12P1000R4.\nM30", {}, 30, 2},
        Snippet{"offset_without_a_value", "O1\nG10L12P1\nM30", {}, 5, 2},
        Snippet{"h_too_high", "O1\nG43H1000\nM30", {}, 30, 2}),
    [](const auto& sample) { return sample.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Images, Setting,
    testing::Values(
        // About X50 the program's X60 is machine X40.
        Snippet{"mirror_of_x",
                "O1\nG51.1X50.\nG0X60.Y10.\n#100=#5001\n#101=#5021\n#102=#5022\nM30",
                {{100, 60}, {101, 40}, {102, 10}}},
        Snippet{"mirror_of_both",
                "O1\nG51.1X50.Y0\nG0X60.Y10.\n#101=#5021\n#102=#5022\nM30",
                {{101, 40}, {102, -10}}},
        Snippet{"mirrors_add_up_and_end_by_axis",
                "O1\nG51.1X50.\nG51.1Y0\nG0X60.Y10.\nG50.1X0\n#100=#5001\n#101=#5002\n"
                "#102=#4022\nG50.1Y0\n#103=#5002\n#104=#4022\nM30",
                {{100, 40}, {101, 10}, {102, 51.1}, {103, -10}, {104, 50.1}}},
        Snippet{"all_mirrors_end",
                "O1\nG51.1X0Y0\nG0X1.Y2.\nG50.1\n#100=#5001\n#101=#5002\nM30",
                {{100, -1}, {101, -2}}},
        Snippet{"mirrored_steps", "O1\nG51.1X0\nG91G0X10.\nX10.\n#100=#5021\nM30", {{100, -20}}},
        // A quarter turn left of (10, 0) is (0, 10); of the mirror image (-10, 0) right, (0, 10).
        Snippet{"one_mirror_turns_rotation_round",
                "O1\nG51.1X0\nG68X0Y0R90.\nG0X10.Y0\n#100=#5021\n#101=#5022\nM30",
                {{100, 0}, {101, 10}}},
        // The mirrored program about (20, 0): (30, 0) turns to (20, 10), mirrored (-20, 10).
        Snippet{"the_centre_of_rotation_is_mirrored",
                "O1\nG51.1X0\nG68X20.Y0R90.\nG0X30.Y0\n#100=#5021\n#101=#5022\nM30",
                {{100, -20}, {101, 10}}},
        Snippet{"two_mirrors_do_not",
                "O1\nG51.1X0Y0\nG68X0Y0R90.\nG0X10.Y0\n#100=#5021\n#101=#5022\nM30",
                {{100, 0}, {101, -10}}},
        Snippet{"scale",
                "O1\nG51X10.Y0P2.\nG0X15.Y3.\n#100=#5021\n#101=#5022\nG50\n#102=#5001\nM30",
                {{100, 20}, {101, 6}, {102, 20}}},
        Snippet{"scale_without_point", "O1\nG51X0Y0P1500\nG0X10.\n#100=#5021\nM30", {{100, 15}}},
        Snippet{"scale_by_axis",
                "O1\nG51X0Y0Z0I2.J3.K1.\nG0X1.Y1.Z1.\n#100=#5021\n#101=#5022\n"
                "#102=#5023\nM30",
                {{100, 2}, {101, 3}, {102, 1}}},
        Snippet{"scale_zero", "O1\nG51X0Y0P0\nM30", {}, 119, 2},
        Snippet{"arc_scaled_unequally", "O1\nG51X0Y0I2.J1.\nG2X10.Y10.R10.F100.\nM30", {}, 113, 3},
        // Scaled by 2 about 0 the centre (10, 0) is (20, 0): (40, 0) turns to (20, 20).
        Snippet{"the_centre_of_rotation_is_scaled",
                "O1\nG51X0Y0P2.\nG68X10.Y0R90.\nG0X20.Y0\n#100=#5021\n#101=#5022\nM30",
                {{100, 20}, {101, 20}}},
        Snippet{"rotation_of_an_arc_s_plane", "O1\nG68X0Y0R30.\nG18\nM30", {}, 144, 3},
        Snippet{"rotation_started_again_in_compensation",
                "O1\n#13001=1.\nG68X0Y0R30.\nG1G41D1X10.F100.\nX20.\nG68X0Y0R40.\nM30",
                {},
                144,
                6}),
    [](const auto& sample) { return sample.param.name; });

INSTANTIATE_TEST_SUITE_P(
    References, Setting,
    testing::Values(
        // Back through (10, 0) to (30, 0); in G91 30 beyond the intermediate point.
        Snippet{"g29_in_g90",
                "O1\nG0X5.\nG28X10.\n#100=#5001\nG29X30.\n#101=#5001\nM30",
                {{100, 0}, {101, 30}}},
        Snippet{"g29_in_g91", "O1\nG0X5.\nG28X10.\nG91G29X30.\n#101=#5001\nM30", {{101, 40}}},
        Snippet{"no_fifth_reference", "O1\nG30P5X0\nM30", {}, 119, 2},
        Snippet{"g27_at_the_reference", "O1\nG0X5.\nG27X0\n#100=#5001\nM30", {{100, 0}}},
        Snippet{"g27_elsewhere", "O1\nG0X5.\nG27X1.\nM30", {}, 92, 3},
        // G60 goes as G00, whatever is modal, once.
        Snippet{"g60_is_rapid", "O1\nG1G60X5.\n#100=#5001\n#101=#4001\nM30", {{100, 5}, {101, 1}}}),
    [](const auto& sample) { return sample.param.name; });

// The blocks up to G11 are data of the control, no motion; the run says that it leaves them out.
TEST(ParameterInput, IsLeftOutWithAWarning) {
  for (const std::string L : {"3", "50", "52", "70"}) {
    const Result result =
        run("O1\nG10L" + L + "\nN5000P1R10.\nN1220X99.\nG11\nG0X1.\n#100=#5001\nM30");
    ASSERT_FALSE(result.alarm) << result.alarm->message;
    EXPECT_EQ(moves_text(result), std::vector<std::string>{"G0 1 0 0"}) << L;
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_EQ(result.warnings[0], "G10 L" + L + " up to G11 is not simulated");
  }
}

// In X about 0: the left quarter arc to (10, 10) about (0, 10) becomes a right one to (-10, 10).
TEST(MirrorImage, OfOneAxisTurnsArcsRound) {
  const std::string arc = "G0X0Y0\nG3X10.Y10.J10.F100.\nM30";
  EXPECT_EQ(moves_text(run("O1\n" + arc)).back(), "G3 10 10 0 centre 0 10 0");
  EXPECT_EQ(moves_text(run("O1\nG51.1X0\n" + arc)).back(), "G2 -10 10 0 centre 0 10 0");
  EXPECT_EQ(moves_text(run("O1\nG51.1X0Y0\n" + arc)).back(), "G3 -10 -10 0 centre 0 -10 0");
  EXPECT_EQ(moves_text(run("O1\nG51X0Y0I-1.J1.\n" + arc)).back(), "G2 -10 10 0 centre 0 10 0");
}

// G41 by 2 along +X is 2 above; mirrored in X the way goes along -X and 2 above is to its right.
TEST(MirrorImage, OfOneAxisChangesSidesOfTheCutter) {
  const std::string text = "#13001=2.\nG0Y0\nG1G41D1X10.F100.\nX20.\nG40X30.\nM30";
  EXPECT_EQ(moves_text(run("O1\n" + text))[2], "G1 20 2 0");
  EXPECT_EQ(moves_text(run("O1\nG51.1X0\n" + text))[2], "G1 -20 2 0");
}

// With memory A one register is both length and radius.
TEST(OffsetMemory, AHasOneValueForLengthAndRadius) {
  Options options;
  options.profile.offset_memory = OffsetMemory::A;
  const Result result = run("O1\nG10L11P3R2.\nG1G41D3X10.F100.\nX20.\nG40X30.\nM30", options);
  ASSERT_FALSE(result.alarm) << result.alarm->message;
  EXPECT_EQ(moves_text(result)[1], "G1 20 2 0");
}

}  // namespace
}  // namespace ridgeline::macro
