#include "core/macro/program_body.hpp"

#include <string>

#include "core/macro/cycle_section.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

namespace {

bool is_half_round(const Cycle& cycle) {
  return cycle.family == Family::HalfConvex || cycle.family == Family::HalfConcave;
}

// y of approach, as approach_y() in cycle_motion.cpp.
void write_approach(const Cycle& cycle, MacroText& text) {
  text.assign(27, "#7/2", "TOOL RADIUS");
  text.assign(28, "#27-#4", "CORE RADIUS");
  switch (cycle.family) {
    case Family::HalfConcave: text.assign(29, "#28+#4-#18", "Y OF APPROACH"); return;
    case Family::HalfConvex:
      text.assign(26, "ACOS[[#18+#4-#21]/[#18+#4]]", "ANGLE AT THE FOOT");
      text.assign(29, "-[#18+#4]*SIN[#26]-#28-#22", "Y OF APPROACH");
      return;
    case Family::BottomR:
      text.assign(29, "-#18-#28", "LAST TIP");
      text.if_then("#29 GT -#27", 29, "-#27");
      text.assign(29, "#29-#22", "Y OF APPROACH");
      break;
    case Family::RTaperR:
      if (cycle.lower == LowerRound::Concave) {
        text.assign(29, "-#21*TAN[#6/2]-#28", "LAST TIP");
        text.if_then("#29 GT -#27", 29, "-#27");
        text.assign(29, "#29-#22", "Y OF APPROACH");
        break;
      }
      [[fallthrough]];
    default: text.assign(29, "-#27-#22", "Y OF APPROACH"); break;
  }
  const bool is_hole = cycle.side == WallSide::Inside && cycle.edge != EdgeShape::Straight;
  if (is_hole) text.if_then("#29 LT -#19", 29, "-#19");
}

// In, in the section: to the tip (#14, #15) along the edge's place #10. #33 is the height before.
void write_step_in(const Cycle& cycle, MacroText& text) {
  const bool is_round_edge = cycle.edge != EdgeShape::Straight;
  text.begin_if("#33", "GE", "#11");
  text.line("G01 Z#15 F#8");
  text.end_if();
  if (is_half_round(cycle)) {
    text.begin_if("#15", "GT", "#33");
    text.line("G01 Z#15 F#9");
    text.end_if();
  }
  if (is_round_edge) text.assign(16, "#19-#20*#14");
  text.line("G01 " + place_words(cycle, "#10", "#14") + " F#9");
  text.line("G01 Z#15");
  text.assign(33, "#15");
}

void write_pass(const Cycle& cycle, MacroText& text, bool is_last_piece) {
  if (cycle.edge == EdgeShape::Straight) {
    text.line("G01 X#12");
  } else if (cycle.edge == EdgeShape::Circle) {
    text.line(std::string(cycle.counter_clockwise ? "G03" : "G02") +
              " I[-#16*COS[#10]] J[-#16*SIN[#10]]");
    return;
  } else {
    for (const bool is_left : {true, false}) {
      text.begin_if("#12", is_left ? "GT" : "LT", "#10");
      text.line(std::string(is_left ? "G03 " : "G02 ") + place_words(cycle, "#12", "#14") +
                " I[-#16*COS[#10]] J[-#16*SIN[#10]]");
      text.end_if();
    }
  }
  // The next pass begins where this one ended, or the tool goes up and back.
  text.begin_if("#13", "EQ", "0");
  if (is_last_piece) text.begin_if("#30", "LT", "#31");
  text.assign(16, "#29");
  if (cycle.family == Family::HalfConvex || cycle.family == Family::HalfConcave) {
    text.if_then("#14 GT 0", 16, "-#29");
  }
  text.line("G01 " + place_words(cycle, "#12", "#16") + " F#8");
  text.line("G01 Z#11");
  text.line("G00 " + place_words(cycle, "#10", "#16"));
  text.assign(33, "#11");
  if (is_last_piece) text.end_if();
  text.end_if();
  text.begin_if("#13", "NE", "0");
  text.assign(16, "#10");
  text.assign(10, "#12");
  text.assign(12, "#16");
  text.end_if();
}

/// One loop over the stations of a piece of the section: `last` is the expression of the station at
/// its end, tip_y and tip_z those of the tip at station #32.
struct Piece {
  std::string count;    ///< of steps, an expression before FUP
  std::string station;  ///< from the count #30
  std::string last;
  std::string tip_y, tip_z;
  int first = 0;  ///< 1: the piece before ended where this one begins
  bool is_last = true;
};

void write_piece(const Cycle& cycle, const Piece& piece, MacroText& text) {
  text.assign(31, "FUP[" + piece.count + "-0.000001]", "LAST STATION");
  text.if_then("#31 LT 0", 31, "0");
  text.assign(30, std::to_string(piece.first));
  text.begin_while("#30 LE #31");
  text.assign(32, piece.station);
  text.if_then("#30 EQ #31", 32, piece.last);
  if (cycle.family == Family::HalfConvex) {  // side of the ridge
    text.assign(16, "0");
    text.if_then("#32 GT 0", 16, "1");
    text.if_then("#32 LT 0", 16, "-1");
  }
  text.assign(14, piece.tip_y);
  text.assign(15, piece.tip_z);
  write_step_in(cycle, text);
  write_pass(cycle, text, piece.is_last);
  text.assign(30, "#30+1");
  text.end_while();
}

std::vector<Piece> pieces_of(const Cycle& cycle) {
  switch (cycle.family) {
    case Family::CornerR:
      return {{"90/#17", "#30*#17", "90", "#18-#28-[#18+#4]*SIN[#32]", "[#18+#4]*[COS[#32]-1]"}};
    case Family::BottomR:
      return {{"90/#17", "90-#30*#17", "0", "[#18-#4]*SIN[#32]-#18-#28",
               "#18-#4-#21-[#18-#4]*COS[#32]"}};
    case Family::HalfConvex:
      return {{"2*#26/#17", "#30*#17-#26", "#26", "[#18+#4]*SIN[#32]+#28*#16",
               "[#18+#4]*[COS[#32]-1]"}};
    case Family::HalfConcave: {
      const std::string y = "[#18-#4]*SIN[#32]";
      const std::string z = "-[#18-#4]*COS[#32]-#4";
      return {{"[90-#26]/#17", "#30*#17-90", "-#26", y + "+#28", z},
              {"[90-#26]/#17", "#26+#30*#17", "90", y + "-#28", z, 1}};
    }
    case Family::RTaperR: {
      const Piece top{"#6/#17", "#30*#17", "#6", "#5+#18*TAN[#6/2]-[#18+#4]*SIN[#32]-#28",
                      "[#18+#4]*[COS[#32]-1]"};
      const bool is_concave = cycle.lower == LowerRound::Concave;
      const std::string t2 = is_concave ? "#21*TAN[#6/2]" : "#21*TAN[[90-#6]/2]";
      const Piece slope{"#27/#26",
                        "#30*#26",
                        "#27",
                        "#5-[#18*TAN[#6/2]+#32]*COS[#6]-#4*SIN[#6]-#28",
                        "-[#18*TAN[#6/2]+#32]*SIN[#6]+#4*[COS[#6]-1]",
                        1};
      const Piece foot = is_concave ? Piece{"#6/#17",
                                            "#6-#30*#17",
                                            "0",
                                            "[#21-#4]*SIN[#32]-" + t2 + "-#28",
                                            "#21-#4-#5*TAN[#6]-[#21-#4]*COS[#32]",
                                            1}
                                    : Piece{"[90-#6]/#17",
                                            "#6+#30*#17",
                                            "90",
                                            "#21-[#21+#4]*SIN[#32]-#28",
                                            "[#21+#4]*COS[#32]-#4-#5*TAN[#6]-" + t2,
                                            1};
      return {top, slope, foot};
    }
    default:
      return {{"#5/COS[#6]/#17", "#30*#17", "#5/COS[#6]", "#5-#32*COS[#6]-#4*SIN[#6]-#28",
               "#4*[COS[#6]-1]-#32*SIN[#6]"}};
  }
}

}  // namespace

std::string place_words(const Cycle& cycle, const std::string& along, const std::string& y) {
  // A sign may not follow an operator: "-#27" is subtracted, not added.
  const bool is_negative = y.starts_with('-');
  const std::string size = is_negative ? y.substr(1) : y;
  if (cycle.edge == EdgeShape::Straight) {
    return "X" + along + " Y[#1" + (is_negative ? "-" : "+") + size + "]";
  }
  const std::string rho = std::string("[#19") + (is_negative ? "+" : "-") + "#20*" + size + "]";
  return "X[#24+" + rho + "*COS[" + along + "]] Y[#25+" + rho + "*SIN[" + along + "]]";
}

void write_along(const Cycle& cycle, MacroText& text) {
  write_approach(cycle, text);
  if (cycle.family == Family::HalfConcave) {
    text.assign(26, "0", "ANGLE FROM WHICH THE TOOL REACHES");
    text.begin_if("#28", "GT", "0");
    text.assign(26, "ASIN[#28/[#18-#4]]");
    text.end_if();
  }
  if (cycle.edge == EdgeShape::Straight) {
    text.assign(16, "1");
    text.if_then("#3 LT #2", 16, "-1");
    text.assign(10, "#2-#16*#23", "BEGIN OF A PASS");
    text.assign(12, "#3+#16*#23", "END OF A PASS");
  } else {
    text.assign(10, "#2", "BEGIN OF A PASS");
    text.assign(12, cycle.edge == EdgeShape::Arc ? "#3" : "#2", "END OF A PASS");
  }
  text.line("G90 G00 " + place_words(cycle, "#10", "#29"));
  text.line("G00 Z#11");
  text.assign(33, "#11", "HEIGHT");
  std::vector<Piece> pieces = pieces_of(cycle);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (cycle.family == Family::RTaperR && i == 1) {
      const bool is_concave = cycle.lower == LowerRound::Concave;
      text.assign(27,
                  "#5/COS[#6]-#18*TAN[#6/2]-#21*TAN[" +
                      std::string(is_concave ? "#6/2" : "[90-#6]/2") + "]",
                  "LENGTH OF THE SLOPE");
    }
    pieces[i].is_last = i + 1 == pieces.size();
    write_piece(cycle, pieces[i], text);
  }
  if (cycle.edge != EdgeShape::Circle) text.if_then("#13 EQ 0", 10, "#12");
  const std::string out = is_half_round(cycle) ? "-#29" : "#29";
  text.assign(16, out);
  text.line("G01 " + place_words(cycle, "#10", "#16") + " F#8");
  text.line("G01 Z#11");
}

void write_body(const Cycle& cycle, MacroText& text) {
  switch (cycle.family) {
    case Family::HelicalSide:
    case Family::HelicalCornerR: write_helix(cycle, text); return;
    case Family::Rotation: write_rotation(cycle, text); return;
    case Family::Series: write_series(cycle, text); return;
    default: break;
  }
  if (cycle.method == 1) {
    write_approach(cycle, text);
    write_across(cycle, text);
  } else {
    write_along(cycle, text);
  }
}

}  // namespace ridgeline::macro
