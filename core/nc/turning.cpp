#include "core/nc/turning.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/nc/text.hpp"

namespace ridgeline::nc {
namespace {

constexpr double to_millimetre_grid = 1000;
constexpr double shortest_arc = 0.002;  // [mm]

/// At most `decimals`, always with a point, never -0.
std::string word(char letter, double value, int decimals = 4) {
  const double scale = std::pow(10.0, decimals);
  double rounded = std::round(value * scale) / scale;
  if (rounded == 0) rounded = 0;
  std::string digits =
      std::to_string(static_cast<long long>(std::llround(std::abs(rounded) * scale)));
  while (digits.size() <= static_cast<std::size_t>(decimals)) digits.insert(digits.begin(), '0');
  digits.insert(digits.size() - static_cast<std::size_t>(decimals), ".");
  while (digits.back() == '0') digits.pop_back();
  return std::string(1, letter) + (rounded < 0 ? "-" : "") + digits;
}

/// Comments hold no brackets of their own, nor anything that a control may not know.
std::string comment(const std::string& text) {
  std::string clean;
  for (const char c : text) {
    const bool is_plain = (c >= ' ' && c <= '~') && c != '(' && c != ')' && c != '%' && c != ';';
    clean += is_plain ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : ' ';
  }
  return "(" + clean.substr(0, 100) + ")";
}

class Writer {
public:
  Writer(const LatheProgram& program, LatheControl control)
      : program_(program), is_fanuc_(control == LatheControl::Fanuc) {}

  std::string run() {
    head();
    for (const LatheStep& step : program_.steps) write(step);
    line("M5");
    line("M9");
    line(is_fanuc_ ? "M30" : "M2");
    if (is_fanuc_) line("%");
    return std::move(out_);
  }

private:
  void line(const std::string& text) { out_ += text + "\n"; }

  void head() {
    if (is_fanuc_) {
      line("%");
      std::string number = std::to_string(program_.number);
      line("O" + std::string(4 - std::min<std::size_t>(4, number.size()), '0') + number + " " +
           comment(program_.title));
    } else {
      line(comment(program_.title));
    }
    for (const std::string& text : program_.comments) line(comment(text));
    line(is_fanuc_ ? "G21 G18 G40 G80 G99" : "G21 G18 G7 G40 G80 G90 G95 G54");
  }

  void write(const LatheStep& step) {
    line(comment(step.comment));
    at_x_ = at_z_ = at_y_ = std::nullopt;
    motion_ = feed_ = {};
    if (is_fanuc_) {
      std::string t = std::to_string(step.tool);
      if (t.size() < 2) t.insert(t.begin(), '0');
      line("T" + t + t);
    } else {
      line("T" + std::to_string(step.tool) + " M6 G43");
    }
    spindle(step);
    line("G0 " + word('X', 2 * program_.safe_x, 3) + " " + word('Z', program_.safe_z, 3));
    at_x_ = program_.safe_x;
    at_z_ = program_.safe_z;
    if (step.mode == LatheStep::Mode::Milling) at_y_ = 0;
    if (step.c) line("G0 " + word('C', *step.c, 3));
    if (step.plane) {
      write_in_plane(step, *step.plane);
    } else {
      for (const LatheMove& move : step.moves) write(step, move);
      write_holes(step);
    }
    line("G0 " + word('X', 2 * program_.safe_x, 3));
    if (at_y_.value_or(0) != 0) line("G0 Y0.");
    line("G0 " + word('Z', program_.safe_z, 3));
    if (step.mode == LatheStep::Mode::Milling) line(is_fanuc_ ? "M15" : "M5");
  }

  /// The head swivels where nothing stands: outside of X and Z. Rz(90) Rx(angle) Rz(-90) is a turn
  /// about Y; the origin lies at X 0, so that it does not matter whether X is a diameter.
  void write_in_plane(const LatheStep& step, const LathePlane& plane) {
    if (!is_fanuc_) {
      throw Error(ErrorCode::Unsupported, "LinuxCNC has no tilted work plane: " + step.comment);
    }
    if (!step.moves.empty()) line(comment("in this plane x is a radius"));
    line("G0 " + word('C', plane.c, 4));
    line("G68.2 X0. " + word('Y', plane.y) + " " + word('Z', plane.z) + " I90. " +
         word('J', plane.angle, 3) + " K-90.");
    line("G53.1");
    line("G0 " + word('Z', plane.level));
    at_x_ = at_y_ = std::nullopt;
    at_z_ = plane.level;
    motion_ = {};
    for (const LatheMove& move : step.moves) write(step, move);
    for (const LatheHole& hole : step.holes) {
      line("G0 X0. Y0.");
      line("G0 " + word('Z', hole.z + hole.clear));
      line("G83 " + word('Z', hole.end) + " R0. Q" +
           std::to_string(std::lround(hole.peck * to_millimetre_grid)) + " " +
           word('F', step.feed, 1) + " M88");
      line("G80 M89");
    }
    line("G0 " + word('Z', plane.level));
    line("G69.1");
    line("G0 B0.");
    at_y_ = 1;  // back to 0 with the rest
  }

  void spindle(const LatheStep& step) {
    if (step.mode == LatheStep::Mode::Milling) {
      line(is_fanuc_ ? "G98 G97 M13 S" + std::to_string(std::lround(step.speed))
                     : "G94 G97 S" + std::to_string(std::lround(step.speed)) + " M3");
    } else if (!step.is_constant_surface) {
      line(std::string(is_fanuc_ ? "G99" : "G95") + " G97 S" +
           std::to_string(std::lround(step.speed)) + " M3");
    } else if (is_fanuc_) {
      line("G50 S" + std::to_string(std::lround(program_.top_speed)));
      line("G99 G96 S" + std::to_string(std::lround(step.speed)) + " M3");
    } else {
      line("G95 G96 D" + std::to_string(std::lround(program_.top_speed)) + " S" +
           std::to_string(std::lround(step.speed)) + " M3");
    }
    line("M8");
  }

  void write(const LatheStep& step, const LatheMove& move) {
    const double scale = step.plane ? 1 : 2;  // X is a diameter
    std::string text;
    std::string code = "G1";
    if (move.kind == LatheMove::Kind::Rapid) code = "G0";
    const bool is_arc = move.kind == LatheMove::Kind::Arc && !is_short(move);
    if (is_arc) code = move.is_clockwise ? "G2" : "G3";
    if (is_arc || !is_at(at_x_, move.x)) text += " " + word('X', scale * move.x);
    if (move.y && !is_at(at_y_, *move.y)) text += " " + word('Y', *move.y);
    if (is_arc || !is_at(at_z_, move.z)) text += " " + word('Z', move.z);
    if (text.empty()) return;
    if (is_arc) text += " " + word('R', move.radius);
    if (move.kind != LatheMove::Kind::Rapid) {
      const std::string feed = word('F', move.feed, step.mode == LatheStep::Mode::Turning ? 4 : 1);
      if (feed != feed_) text += " " + feed;
      feed_ = feed;
    }
    const bool is_known = code == motion_ && !is_arc;
    motion_ = code;
    line(is_known ? text.substr(1) : code + text);
    at_x_ = move.x;
    at_z_ = move.z;
    if (move.y) at_y_ = move.y;
  }

  /// An arc between points that the control's increments may make one: with R it is none.
  bool is_short(const LatheMove& move) const {
    return at_x_ && at_z_ && std::hypot(move.x - *at_x_, move.z - *at_z_) < shortest_arc;
  }

  /// Would the words print alike?
  static bool is_at(const std::optional<double>& at, double value) {
    return at && word('X', 2 * *at) == word('X', 2 * value) && word('Z', *at) == word('Z', value);
  }

  void write_holes(const LatheStep& step) {
    if (step.holes.empty()) return;
    const std::string feed = word('F', step.feed, step.mode == LatheStep::Mode::Turning ? 4 : 1);
    for (const LatheHole& hole : step.holes) {
      if (step.mode == LatheStep::Mode::Milling) line("G0 " + word('C', hole.c, 4));
      if (is_fanuc_) {
        fanuc_cycle(step, hole, feed);
      } else if (hole.is_radial) {
        plain_pecks(hole, feed);
      } else {
        linuxcnc_cycle(step, hole, feed);
      }
    }
  }

  /// Series 0i/30i lathe, system A: Z (X) absolute end, R from the initial level to the retract
  /// level, Q the peck in micrometres.
  void fanuc_cycle(const LatheStep& step, const LatheHole& hole, const std::string& feed) {
    const std::string q =
        " Q" + std::to_string(std::lround(hole.peck * to_millimetre_grid)) + " " + feed;
    const bool is_milled = step.mode == LatheStep::Mode::Milling;
    if (hole.is_radial) {
      const double start = hole.x + hole.clear;
      line("G0 " + word('Z', hole.z) + (hole.y != 0 ? " " + word('Y', hole.y) : ""));
      line("G0 " + word('X', 2 * start));
      line("G87 " + word('X', 2 * hole.end) + " R0." + q + " M88");
      line("G80 M89");
      line("G0 " + word('X', 2 * program_.safe_x, 3));
      at_y_ = hole.y;
    } else {
      line("G0 " + word('X', 2 * hole.x));
      line("G0 " + word('Z', hole.z + hole.clear));
      line("G83 " + word('Z', hole.end) + " R0." + q + (is_milled ? " M88" : ""));
      line(is_milled ? "G80 M89" : "G80");
      line("G0 " + word('Z', program_.safe_z, 3));
    }
  }

  void linuxcnc_cycle(const LatheStep& step, const LatheHole& hole, const std::string& feed) {
    line("G17");
    line("G0 " + word('X', 2 * hole.x) + (step.mode == LatheStep::Mode::Milling ? " Y0." : ""));
    line("G98 G83 " + word('Z', hole.end) + " " + word('R', hole.z + hole.clear) + " " +
         word('Q', hole.peck) + " " + feed);
    line("G80");
    line("G18");
  }

  /// LinuxCNC's cycles along X do not know diameters.
  void plain_pecks(const LatheHole& hole, const std::string& feed) {
    const double start = hole.x + hole.clear;
    line("G0 " + word('Z', hole.z) + " " + word('Y', hole.y));
    line("G0 " + word('X', 2 * start));
    at_y_ = hole.y;
    double last = start;
    for (double at = hole.x - hole.peck;; at -= hole.peck) {
      const double to = std::max(at, hole.end);
      if (last < start) line("G0 " + word('X', 2 * (last + 0.2)));
      line("G1 " + word('X', 2 * to) + " " + feed);
      line("G0 " + word('X', 2 * start));
      last = to;
      if (to <= hole.end) break;
    }
    line("G0 " + word('X', 2 * program_.safe_x, 3));
  }

  const LatheProgram& program_;
  bool is_fanuc_;
  std::string out_;
  std::string motion_, feed_;
  std::optional<double> at_x_, at_z_, at_y_;
};

}  // namespace

std::string lathe_text(const LatheProgram& program, LatheControl control) {
  if (program.number < 1 || program.number > 9999) {
    throw Error(
        ErrorCode::BadInput,
        "the program number is " + std::to_string(program.number) + "; 1 to 9999 is allowed",
        {.field = "/output/program",
         .value = std::to_string(program.number),
         .limit = "1 to 9999"});
  }
  return Writer(program, control).run();
}

}  // namespace ridgeline::nc
