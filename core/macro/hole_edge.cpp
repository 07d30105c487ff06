#include "core/macro/hole_edge.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/angle.hpp"
#include "core/base/error.hpp"
#include "core/macro/refuse.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

namespace {

using Eigen::Vector3d;

constexpr int most_iterations = 30;
constexpr double converged = 1e-13;  // of R1
constexpr int most_points = 100000;
constexpr int samples = 720;  // of the curve, for its curvature

void validate(const HoleEdge& edge) {
  if (!(edge.R2 > 0)) refuse("R2", edge.R2, "greater than 0 mm");
  if (!(edge.R2 + std::abs(edge.f) < edge.R1)) {
    refuse("R2", edge.R2,
           "less than R1 - |f| = " + number_text(edge.R1 - std::abs(edge.f)) + " mm");
  }
  if (!(edge.ball_radius > 0)) refuse("ball_radius", edge.ball_radius, "greater than 0 mm");
  if (!(edge.width > 0 && edge.width < 2 * edge.ball_radius)) {
    refuse("width", edge.width,
           "greater than 0 and less than 2 D = " + number_text(2 * edge.ball_radius) + " mm");
  }
  if (!edge.is_outer && !(edge.ball_radius < edge.R2)) {
    refuse("ball_radius", edge.ball_radius,
           "less than R2 = " + number_text(edge.R2) + " mm, so that the ball goes in");
  }
  if (!(edge.points >= 3 && edge.points <= most_points)) {
    refuse("points", edge.points, "3 to 100000");
  }
  if (edge.section_angle && !(*edge.section_angle > 0 && *edge.section_angle <= 90)) {
    refuse("section_angle", *edge.section_angle, "greater than 0 and at most 90 degrees");
  }
}

}  // namespace

// Design section 5, with p = phi. e2 points along the wall to +z; the material of the inner edge
// lies there, that of the outer edge at -e2: m = 1 and m = -1.
//   A = R2 cos p + f, Zp = sqrt(R1^2 - A^2), den = sqrt(R1^2 - A^2 cos^2 p)
//   e2 = (A sin^2 p, -A sin p cos p, Zp)/den, k = (A sin p/den)^2
//   psi = atan2(B, -m A cos p), B = A e2x + Zp e2z; delta = 90 - psi/2
//   S2 = sqrt(R2^2 - k t^2) - R2, S1 = S2 + W sin delta, T1 = t - m W cos delta
//   F(t) = (A + S1 cos p + T1 e2x)^2 + (Zp + T1 e2z)^2 - R1^2 = 0
Vector3d hole_edge_centre(const HoleEdge& edge, double phi) {
  const double R1 = edge.R1, R2 = edge.R2, W = edge.width;
  const double m = edge.is_outer ? -1 : 1;
  const double c = std::cos(radians(phi)), s = std::sin(radians(phi));
  const double A = R2 * c + edge.f;
  const double Zp = std::sqrt(R1 * R1 - A * A);
  const double den = std::sqrt(R1 * R1 - A * A * c * c);
  const Vector3d e2(A * s * s / den, -A * s * c / den, Zp / den);
  const double k = A * s / den * (A * s / den);
  const double B = A * e2.x() + Zp * e2.z();
  const double delta =
      radians(edge.section_angle.value_or(90 - degrees(std::atan2(B, -m * A * c)) / 2));
  const double ws = W * std::sin(delta), wc = m * W * std::cos(delta);

  double t = wc - ws * A * c / B;  // tangent plane
  double S2 = 0;
  for (int i = 0;; ++i) {
    const double square = R2 * R2 - k * t * t;
    if (!(square >= 0) || i > most_iterations) {
      throw Error(ErrorCode::WidthTooLarge,
                  "the chamfer leaves its surfaces at phi = " + number_text(phi) + " degrees");
    }
    S2 = -k * t * t / (R2 + std::sqrt(square));  // regular form of sqrt(R2^2 - k t^2) - R2
    const double u = A + (S2 + ws) * c + (t - wc) * e2.x();
    const double v = Zp + (t - wc) * e2.z();
    const double F = u * u + v * v - R1 * R1;
    const double slope = 2 * (u * (e2.x() - k * t * c / (R2 + S2)) + v * e2.z());
    const double step = F / slope;
    t -= step;
    if (std::abs(step) <= converged * R1) break;
  }
  const double h = std::sqrt(edge.ball_radius * edge.ball_radius - W * W / 4);
  const double Sc = S2 + ws / 2 - h * std::cos(delta);
  const double Tc = t - wc / 2 - m * h * std::sin(delta);
  Vector3d C((R2 + Sc) * c + Tc * e2.x(), (R2 + Sc) * s + Tc * e2.y(), Zp + Tc * e2.z());
  if (edge.is_exit) C.z() = -C.z();
  return C;
}

int hole_edge_points(const HoleEdge& edge, double tolerance) {
  if (!(tolerance > 0)) refuse("tolerance", tolerance, "greater than 0 mm");
  // The chord of a step dphi leaves |C''| dphi^2/8 where C'' is taken across C'.
  double most = 0;
  const double dphi = 360.0 / samples;
  for (int i = 0; i < samples; ++i) {
    const Vector3d before = hole_edge_centre(edge, (i - 1) * dphi);
    const Vector3d at = hole_edge_centre(edge, i * dphi);
    const Vector3d after = hole_edge_centre(edge, (i + 1) * dphi);
    const Vector3d along = (after - before).normalized();
    const Vector3d second = after - 2 * at + before;
    most = std::max(most, (second - second.dot(along) * along).norm() / (dphi * dphi));
  }
  constexpr double margin = 1.02;  // of the curvature between samples
  const double step = std::sqrt(8 * tolerance / (margin * most));
  const double count = std::ceil(360 / step);
  if (!(count <= most_points)) {
    throw Error(ErrorCode::ToleranceTooSmall, "the tolerance " + number_text(tolerance) +
                                                  " mm needs more than " +
                                                  std::to_string(most_points) + " points");
  }
  return std::max(8, static_cast<int>(count));
}

namespace {

struct HoleArgument {
  char letter;
  int variable;
  double value;
  const char* meaning;
};

std::vector<HoleArgument> arguments_of(const HoleEdge& edge) {
  return {{'A', 1, edge.R1, edge.is_outer ? "R1 OUTSIDE RADIUS" : "R1 BORE RADIUS"},
          {'B', 2, edge.R2, "R2 HOLE RADIUS"},
          {'C', 3, edge.f, "F ECCENTRIC DISTANCE, BORE AXIS AT X -F"},
          {'W', 23, edge.width, "W CHAMFER WIDTH"},
          {'D', 7, static_cast<double>(edge.offset_number), "OFFSET NUMBER OF THE BALL RADIUS"},
          {'H', 11, static_cast<double>(edge.points), "POINTS ONCE ROUND"},
          {'S', 19, edge.start_angle, "START ANGLE"},
          {'M', 13, edge.is_clockwise ? -1.0 : 1.0, "1 COUNTER-CLOCKWISE, -1 CLOCKWISE"},
          {'X', 24, edge.position.x(), "HOLE X"},
          {'Y', 25, edge.position.y(), "HOLE Y"},
          {'Z', 26, edge.position.z(), "BORE AXIS Z"},
          {'R', 18, edge.rotation, "ANGLE OF THE BORE AXIS AGAINST Y"},
          {'V', 22, edge.z_clear, "CLEARANCE HEIGHT ABOVE THE BORE AXIS"},
          {'F', 9, edge.feed, "FEED"},
          {'E', 8, edge.approach_feed, "APPROACH FEED"}};
}

void write_head(const HoleEdge& edge, const HoleEdgeProgram& options, MacroText& text) {
  text.line("%");
  const std::string title = std::string("CHAMFER OF A HOLE EDGE, ") +
                            (edge.is_outer ? "OUTER" : "INNER") +
                            (edge.is_exit ? ", EXIT" : ", ENTRY");
  if (text.is_fanuc()) {
    text.line(numbered("O", options.number) + "(" + title + ")");
  } else {
    text.comment(title);
  }
  const bool is_macro = options.kind == HoleEdgeProgram::Kind::Macro;
  std::string call = numbered("CALL: G65 P", options.number);
  for (const HoleArgument& argument : arguments_of(edge)) {
    if (!is_macro) {
      text.assign(argument.variable, macro_number(argument.value), argument.meaning);
      continue;
    }
    text.comment(std::string(1, argument.letter) + numbered(" #", argument.variable) + " " +
                 argument.meaning);
    call += std::string(" ") + argument.letter + macro_number(argument.value);
  }
  if (is_macro) text.comment(call);
  if (!is_macro) {
    text.line(text.is_fanuc() ? "G90 G17 G40 G80" : "G90 G17 G21 G40 G80");
    if (!options.work_offset.empty()) text.line(options.work_offset);
  }
}

// #4 radius D of the ball, #5 h = sqrt(D^2 - W^2/4).
void write_checks(const HoleEdge& edge, MacroText& text) {
  if (text.is_fanuc()) {
    text.if_then("#8 EQ #0", 8, "#9");
    text.if_then("#13 EQ #0", 13, "1");
    text.assign(4, "#[13000+#7]+#[12000+#7]", "BALL RADIUS");
  } else {
    text.assign(4, macro_number(edge.ball_radius), "BALL RADIUS");
  }
  text.alarm_if("[#2+ABS[#3]] GE #1", 10, "HOLE WIDER THAN THE CYLINDER");
  text.alarm_if("#4 LE 0", 11, "NO BALL RADIUS IN THE OFFSET REGISTER");
  text.alarm_if("#23 LE 0", 12, "CHAMFER WIDTH");
  text.alarm_if("#23 GE [2*#4]", 12, "CHAMFER WIDTH BEYOND THE BALL");
  if (!edge.is_outer) text.alarm_if("#4 GE #2", 13, "BALL DOES NOT ENTER THE HOLE");
  text.alarm_if("#11 LT 3", 14, "AT LEAST 3 POINTS");
  text.alarm_if("#9 LE 0", 15, "FEED");
  text.alarm_if("ABS[#13] NE 1", 16, "DIRECTION 1 OR -1");
  text.assign(5, "SQRT[#4*#4-#23*#23/4]");
}

// The solution of hole_edge_centre() at point #10: #32, #33, #31 are the ball centre.
void write_point(const HoleEdge& edge, MacroText& text) {
  const std::string m = edge.is_outer ? "" : "-";  // -m
  const std::string minus_m = edge.is_outer ? "+" : "-";
  const std::string plus_m = edge.is_outer ? "-" : "";
  text.assign(6, "#19+#13*#10*360/#11", "PHI");
  text.assign(14, "COS[#6]");
  text.assign(15, "SIN[#6]");
  text.assign(16, "#2*#14+#3", "A");
  text.assign(17, "SQRT[#1*#1-#16*#16]", "ZP");
  text.assign(12, "SQRT[#1*#1-#16*#16*#14*#14]");
  text.assign(20, "#16*#15*#15/#12", "E2");
  text.assign(21, "-#16*#15*#14/#12");
  text.assign(27, "#17/#12");
  text.assign(28, "#16*#15/#12");
  text.assign(28, "#28*#28", "K");
  text.assign(12, "#16*#20+#17*#27");
  if (edge.section_angle) {
    text.assign(6, macro_number(*edge.section_angle), "DELTA");
  } else {
    text.assign(6, "90-ATAN[#12]/[" + m + "#16*#14]/2", "DELTA");
  }
  text.assign(29, "#23*SIN[#6]", "W SIN");
  text.assign(30, plus_m + "#23*COS[#6]", "W COS");
  text.assign(31, "#30-#29*#16*#14/#12", "T2");
  text.assign(32, "1", "STEP");
  text.assign(33, "0", "ITERATIONS");
  text.begin_while("ABS[#32] GT 0.00001");
  text.assign(6, "SQRT[#2*#2-#31*#31*#28]", "R2+S2");
  text.assign(12, "#16+[#6-#2+#29]*#14+[#31-#30]*#20");
  text.assign(32, "#17+[#31-#30]*#27");
  text.assign(32, "[#12*#12+#32*#32-#1*#1]/[2*[#12*[#20-#31*#28/#6*#14]+#32*#27]]");
  text.assign(31, "#31-#32");
  text.assign(33, "#33+1");
  text.alarm_if("#33 GT 8", 17, "NO SOLUTION, WIDTH TOO LARGE");
  text.end_while();
  text.assign(6, "SQRT[#2*#2-#31*#31*#28]+#29/2-#5*ABS[#30]/#23", "R2+SC");
  text.assign(12, "#31-#30/2" + minus_m + "#5*#29/#23", "TC");
  text.assign(32, "#6*#14+#12*#20", "X");
  text.assign(33, "#6*#15+#12*#21", "Y");
  text.assign(31, edge.is_exit ? "-#17-#12*#27" : "#17+#12*#27", "Z");
}

const char* const turned_place =
    "X[#24+#32*COS[#18]-#33*SIN[#18]] Y[#25+#32*SIN[#18]+#33*COS[#18]]";

}  // namespace

std::string hole_edge_program(const HoleEdge& edge, const HoleEdgeProgram& options) {
  validate(edge);
  const bool is_macro = options.kind == HoleEdgeProgram::Kind::Macro;
  if (is_macro && options.dialect == ProgramDialect::LinuxCnc) {
    throw Error(ErrorCode::Unsupported, "the LinuxCNC twin is a main program");
  }
  for (int i = 0; i < edge.points; ++i) hole_edge_centre(edge, 360.0 * i / edge.points);
  MacroText text(options.dialect);
  write_head(edge, options, text);
  write_checks(edge, text);
  if (!edge.is_outer) {  // in along the hole's axis
    text.line("G90 G00 X#24 Y#25");
    text.line("G00 Z[#26+#22]");
  }
  text.assign(10, "0", "POINT");
  text.begin_while("#10 LE #11");
  write_point(edge, text);
  text.begin_if("#10", "EQ", "0");
  if (edge.is_outer) {
    text.line(std::string("G90 G00 ") + turned_place);
    text.line("G00 Z[#26+#22]");
  }
  text.line("G01 Z[#26+#31-#4] F#8");
  text.end_if();
  text.line(std::string("G01 ") + turned_place + " Z[#26+#31-#4] F#9");
  text.assign(10, "#10+1");
  text.end_while();
  if (!edge.is_outer) text.line("G01 X#24 Y#25 F#8");
  text.line("G01 Z[#26+#22] F#8");
  text.line(!text.is_fanuc() ? "M2" : is_macro ? "M99" : "M30");
  text.line("%");
  return text.text();
}

}  // namespace ridgeline::macro
