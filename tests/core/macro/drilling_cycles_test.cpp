// Drilling cycles G73 to G89 move by move, from machine zero with the initial level Z50.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/macro/snippet.hpp"

namespace ridgeline::macro {
namespace {

struct Drilling {
  const char* name;
  std::string text;
  std::vector<std::string> moves;
};
void PrintTo(const Drilling& drilling, std::ostream* out) {
  *out << drilling.name;
}

class DrillingCycle : public testing::TestWithParam<Drilling> {};

TEST_P(DrillingCycle, MovesAsTheManualDrawsIt) {
  const Result result = run("O1\nG90G0Z50.\n" + GetParam().text + "\nM30");
  ASSERT_FALSE(result.alarm) << result.alarm->message;
  std::vector<std::string> expected = GetParam().moves;
  expected.insert(expected.begin(), "G0 0 0 50");
  EXPECT_EQ(moves_text(result), expected);
}

// One hole at X10, R2, bottom Z-5; G98 back to Z50, G99 to R2.
INSTANTIATE_TEST_SUITE_P(
    Kinds, DrillingCycle,
    testing::Values(
        Drilling{"g81",
                 "G98G81X10.Z-5.R2.F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G0 10 0 50"}},
        Drilling{"g81_to_r",
                 "G99G81X10.Z-5.R2.F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G0 10 0 2"}},
        // Q3: to -1, 1 mm back, to -4, 1 mm back, to -5.
        Drilling{"g73",
                 "G99G73X10.Z-5.R2.Q3.F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -1", "G0 10 0 0", "G1 10 0 -4", "G0 10 0 -3",
                  "G1 10 0 -5", "G0 10 0 2"}},
        // The same, each time out to R and back to 1 mm above the last depth.
        Drilling{"g83",
                 "G99G83X10.Z-5.R2.Q3.F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -1", "G0 10 0 2", "G0 10 0 0", "G1 10 0 -4",
                  "G0 10 0 2", "G0 10 0 -3", "G1 10 0 -5", "G0 10 0 2"}},
        Drilling{"g83_without_q",
                 "G99G83X10.Z-5.R2.F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G0 10 0 2"}},
        Drilling{"g82_dwells",
                 "G98G82X10.Z-5.R2.P250F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G4 0.25", "G0 10 0 50"}},
        Drilling{"g81_does_not_dwell",
                 "G98G81X10.Z-5.R2.P250F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G0 10 0 50"}},
        Drilling{"g84_feeds_out",
                 "G98G84X10.Z-5.R2.P250F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G4 0.25", "G1 10 0 2", "G0 10 0 50"}},
        Drilling{"g74_feeds_out",
                 "G99G74X10.Z-5.R2.P250F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G4 0.25", "G1 10 0 2"}},
        Drilling{"g85_feeds_out",
                 "G98G85X10.Z-5.R2.P250F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G1 10 0 2", "G0 10 0 50"}},
        Drilling{"g86_stops_and_goes_out",
                 "G98G86X10.Z-5.R2.P250F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G0 10 0 50"}},
        Drilling{"g88_dwells",
                 "G98G88X10.Z-5.R2.P250F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G4 0.25", "G0 10 0 50"}},
        Drilling{"g89_dwells_and_feeds_out",
                 "G98G89X10.Z-5.R2.P250F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G4 0.25", "G1 10 0 2", "G0 10 0 50"}},
        // The tip leaves the wall along +X by Q, comes back at the top.
        Drilling{"g76_with_q",
                 "G98G76X10.Z-5.R2.Q.5P250F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G4 0.25", "G0 10.5 0 -5",
                  "G0 10.5 0 50", "G0 10 0 50"}},
        Drilling{"g76_with_i_and_j",
                 "G99G76X10.Z-5.R2.I-.3J.4F100.",
                 {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G0 9.7 0 -5", "G0 9.7 0.4 -5",
                  "G0 9.7 0.4 2", "G0 10 0.4 2", "G0 10 0 2"}},
        // Beside the bore down to R, to its centre, up to Z in feed, beside it, out.
        Drilling{"g87_with_q",
                 "G98G87X10.Z-5.R-12.Q.5P250F100.",
                 {"G0 10 0 50", "G0 10.5 0 50", "G0 10.5 0 -12", "G0 10 0 -12", "G1 10 0 -5",
                  "G4 0.25", "G0 10.5 0 -5", "G0 10.5 0 50", "G0 10 0 50"}},
        Drilling{"g87_with_j",
                 "G98G87X10.Z-5.R-12.J-2.F100.",
                 {"G0 10 0 50", "G0 10 -2 50", "G0 10 -2 -12", "G0 10 0 -12", "G1 10 0 -5",
                  "G0 10 -2 -5", "G0 10 -2 50", "G0 10 0 50"}}),
    [](const auto& sample) { return sample.param.name; });

// In G91 R counts from the initial level, Z from R: 50 - 40 = 10, 10 - 8 = 2.
INSTANTIATE_TEST_SUITE_P(
    Repeats, DrillingCycle,
    testing::Values(Drilling{"in_steps_by_k",
                             "G91G99G81X10.Y5.Z-8.R-40.K3F100.",
                             {"G0 10 5 50", "G0 10 5 10", "G1 10 5 2", "G0 10 5 10", "G0 20 10 10",
                              "G1 20 10 2", "G0 20 10 10", "G0 30 15 10", "G1 30 15 2",
                              "G0 30 15 10"}},
                    Drilling{"in_steps_by_l",
                             "G91G98G81X10.Z-8.R-40.L2F100.",
                             {"G0 10 0 50", "G0 10 0 10", "G1 10 0 2", "G0 10 0 50", "G0 20 0 50",
                              "G0 20 0 10", "G1 20 0 2", "G0 20 0 50"}},
                    Drilling{"steps_of_a_later_block",
                             "G99G81X0Z-5.R2.F100.\nG91X10.K2",
                             {"G0 0 0 50", "G0 0 0 2", "G1 0 0 -5", "G0 0 0 2", "G0 10 0 2",
                              "G1 10 0 -5", "G0 10 0 2", "G0 20 0 2", "G1 20 0 -5", "G0 20 0 2"}},
                    Drilling{"k_0_only_keeps_the_words",
                             "G98G81X10.Z-5.R2.K0F100.\nX20.",
                             {"G0 20 0 50", "G0 20 0 2", "G1 20 0 -5", "G0 20 0 50"}},
                    Drilling{"in_g90_at_the_same_place",
                             "G99G81X10.Z-5.R2.K2F100.",
                             {"G0 10 0 50", "G0 10 0 2", "G1 10 0 -5", "G0 10 0 2", "G0 10 0 2",
                              "G1 10 0 -5", "G0 10 0 2"}},
                    Drilling{"dwell_and_shift_stay",
                             "G99G76X0Z-5.R2.Q1.P100F100.\nX10.",
                             {"G0 0 0 50", "G0 0 0 2", "G1 0 0 -5", "G4 0.1", "G0 1 0 -5",
                              "G0 1 0 2", "G0 0 0 2", "G0 10 0 2", "G1 10 0 -5", "G4 0.1",
                              "G0 11 0 -5", "G0 11 0 2", "G0 10 0 2"}},
                    Drilling{"g80_forgets_them",
                             "G99G82X0Z-5.R2.P100F100.\nG80\nG82X10.Z-3.R1.",
                             {"G0 0 0 50", "G0 0 0 2", "G1 0 0 -5", "G4 0.1", "G0 0 0 2",
                              "G0 10 0 2", "G0 10 0 1", "G1 10 0 -3", "G0 10 0 1"}},
                    Drilling{"g00_ends_the_cycle",
                             "G99G81X0Z-5.R2.F100.\nG0X10.",
                             {"G0 0 0 50", "G0 0 0 2", "G1 0 0 -5", "G0 0 0 2", "G0 10 0 2"}},
                    Drilling{"r_alone_drills_again",
                             "G99G81X0Z-5.R2.F100.\nR1.",
                             {"G0 0 0 50", "G0 0 0 2", "G1 0 0 -5", "G0 0 0 2", "G0 0 0 2",
                              "G0 0 0 1", "G1 0 0 -5", "G0 0 0 1"}},
                    Drilling{"a_block_without_axes_does_not",
                             "G99G81X0Z-5.R2.F100.\nM8\nG4P500\nP200",
                             {"G0 0 0 50", "G0 0 0 2", "G1 0 0 -5", "G0 0 0 2", "G4 0.5"}}),
    [](const auto& sample) { return sample.param.name; });

class DrillingPlace : public testing::TestWithParam<Snippet> {};

TEST_P(DrillingPlace, IsWhereTheWordsSay) {
  expect_as_said(GetParam());
}

const double root3 = std::sqrt(3.0);

// Radius 100: 30 degrees is (50 root 3, 50), 150 degrees (-50 root 3, 50), 270 degrees (0, -100).
INSTANTIATE_TEST_SUITE_P(
    Polar, DrillingPlace,
    testing::Values(
        Snippet{
            "angles_in_g90",
            "O1\nG16\nG81X100.Y30.Z-5.R2.F100.\n#100=#5001\n#101=#5002\nY150.\n#102=#5001\n"
            "#103=#5002\nY270.\n#104=#5001\n#105=#5002\nG15G80\nM30",
            {{100, 50 * root3}, {101, 50}, {102, -50 * root3}, {103, 50}, {104, 0}, {105, -100}}},
        Snippet{"angles_in_g91",
                "O1\nG16\nG81X100.Y30.Z-5.R2.F100.\nG91Y120.\n#102=#5001\n#103=#5002\nY120.\n"
                "#104=#5001\n#105=#5002\nG15G80\nM30",
                {{102, -50 * root3}, {103, 50}, {104, 0}, {105, -100}}},
        Snippet{"repeated_angles",
                "O1\nG16\nG99G81X100.Y30.Z-5.R2.F100.\nG91Y120.K2\n#104=#5001\n#105=#5002\n"
                "G15G80\nM30",
                {{104, 0}, {105, -100}}},
        // A radius in G91 begins at the tool: from (10, 20), 90 degrees, 5 mm.
        Snippet{"radius_from_the_tool",
                "O1\nG0X10.Y20.\nG91G16X5.Y90.\n#100=#5001\n#101=#5002\nY90.\n#102=#5001\n"
                "#103=#5002\nG15\nM30",
                {{100, 10}, {101, 25}, {102, 5}, {103, 20}}},
        Snippet{"in_the_zx_plane",
                "O1\nG18G16\nG0Z10.X30.\n#100=#5001\n#101=#5003\nG15\nM30",
                {{100, 5}, {101, 5 * root3}}}),
    [](const auto& sample) { return sample.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Others, DrillingPlace,
    testing::Values(
        Snippet{"rotary_axis_goes_with_the_hole",
                "O1\nG81X10.A90.Z-5.R2.F100.\n#100=#5004\nG91A45.K2\n#101=#5004\n#102=#5001\nM30",
                {{100, 90}, {101, 180}, {102, 10}}},
        Snippet{"no_feed", "O1\n\nG81X10.Z-5.R2.\nM30", {}, 11, 3},
        Snippet{"too_many_depths", "O1\nG83X10.Z-200.R1.Q.001F100.\nM30", {}, 119, 2}),
    [](const auto& sample) { return sample.param.name; });

}  // namespace
}  // namespace ridgeline::macro
