#include <string>

#include "core/macro/cycle_section.hpp"
#include "core/macro/program_body.hpp"

namespace ridgeline::macro {

namespace {

/// Statements of one section, from A at the clearance height to beside the last contact; as
/// trace_section() in cycle_motion.cpp.
void write_section(const Cycle& cycle, MacroText& text) {
  const auto y_line = [&](const std::string& y, const std::string& rest) {
    if (cycle.edge == EdgeShape::Straight) {
      const bool is_negative = y.starts_with('-');  // a sign may not follow an operator
      text.line("G01 Y[#1" + (is_negative ? y : "+" + y) + "]" + rest);
    } else {
      text.line("G01 " + place_words(cycle, "#32", y) + rest);
    }
  };
  switch (cycle.family) {
    case Family::Taper:
      y_line("#10", " F#8");
      y_line("-#27", " Z-#12 F#9");
      break;
    case Family::CornerR:
      y_line("#18-#28", " F#8");
      text.line("G01 Z0 F#9");
      text.line("G03 Y[#1-#27] Z[-#18-#4] J0 K[-#18-#4]");
      break;
    case Family::BottomR:
      text.line("G01 Z[#18-#4-#21] F#9");
      y_line("-#27", "");
      text.begin_if("#18-#4", "GT", "0.0005");
      text.line("G02 Y[#1-#18-#28] Z[-#21] J[#4-#18] K0");
      text.end_if();
      text.line("G01 Z#11 F#8");
      break;
    case Family::HalfConvex:
      text.line("G01 Z#12 F#8");
      y_line("-#10", " F#9");
      text.line("G02 Y[#1-#28] Z0 J[#10-#28] K[-#18-#4-#12]");
      y_line("#28", "");
      text.line("G02 Y[#1+#10] Z#12 J0 K[-#18-#4]");
      y_line("-#29", " F#8");
      text.line("G01 Z#11");
      break;
    default:  // HalfConcave
      text.line("G01 Z-#4 F#9");
      text.begin_if("#18-#4", "GT", "0.0005");
      text.line("G03 Y#1 Z#12 J[#18-#4] K0");
      text.line("G03 Y[#1-#29] Z-#4 J-#28 K[-#4-#12]");
      text.end_if();
      text.line("G01 Z#11 F#8");
      break;
  }
  if (cycle.family == Family::Taper || cycle.family == Family::CornerR) {
    y_line("#29", " F#8");
    text.line("G01 Z#11");
  } else {
    y_line("#29", " F#8");
  }
}

void write_lengths(const Cycle& cycle, MacroText& text) {
  switch (cycle.family) {
    case Family::Taper:
      text.assign(10, "#5-#27+#11/TAN[#6]+#4*[1-TAN[#6/2]]", "B");
      text.assign(12, "#5*TAN[#6]+#4*[1-TAN[[90-#6]/2]]", "C");
      break;
    case Family::HalfConvex:
      text.assign(10, "[#18+#4]*SIN[#26]+#28", "Y OF THE FOOT");
      text.assign(12, "[#18+#4]*[COS[#26]-1]", "Z OF THE FOOT");
      break;
    case Family::HalfConcave:
      text.assign(12, "-#4-SQRT[[#18-#4]*[#18-#4]-#28*#28]", "Z OF THE BOTTOM");
      break;
    default: break;
  }
}

void write_rapid_in(const Cycle& cycle, MacroText& text, const std::string& y) {
  text.line("G90 G00 " + place_words(cycle, "#2", y));
  text.line("G00 Z#11");
}

}  // namespace

void write_across(const Cycle& cycle, MacroText& text) {
  write_lengths(cycle, text);
  const bool has_arcs = cycle.family != Family::Taper;
  text.assign(16, "1");
  text.if_then("#3 LT #2", 16, "-1");
  text.assign(31, "FUP[ABS[#3-#2]/#17-0.000001]", "LAST PASS");
  text.if_then("#31 LT 0", 31, "0");
  write_rapid_in(cycle, text, "#29");
  if (has_arcs) text.line("G19");
  text.assign(30, "0");
  text.begin_while("#30 LE #31");
  text.assign(32, "#2+#16*#30*#17");
  text.if_then("#30 EQ #31", 32, "#3");
  if (cycle.edge == EdgeShape::Straight) {
    text.line("G01 X#32 F#8");
  } else {
    text.line("G01 " + place_words(cycle, "#32", "#29") + " F#8");
  }
  write_section(cycle, text);
  text.assign(30, "#30+1");
  text.end_while();
  if (has_arcs) text.line("G17");
}

void write_helix(const Cycle& cycle, MacroText& text) {
  Cycle circle = cycle;
  circle.edge = EdgeShape::Circle;
  const std::string arc = cycle.counter_clockwise ? "G03" : "G02";
  const std::string sense = cycle.counter_clockwise ? "" : "-";
  const std::string turn = " I[-#16*COS[#32]] J[-#16*SIN[#32]]";
  text.assign(27, "#7/2", "TOOL RADIUS");
  text.assign(28, "#27-#4", "CORE RADIUS");
  text.assign(29, "-#27-#22", "Y OF APPROACH");
  if (cycle.side == WallSide::Inside) text.if_then("#29 LT -#19", 29, "-#19");
  text.assign(16, "#19+#20*#27", "RADIUS OF THE LAST CIRCLE");
  if (cycle.family == Family::HelicalSide) {
    write_rapid_in(circle, text, "#29");
    text.line("G01 Z0 F#9");
    text.line("G01 " + place_words(circle, "#2", "-#27"));
    text.assign(32, "#2", "ANGLE");
    text.assign(31, "FIX[#21/#17+0.000001]", "FULL TURNS");
    text.assign(30, "1");
    text.begin_while("#30 LE #31");
    text.line(arc + turn + " Z[-#30*#17]");
    text.assign(30, "#30+1");
    text.end_while();
    text.assign(33, "#21-#31*#17", "REST");
    text.begin_if("#33", "GT", "0.000001*#17");
    text.assign(12, "#2+" + sense + "360*#33/#17");
    text.line(arc + " " + place_words(circle, "#12", "-#27") + " Z-#21" + turn);
    text.assign(32, "#12");
    text.end_if();
    text.line(arc + turn);
  } else {
    write_rapid_in(circle, text, "[#18-#28]");
    text.line("G01 Z0 F#9");
    text.assign(33, "#19-#20*[#18-#28]", "RADIUS OF THE FIRST CIRCLE");
    text.begin_if("#33", "GT", "0.0005");
    text.line(arc + " I[-#33*COS[#2]] J[-#33*SIN[#2]]");
    text.end_if();
    text.assign(12, "90/#17*#23", "SEGMENTS");
    text.assign(31, "FUP[#12-0.000001]");
    text.assign(30, "0");
    text.begin_while("#30 LE #31");
    text.assign(33, "#30");
    text.if_then("#33 GT #12", 33, "#12");
    text.assign(32, "#2+" + sense + "360*#33/#23", "ANGLE");
    text.assign(10, "#17*#33/#23", "ANGLE ON THE ROUND");
    text.if_then("#10 GT 90", 10, "90");
    text.assign(14, "#18-#28-[#18+#4]*SIN[#10]");
    text.assign(15, "[#18+#4]*[COS[#10]-1]");
    text.line("G01 " + place_words(circle, "#32", "#14") + " Z#15 F#9");
    text.assign(30, "#30+1");
    text.end_while();
    text.line(arc + turn);
  }
  text.line("G01 " + place_words(circle, "#32", "#29") + " F#8");
  text.line("G01 Z#11");
}

// X' = X cos - Y sin, Y' = X sin + Y cos about Z, and round the other axes (design section 1.3).
void write_rotation(const Cycle& cycle, MacroText& text) {
  text.assign(10, "COS[#1]");
  text.assign(12, "SIN[#1]");
  bool is_first = true;
  for (const Eigen::Vector3d& p : cycle.points) {
    text.assign(24, macro_number(p.x()));
    text.assign(25, macro_number(p.y()));
    text.assign(26, macro_number(p.z()));
    const std::string motion = is_first ? "G90 G00 " : "G01 ";
    is_first = false;
    if (cycle.rotation_axis == 2) {
      text.line(motion + "X[#24*#10-#25*#12] Y[#24*#12+#25*#10] Z#26 F#9");
    } else if (cycle.rotation_axis == 0) {
      text.line(motion + "X#24 Y[#25*#10-#26*#12] Z[#25*#12+#26*#10] F#9");
    } else {
      text.line(motion + "X[#26*#12+#24*#10] Y#25 Z[#26*#10-#24*#12] F#9");
    }
  }
}

// Results: #101 sine, #102 cosine, #103 tangent (left alone where the cosine is 0).
void write_series(const Cycle&, MacroText& text) {
  text.assign(2, "#1-360*ROUND[#1/360]", "WITHIN A HALF TURN");
  text.assign(3, "1");
  text.begin_if("ABS[#2]", "GT", "90");
  text.assign(4, "180");
  text.if_then("#2 LT 0", 4, "-180");
  text.assign(2, "#4-#2");
  text.assign(3, "-1");
  text.end_if();
  text.assign(5, "#2*3.14159265359/180", "RADIANS");
  text.assign(6, "#5", "TERM OF THE SINE");
  text.assign(7, "1", "TERM OF THE COSINE");
  text.assign(101, "0");
  text.assign(102, "0");
  text.assign(30, "0");
  text.begin_while("#30 LT #20");
  text.assign(101, "#101+#6");
  text.assign(102, "#102+#7");
  text.assign(6, "-#6*#5*#5/[[2*#30+2]*[2*#30+3]]");
  text.assign(7, "-#7*#5*#5/[[2*#30+1]*[2*#30+2]]");
  text.assign(30, "#30+1");
  text.end_while();
  text.assign(102, "#102*#3");
  text.begin_if("ABS[#102]", "GT", "0.00000001");
  text.assign(103, "#101/#102");
  text.end_if();
}

}  // namespace ridgeline::macro
