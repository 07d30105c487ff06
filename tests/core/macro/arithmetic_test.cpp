// Arithmetic and functions of expressions: bits, BCD, the mantissa of older controls, and the
// alarms at the edges of each function.
#include <gtest/gtest.h>

#include "core/macro/parameters.hpp"
#include "tests/core/macro/snippet.hpp"

namespace ridgeline::macro {
namespace {

class Arithmetic : public testing::TestWithParam<Snippet> {};

TEST_P(Arithmetic, GivesWhatTheControlGives) {
  expect_as_said(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Bits, Arithmetic,
    testing::Values(
        // 12 = 1100, 10 = 1010: AND 1000, OR 1110, XOR 0110.
        Snippet{"and_or_xor",
                "O1\n#1=12\n#2=10\n#100=#1AND#2\n#101=#1OR#2\n#102=#1XOR#2\nM30",
                {{100, 8}, {101, 14}, {102, 6}}},
        Snippet{"with_a_negative_number",
                "O1\n#100=-1AND255\n#101=-256OR1\nM30",
                {{100, 255}, {101, -255}}},
        // 12.4 rounds to 12, 9.5 to 10.
        Snippet{"operands_are_rounded", "O1\n#1=12.4\n#2=9.5\n#100=#1AND#2\nM30", {{100, 8}}},
        Snippet{"vacant_is_zero", "O1\n#100=#1OR6\n#101=#1AND6\nM30", {{100, 6}, {101, 0}}},
        // AND with the products, OR and XOR with the sums: 1 OR [2 AND 6] = 3, [8 + 4] XOR 4 = 8.
        Snippet{"precedence",
                "O1\n#100=1OR2AND6\n#101=8+4XOR4\n#102=2*3AND5\nM30",
                {{100, 3}, {101, 8}, {102, 4}}},
        Snippet{"all_32_bits", "O1\n#100=4294967295AND65535\nM30", {{100, 65535}}},
        Snippet{"bit_33", "O1\n\n#100=4294967296AND1\nM30", {}, 110, 3},
        Snippet{"negative_bit_32", "O1\n#1=-2147483649\n#100=#1OR0\nM30", {}, 110, 3}),
    [](const auto& sample) { return sample.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Codes, Arithmetic,
    testing::Values(
        // 25 in BCD is 0010 0101 = 37; 1234 is hexadecimal 1234 = 4660.
        Snippet{"bcd",
                "O1\n#100=BCD[25]\n#101=BCD[1234]\n#102=BCD[0]\nM30",
                {{100, 37}, {101, 4660}, {102, 0}}},
        Snippet{"bin",
                "O1\n#100=BIN[37]\n#101=BIN[4660]\n#102=BIN[0]\nM30",
                {{100, 25}, {101, 1234}, {102, 0}}},
        Snippet{
            "eight_digits_there_and_back", "O1\n#100=BIN[BCD[99999999]]\nM30", {{100, 99999999}}},
        Snippet{"nine_digits_of_bcd", "O1\n#100=BCD[100000000]\nM30", {}, 119, 2},
        Snippet{"bcd_of_a_negative_number", "O1\n#100=BCD[-1]\nM30", {}, 119, 2},
        Snippet{"bin_of_a_negative_number", "O1\n#100=BIN[-1]\nM30", {}, 119, 2},
        Snippet{"bin_of_a_digit_ten", "O1\n#100=BIN[26]\nM30", {}, 119, 2}),
    [](const auto& sample) { return sample.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Functions, Arithmetic,
    testing::Values(
        Snippet{"powers",
                "O1\n#100=POW[2,10]\n#101=POW[9,.5]\n#102=POW[-2,3]\n#103=POW[0,0]\nM30",
                {{100, 1024}, {101, 3}, {102, -8}, {103, 1}}},
        Snippet{"root_of_a_negative_base", "O1\n#100=POW[-2,.5]\nM30", {}, 119, 2},
        Snippet{"reciprocal_of_zero", "O1\n#100=POW[0,-1]\nM30", {}, 119, 2},
        Snippet{"logarithms",
                "O1\n#100=LN[EXP[2.5]]\n#101=LN[1]\n#102=EXP[#0]\nM30",
                {{100, 2.5}, {101, 0}, {102, 1}}},
        Snippet{"logarithm_of_zero", "O1\n#100=LN[0]\nM30", {}, 119, 2},
        Snippet{"too_large_for_exp", "O1\n#100=EXP[1000]\nM30", {}, 111, 2},
        Snippet{"too_large_within_an_expression", "O1\n#100=1/EXP[1000]\nM30", {}, 111, 2},
        Snippet{"too_large_in_a_comparison", "O1\n\nIF[POW[10,400]GT1]GOTO9\nN9M30", {}, 111, 3},
        Snippet{"arc_sine_beyond_one", "O1\n#100=ASIN[1.001]\nM30", {}, 119, 2},
        Snippet{"arc_cosine_beyond_one", "O1\n#100=ACOS[-1.001]\nM30", {}, 119, 2},
        Snippet{
            "arc_functions",
            "O1\n#100=ASIN[-.5]\n#101=ACOS[-.5]\n#102=ASIN[1]\n#103=ACOS[0]\n#104=ATAN[-1]\nM30",
            {{100, 330}, {101, 120}, {102, 90}, {103, 90}, {104, -45}}},
        Snippet{"tangents",
                "O1\n#100=TAN[45]\n#101=TAN[135]\n#102=TAN[180]\nM30",
                {{100, 1}, {101, -1}, {102, 0}}},
        Snippet{"tangent_of_270", "O1\n#100=TAN[270]\nM30", {}, 119, 2},
        Snippet{"angle_of_nothing", "O1\n#100=ATAN[0]/[0]\nM30", {}, 112, 2},
        // The sign of the dividend; operands rounded: 7.6 MOD 3 = 8 MOD 3.
        Snippet{"modulo",
                "O1\n#100=-7MOD3\n#101=7MOD-3\n#102=7.6MOD3\n#103=7MOD-1\nM30",
                {{100, -1}, {101, 1}, {102, 2}, {103, 0}}},
        Snippet{"modulo_zero", "O1\n#100=7MOD.4\nM30", {}, 112, 2},
        Snippet{"exclusive_conditions",
                "O1\nIF[[1EQ1]XOR[1EQ2]]THEN#100=1\nIF[[1EQ1]XOR[2EQ2]]THEN#100=9\nM30",
                {{100, 1}}},
        Snippet{.name = "conditions_are_not_combined_on_a_16i",
                .text = "O1\n\nIF[[1EQ1]AND[2EQ2]]GOTO9\nN9M30",
                .variables = {},
                .alarm = 114,
                .line = 3,
                .control = "16i"},
        Snippet{.name = "no_power_on_a_16i",
                .text = "O1\n#100=POW[2,3]\nM30",
                .variables = {},
                .alarm = 114,
                .line = 2,
                .control = "16i"},
        // A10 comes as 0.010, A10. as 10: ADP gives back what was written.
        Snippet{"point_added",
                "O1\nG65P9A10B10.\nM30\nO9\n#100=#1\n#101=ADP[#1]\n#102=ADP[#2]\nM99",
                {{100, 0.01}, {101, 10}, {102, 10}}},
        Snippet{"point_added_to_a_common", "O1\n#100=ADP[#101]\nM30", {}, 114, 2},
        Snippet{"point_added_to_a_number", "O1\n#100=ADP[10]\nM30", {}, 114, 2}),
    [](const auto& sample) { return sample.param.name; });

// 32 bits of mantissa: 2^32 + 1 needs 33 bits and rounds away from zero to 2^32 + 2; 2^32 - 1 fits.
INSTANTIATE_TEST_SUITE_P(
    Mantissa, Arithmetic,
    testing::Values(Snippet{.name = "last_bit_is_rounded",
                            .text = "O1\n#1=65536\n#2=#1*#1\n#100=#2+1\n#101=#2-1\n#102=#2+4\nM30",
                            .variables = {{100, 4294967298}, {101, 4294967295}, {102, 4294967300}},
                            .control = "16i"},
                    // A digit lost: 10000 + 0.0000001 is 10000 there, with doubles it is not.
                    Snippet{.name = "small_addends_vanish",
                            .text = "O1\n#1=10000\nIF[#1+.0000001EQ#1]THEN#100=1\nM30",
                            .variables = {{100, 1}},
                            .control = "16i"},
                    Snippet{"small_addends_stay",
                            "O1\n#1=10000\n#100=0\nIF[#1+.0000001EQ#1]THEN#100=1\nM30",
                            {{100, 0}}},
                    // A literal has the same 32 bits as a computed value.
                    Snippet{.name = "literals_too",
                            .text = "O1\n#1=.1\n#2=#1*1\n#100=0\nIF[#1EQ#2]THEN#100=1\nM30",
                            .variables = {{100, 1}},
                            .control = "16i"},
                    Snippet{.name = "functions_too",
                            .text = "O1\n#1=SQRT[2]\n#2=#1*1\n#100=0\nIF[#1EQ#2]THEN#100=1\nM30",
                            .variables = {{100, 1}},
                            .control = "16i"}),
    [](const auto& sample) { return sample.param.name; });

}  // namespace
}  // namespace ridgeline::macro
