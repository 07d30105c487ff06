#include <gtest/gtest.h>

#include <string>

#include "tests/core/macro/snippet.hpp"

namespace ridgeline::macro {
namespace {

class ShopSnippet : public testing::TestWithParam<Snippet> {};

TEST_P(ShopSnippet, RunsAsOnAControl) {
  expect_as_said(GetParam());
}

// #5001.. after the last block stand in commons, so that the moves show.
INSTANTIATE_TEST_SUITE_P(
    Flow, ShopSnippet,
    testing::Values(
        Snippet{"abbreviated_while", "O1\nWH[#1LT3]DO1\n#1=#1+1\nEND1\n#100=#1\nM30", {{100, 3}}},
        Snippet{
            "end_with_a_number", "O1\nWHILE[#1LT3]DO1\n#1=#1+1\nN49END1\n#100=#1\nM30", {{100, 3}}},
        Snippet{"goto_a_variable", "O1\n#22=20\nGOTO#22\n#100=1\nN20#101=2\nM30", {{101, 2}}},
        Snippet{
            "goto_an_expression", "O1\n#1=2\nGOTO[#1*10]\nN10#100=1\nN20#101=1\nM30", {{101, 1}}},
        Snippet{"goto_with_zeros", "O1\nGOTO0010\n#100=9\nN10#101=1\nM30", {{101, 1}}},
        Snippet{"code_from_a_variable",
                "O1\n#8=1\nG#8X10.F100.\n#100=#5001\n#101=#4001\nM30",
                {{100, 10}, {101, 1}}},
        Snippet{"blanks_everywhere",
                "O 1\nG 0 X 1 0 . 5 Y - 3 .\n# 1 0 0 = S I N [ 3 0 ]\n#101 = #5001\nM 3 0",
                {{100, 0.5}, {101, 10.5}}},
        Snippet{"do_in_words_apart",
                "O1\nDO 1\n#1=#1+1\nIF[#1 GT 3]GOTO 5\nEND 1\nN5 #100=#1\nM30",
                {{100, 4}}},
        Snippet{"one_line", "O1;WHILE[#1LE10]DO1;#1=#1+1;END1;#100=#1;M30;", {{100, 11}}},
        Snippet{"then_without_blanks", "O1\nIF[#1EQ#0]THEN#2=3\n#100=#2\nM30", {{100, 3}}},
        Snippet{"then_an_alarm", "O1\nIF[#7EQ#0]THEN#3000=91(NO DIA)\nM30", {}, 3091, 2},
        Snippet{"or_in_brackets",
                "O1\n#2=-1\nIF[[#1EQ1]OR[#2LT0]]GOTO5\n#100=1\nN5#101=1\nM30",
                {{101, 1}}},
        Snippet{"packed_arguments",
                "O1\nG65P9010A.5B-.2\nM30\nO9010\n#100=#1\n#101=#2\nM99",
                {{100, 0.5}, {101, -0.2}}},
        Snippet{"call_after_modes", "O1\nN10G90G65P9010A1.\nM30\nO9010\n#100=#1\nM99", {{100, 1}}},
        Snippet{"repeats_before_the_number", "O1\nM98L3P2\nM30\nO2\n#100=#100+1\nM99", {{100, 3}}},
        Snippet{"repeats_in_the_number", "O1\nM98P00030002\nM30\nO2\n#100=#100+1\nM99", {{100, 3}}},
        Snippet{"from_a_sequence_number",
                "O1\nM98P2Q50L2\nM30\nO2\n#100=9\nN50#101=#101+1\nM99",
                {{101, 2}}},
        Snippet{"a_part_of_the_same_program",
                "O1\nM98Q50\n#100=#101+1\nM30\nN50#101=7\nM99",
                {{100, 8}}},
        Snippet{"from_a_sequence_number_by_h",
                "O1\nG43H1Z5.\nM98P2H50L2\n#102=#5003\n#103=#4111\nM30\nO2\n#100=9\n"
                "N50#101=#101+1\nM99",
                {{101, 2}, {102, 5}, {103, 1}}},
        Snippet{"a_part_of_the_same_program_by_h",
                "O1\nM98H50\n#100=#101+1\nM30\nN50#101=7\nM99",
                {{100, 8}}},
        Snippet{"no_such_sequence_number_by_h", "O1\nM98P2H51\nM30\nO2\nM99", {}, 78, 2},
        Snippet{"no_such_sequence_number", "O1\nM98P2Q51\nM30\nO2\nM99", {}, 78, 2}),
    [](const auto& sample) { return sample.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Text, ShopSnippet,
    testing::Values(
        Snippet{"lower_case",
                "o1\ng0x1.\n#100=sin[30.]\nif[#100eq0.5]goto10\n#101=9\nn10 m30",
                {{100, 0.5}}},
        Snippet{"without_tape_marks", "O1(X)\nG0X1.\n#100=#5001\nM30", {{100, 1}}},
        Snippet{
            "ends_of_block_written", "%;\nO0001(TEST);\nG90G0X1.;\n#100=5;\nM30;\n%", {{100, 5}}},
        Snippet{"colon_for_the_letter", "%\n:0001\n#100=1\nM30\n%", {{100, 1}}},
        Snippet{
            "leader_before_the_tape_mark", "PART 17 REV B\n(X)\n%\nO1\n#100=1\nM30\n%", {{100, 1}}},
        Snippet{"leader_without_the_mark_is_read", "PART 17\nO1\nM30", {}, 5, 1},
        Snippet{"two_programs_with_one_mark", "G65P9010\nM30\n%\nO9010\n#100=4\nM99", {{100, 4}}},
        Snippet{"mark_behind_the_end", "O1\n#100=1\nM30%\nJUNK", {{100, 1}}},
        Snippet{"carriage_returns_alone", "%\rO1\r#100=1\rM30\r%\r", {{100, 1}}},
        Snippet{"carriage_returns_and_feeds", "%\r\nO1\r\n#100=1\r\nM30\r\n%\r\n", {{100, 1}}},
        Snippet{"zeros_of_a_tape", std::string("\0\0%\nO1\n#100=1\nM30\n%\0", 20), {{100, 1}}},
        Snippet{"comments_in_an_expression", "O1\n#100=[2(two)+3]*(times)4\nM30", {{100, 20}}},
        Snippet{"comment_without_end", "O1\n(UNCLOSED\n#100=1\nM30", {{100, 1}}},
        Snippet{"comment_after_a_loop",
                "O1\nWHILE[#1LT2]DO1(LOOP)\n#1=#1+1(INC)\nEND1(DONE)\n#100=#1\nM30",
                {{100, 2}}},
        Snippet{"skipped_blocks_with_numbers",
                "O1\n/2G0X5.\nN10/2#100=#5001\n///#101=1\nM30",
                {{100, 5}, {101, 1}}},
        Snippet{"signs_before_numbers",
                "O1\nG0X+10.Y+.5\n#100=+5.\n#101=#5002\nM30",
                {{100, 5}, {101, 0.5}}},
        Snippet{"minus_before_variables",
                "O1\n#1=5\nG0X-#1Y[-#1]Z-[#1+1]\n#100=#5001+#5002+#5003\nM30",
                {{100, -16}}},
        Snippet{"computed_number_of_a_variable",
                "O1\n#2=100\n#[#2+1]=7\n#102=#[#2+1]\nM30",
                {{101, 7}, {102, 7}}},
        Snippet{"abbreviated_functions",
                "O1\n#100=SQR[4]\n#101=RO[1.2]\n#102=SI[30]+AS[.5]\nM30",
                {{100, 2}, {101, 1}, {102, 30.5}}},
        Snippet{"both_forms_of_the_arc_tangent",
                "O1\n#100=ATAN[1]/[-1]\n#101=ATAN[1,-1]\nM30",
                {{100, 135}, {101, 135}}},
        Snippet{"words_after_the_program_number", "O1G0X1.\n#100=#5001\nM30", {{100, 1}}},
        Snippet{
            "additional_offset_by_g54",
            "O1\n#14021=5.\nG54P2\n#100=#4130\n#101=#4014\n#102=#5001\nG55\nG54G4P3\n#103=#4014\n"
            "G54M98P7\n#104=#4014\nM30\nO7\nM99",
            {{100, 2}, {101, 54.1}, {102, -5}, {103, 54}, {104, 54}}},
        Snippet{"rigid_tapping_codes",
                "O1\nG84.2X1.Z-3.R2.F1.\n#100=#4009\nG84.3X2.\n#101=#4009\n#102=#5003\nG80\nM30",
                {{100, 84}, {101, 74}, {102, 0}}},
        Snippet{"two_variables_in_a_row", "O1\n#1=100\n#101=##1\nM30", {}, 114, 3},
        Snippet{"letter_without_number", "O1\nG0X1.\nM117 \"HELLO\"\nM30", {}, 4, 3}),
    [](const auto& sample) { return sample.param.name; });

// G66.1: every block is G65 P_ with all its words, among them G, L, N and P, as arguments.
INSTANTIATE_TEST_SUITE_P(
    EachBlock, ShopSnippet,
    testing::Values(
        Snippet{
            "words_are_arguments",
            "O1\nG0X1.Y2.\nG66.1P9\n#501=#5001\nN5G91G1X10.F200M8L3P7\nG67\nG90\n#502=#5001\nM30\n"
            "O9\n#100=#24\n#101=#10\n#102=#9\n#103=#13\n#104=#12\n#105=#16\n#106=#4114\nM99",
            {{100, 10},
             {101, 1},
             {102, 200},
             {103, 8},
             {104, 3},
             {105, 7},
             {106, 5},
             {501, 1},
             {502, 1}}},
        Snippet{"calls_in_its_own_block",
                "O1\nG66.1P9A5.\nX1.\nX2.\nG67\nX3.\nM30\nO9\n#100=#100+1\n#101=#101+#1\nM99",
                {{100, 3}, {101, 5}}},
        Snippet{"modal_codes_act",
                "O1\nG66.1P9\nG91G1\nG67\n#100=#4001+#4003\nM30\nO9\nM99",
                {{100, 92}}},
        Snippet{"repeats_of_every_block",
                "O1\nG66.1P9L2\nX4.\nG67\nM30\nO9\nIF[#24EQ#0]GOTO9\n#100=#100+#24\nN9M99",
                {{100, 8}}},
        Snippet{"own_blocks_call_nothing",
                "O1\nG66.1P9\nX4.\nG67\n#101=#5001\nM30\nO9\nG0X[#24+1]\n#100=#100+1\nM99",
                {{100, 2}, {101, 5}}},
        Snippet{"within_a_modal_call",
                "O1\nG66P8\nG66.1P9\nX4.\nX5.\nG67G67\nM30\nO8\n#101=#101+1\nM99\n"
                "O9\nG0X#24\n#100=#100+1\n#102=#4012\nM99",
                {{100, 3}, {101, 2}, {102, 66.1}}},
        Snippet{"macro_statements_and_calls_stay",
                "O1\nG66.1P9\n#101=4\nM98P8\nG65P8A2.\nG67\n#103=#4012\nM30\nO9\n#100=#100+1\nM99\n"
                "O8\n#102=#102+1\nM99",
                {{100, 1}, {101, 4}, {102, 2}, {103, 67}}},
        Snippet{
            "increments_and_sets",
            "O1\nG66.1P9\nX1500I1.J2.I3.\nG67\nM30\nO9\n#100=#24\n#101=#4\n#102=#5\n#103=#7\nM99",
            {{100, 1.5}, {101, 1}, {102, 2}, {103, 3}}},
        Snippet{"corner_words", "O1\nG66.1P9\nX1.,R2.\nM30\nO9\nM99", {}, 125, 3},
        Snippet{"no_program", "O1\nG66.1P9\nX1.\nM30", {}, 78, 2}),
    [](const auto& sample) { return sample.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Names, ShopSnippet,
    testing::Values(
        Snippet{"named_commons",
                "O1\nSETVN 510[TOOL_NO, WORK_NO]\n[#TOOL_NO]=10\n[#WORK_NO]=[#TOOL_NO]*2\nM30",
                {{510, 10}, {511, 20}}},
        Snippet{"names_without_brackets_and_in_angles",
                "O1\nSETVN 500[COUNT]\n#COUNT=3\n#<COUNT>=#<COUNT>+1\nG0X[#COUNT]\n#100=#5001\nM30",
                {{500, 4}, {100, 4}}},
        Snippet{"variable_of_a_name_s_value",
                "O1\nSETVN 500[PTR]\n[#PTR]=101\n#[#PTR]=5\n#100=#[[#PTR]]\nM30",
                {{500, 101}, {101, 5}, {100, 5}}},
        Snippet{"the_lowest_number_has_the_name",
                "O1\nSETVN 505[A]\nSETVN 502[A]\nSETVN 509[A]\n[#A]=1\nM30",
                {{502, 1}}},
        Snippet{"then_a_name", "O1\nSETVN 500[A]\nIF[#1EQ#0]THEN[#A]=2\nM30", {{500, 2}}},
        Snippet{"name_that_nobody_gave", "O1\n[#A]=1\nM30", {}, 115, 2},
        Snippet{"name_of_a_local", "O1\nSETVN 5[A]\nM30", {}, 115, 2},
        Snippet{"system_names",
                "O1\nG0X7.Y8.\n#100=[#_ABSIO[2]]\n#2=1\n#101=#_ABSIO[#2]\n#102=[#_PI]\nM30",
                {{100, 8}, {101, 7}, {102, 3.14159265358979323846}}},
        Snippet{"system_names_written",
                "O1\n[#_WZG55[3]]=4\n#[#_WZP2[1]]=5\n[#_OFSHG[3]]=6\n#100=#5243+#14021+#11003\nM30",
                {{100, 15}}},
        Snippet{"vacant_by_name", "O1\n#1=5\n#1=[#_EMPTY]\nIF[#1EQ#0]THEN#100=1\nM30", {{100, 1}}},
        Snippet{"alarm_by_name", "O1\n\n[#_ALM]=12(BAD SIZE)\nM30", {}, 3012, 3},
        Snippet{"subscript_out_of_range", "O1\n#100=[#_ABSIO[21]]\nM30", {}, 115, 2},
        Snippet{"no_such_system_name", "O1\n#100=[#_NOTHING]\nM30", {}, 115, 2},
        Snippet{"many_axes",
                "O1\nG0Y3.\n#100=#100002\n#100351=4.\n#101=#5221\nM30",
                {{100, 3}, {101, 4}}},
        Snippet{"programs_by_name",
                "O1\nM98<SUB A>\nM98<SUBA>L2\nG65<CALL>A5.\nM30\nO<SUBA>\n#100=#100+1\nM99\n"
                "<CALL>\n#101=#1\nM99",
                {{100, 3}, {101, 5}}},
        Snippet{"a_name_that_is_a_number", "O1\nM98<O0002>\nM30\nO2\n#100=1\nM99", {{100, 1}}},
        Snippet{"modal_call_by_name",
                "O1\nG66<EACH>A2.\nG0X1.\nX2.\nG67\nM30\nO<EACH>\n#100=#100+#1\nM99",
                {{100, 4}}},
        Snippet{"no_program_of_the_name", "O1\nM98<NONE>\nM30", {}, 78, 2},
        Snippet{"known_parameters",
                "O1\n#100=PRM[3401,0]\n#101=PRM[1240]/[3]\n#102=PRM[3410]\nM30",
                {{100, 0}, {101, 0}, {102, 0.03}}},
        Snippet{"parameter_that_nobody_gave", "O1\n#100=PRM[1221]/[1]\nM30", {}, 119, 2}),
    [](const auto& sample) { return sample.param.name; });

}  // namespace
}  // namespace ridgeline::macro
