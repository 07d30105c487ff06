#include <optional>
#include <string>

#include "core/nc/text.hpp"
#include "core/nc/tilted_plane.hpp"
#include "core/nc/validate.hpp"
#include "core/nc/writers.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::nc {
namespace {

constexpr std::string_view axis_letters = "XYZ";
constexpr std::string_view centre_letters = "IJK";
constexpr int feed_decimals = 3;

std::string plane_word(int third) {
  return third == 2 ? "G17" : third == 1 ? "G18" : "G19";
}

/// Words of one block, a blank between them.
class Words {
public:
  Words& add(std::string_view word) {
    if (!text_.empty()) text_ += ' ';
    text_ += word;
    return *this;
  }
  bool is_empty() const { return text_.empty(); }
  const std::string& text() const { return text_; }

private:
  std::string text_;
};

class GCodeWriter {
public:
  GCodeWriter(const Program& program, const Plan& plan)
      : program_(program),
        plan_(plan),
        dialect_(program.dialect),
        style_(dialect_ == Dialect::Fanuc ? NumberStyle::Point : NumberStyle::Plain),
        axis_(static_cast<std::size_t>(length_axis(program))),
        plane_(plane_word(length_axis(program))),
        blocks_("N", program.block_number_step, program.block_number_step.value_or(0)) {}

  std::string run(const Progress& progress) {
    if (is_inline()) {
      for (const std::string& line : head_comments(program_)) comment(line);
      blocks_.block(plane_ + (dialect_ == Dialect::Fanuc ? " G21 G90 G94" : " G21 G90 G91.1 G94"));
    } else {
      head();
      prepare();
    }
    approach();
    if (program_.positioning == Positioning::Incremental) blocks_.block("G91");
    for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
      progress.step(i, plan_.steps.size(), "program");
      motion(plan_.steps[i]);
    }
    if (program_.positioning == Positioning::Incremental) blocks_.block("G90");
    if (!is_inline()) end();
    return blocks_.take();
  }

private:
  bool is_inline() const { return program_.kind == ProgramKind::Inline; }
  bool is_main() const { return program_.kind == ProgramKind::Main; }
  int offset() const {
    if (is_inline()) return 0;
    return program_.length_offset != 0 ? program_.length_offset : program_.tool_number;
  }
  std::string number(std::int64_t value, int decimals) const {
    return decimal(value, decimals, style_);
  }

  void comment(const std::string& text) {
    blocks_.line(dialect_ == Dialect::Siemens ? "; " + text : "(" + text + ")");
  }

  void head() {
    const std::string number = std::to_string(program_.number);
    switch (dialect_) {
      case Dialect::Siemens: {
        // Names begin with two letters; L and a number is a subprogram.
        const std::string suffix = is_main() ? "MPF" : "SPF";
        blocks_.line("%_N_" + (is_main() ? "RL" + number : "L" + number) + "_" + suffix);
        blocks_.line(";$PATH=/_N_" + suffix + "_DIR");
        break;
      }
      case Dialect::LinuxCnc:
        if (is_main()) {
          blocks_.line("%");
          comment("program " + number);
        } else {
          blocks_.line("o<" + number + "> sub");
        }
        break;
      default:
        blocks_.line("%");
        blocks_.line("O" + (number.size() < 4 ? std::string(4 - number.size(), '0') : "") + number);
    }
    for (const std::string& line : head_comments(program_)) comment(line);
  }

  /// Known modes whatever ran before, work offset, tool, tilted plane, spindle.
  void prepare() {
    switch (dialect_) {
      case Dialect::Siemens: blocks_.block(plane_ + " G40 G90 G94 G710"); break;
      case Dialect::LinuxCnc:
        // G61: without it the control may round corners as it likes.
        blocks_.block(plane_ + " G21 G40 G49 G61 G80 G90 G91.1 G94 G97");
        break;
      default:
        if (in_work_plane(program_)) blocks_.block("G69");
        blocks_.block(plane_ + " G21 G40 G49 G80 G90 G94");
    }
    if (!program_.work_offset.empty()) blocks_.block(work_offset(program_).words);
    tool_call();
    if (in_work_plane(program_)) tilt();
    if (follows_tool(program_) && dialect_ == Dialect::Siemens) blocks_.block("TRAORI");
    if (program_.spindle_speed > 0) {
      const auto speed = static_cast<std::int64_t>(std::llround(program_.spindle_speed));
      blocks_.block("S" + std::to_string(speed) + (program_.spindle_clockwise ? " M3" : " M4"));
    }
  }

  void tool_call() {
    if (program_.tool_number == 0) return;
    const std::string tool = "T" + std::to_string(program_.tool_number);
    if (dialect_ != Dialect::Siemens) {
      blocks_.block(tool + " M6");
      return;
    }
    blocks_.block(tool);
    blocks_.block("M6");
    // The length stays on the tool's axis when an arc changes the plane (SD42940).
    if (leaves_plane()) blocks_.block(length_constant(17 + 2 - static_cast<int>(axis_)));
    blocks_.block("D1");
  }

  static std::string length_constant(int plane) {
    return "$SC_TOOL_LENGTH_CONST=" + std::to_string(plane);
  }

  bool leaves_plane() const {
    for (const Step& step : plan_.steps) {
      if (step.arc && path::axes_of(step.arc->plane).third != static_cast<int>(axis_)) return true;
    }
    return false;
  }

  void tilt() {
    const auto angles_text = [&](const std::array<std::int64_t, 3>& angles, int decimals) {
      return std::array{number(angles[0], decimals), number(angles[1], decimals),
                        number(angles[2], decimals)};
    };
    const Eigen::Vector3d axis = program_.tool_axis.normalized();
    if (dialect_ == Dialect::Siemens) {
      // Retract Z; the one swivel data set; new; mode 57: A about X, B about Y, C about Z; no
      // shift.
      const auto [a, b, c] = angles_text(swivel_angles(axis), swivel_decimals);
      blocks_.block("CYCLE800(1,\"\",0,57,0,0,0," + a + "," + b + "," + c + ",0,0,0,-1,0,1)");
      return;
    }
    const auto [i, j, k] = angles_text(euler_angles(path::tilted_axes(axis)), euler_decimals);
    blocks_.block("G91 G28 Z0.");  // clear of the part before the rotary axes turn
    blocks_.block("G90");
    blocks_.block("G68.2 X0. Y0. Z0. I" + i + " J" + j + " K" + k);
    blocks_.block("G53.1");
  }

  /// To the start: across at the height where the tool is, then along the tool with its length.
  void approach() {
    // LinuxCNC offsets all axes at once and does not move: before any coordinate is said.
    if (dialect_ == Dialect::LinuxCnc && offset() != 0) {
      blocks_.block("G43 H" + std::to_string(offset()));
    }
    const std::string length = " H" + std::to_string(offset());
    const bool with_length = dialect_ == Dialect::Fanuc && offset() != 0;
    if (with_length && follows_tool(program_)) {
      // The control needs the whole point to follow the tool from the first block on.
      std::string point = "G0 G43.4";
      for (std::size_t n = 0; n < 3; ++n) point += ' ' + axis_word(n, plan_.start[n]);
      blocks_.block(point + length);
    } else {
      std::string across = "G0";
      for (std::size_t n = 0; n < 3; ++n) {
        if (n != axis_) across += ' ' + axis_word(n, plan_.start[n]);
      }
      blocks_.block(across);
      const bool from_below = !is_tilted(program_) && program_.tool_axis.minCoeff() < -0.5;
      const std::string along = axis_word(axis_, plan_.start[axis_]);
      blocks_.block(with_length ? (from_below ? "G44 " : "G43 ") + along + length : along);
    }
    if (!is_inline() && program_.coolant == Coolant::Flood) blocks_.block("M8");
    if (!is_inline() && program_.coolant == Coolant::Mist) blocks_.block("M7");
    at_ = plan_.start;
    motion_ = "G0";
  }

  std::string axis_word(std::size_t axis, std::int64_t value) const {
    return axis_letters[axis] + number(value, program_.decimals);
  }

  void motion(const Step& step) {
    Words words;
    std::string code = step.rapid ? "G0" : "G1";
    if (step.arc) {
      code = step.arc->sense == path::ArcSense::Clockwise ? "G2" : "G3";
      const std::string plane = plane_word(path::axes_of(step.arc->plane).third);
      if (plane != plane_) words.add(plane_ = plane);
    }
    if (step.arc || code != motion_) words.add(motion_ = code);
    for (std::size_t n = 0; n < 3; ++n) {
      const bool in_arc_plane =
          step.arc && static_cast<int>(n) != path::axes_of(step.arc->plane).third;
      if (step.to[n] == at_[n] && !in_arc_plane) continue;
      const bool incremental = program_.positioning == Positioning::Incremental;
      words.add(axis_word(n, incremental ? step.to[n] - at_[n] : step.to[n]));
    }
    if (step.arc) {
      for (std::size_t n = 0; n < 3; ++n) {
        if (static_cast<int>(n) == path::axes_of(step.arc->plane).third) continue;
        const std::int64_t offset_to_centre = step.arc->centre[n] - at_[n] * finer_;
        words.add(centre_letters[n] + number(offset_to_centre, centre_decimals(program_)));
      }
    }
    if (!step.rapid && step.feed != feed_) {
      words.add("F" + number(step.feed, feed_decimals));
      feed_ = step.feed;
    }
    at_ = step.to;
    blocks_.block(words.text());
  }

  void end() {
    if (program_.coolant != Coolant::None) blocks_.block("M9");
    if (program_.spindle_speed > 0) blocks_.block("M5");
    const bool tilted_fanuc = is_tilted(program_) && dialect_ == Dialect::Fanuc;
    if (tilted_fanuc && offset() != 0) blocks_.block("G49");
    if (in_work_plane(program_)) blocks_.block(dialect_ == Dialect::Siemens ? "CYCLE800()" : "G69");
    if (dialect_ == Dialect::Siemens) {
      if (follows_tool(program_)) blocks_.block("TRAFOOF");
      if (program_.tool_number != 0 && leaves_plane()) blocks_.block(length_constant(0));
      if (plane_ != plane_word(length_axis(program_))) blocks_.block("G17");
      blocks_.block(is_main() ? "M30" : "RET");
    } else if (dialect_ == Dialect::LinuxCnc) {
      if (is_main()) {
        blocks_.block("M2");
        blocks_.line("%");
      } else {
        blocks_.line("o<" + std::to_string(program_.number) + "> endsub");
        blocks_.line("M2");
      }
    } else {
      blocks_.block(is_main() ? "M30" : "M99");
      blocks_.line("%");
    }
  }

  const Program& program_;
  const Plan& plan_;
  Dialect dialect_;
  NumberStyle style_;
  std::int64_t finer_ = power_of_ten(centre_decimals(program_) - program_.decimals);
  std::size_t axis_;   ///< the tool's
  std::string plane_;  ///< active
  Blocks blocks_;
  std::string motion_;
  std::int64_t feed_ = -1;
  Grid at_{};
};

}  // namespace

std::string write_g_code(const Program& program, const Plan& plan, const Progress& progress) {
  return GCodeWriter(program, plan).run(progress);
}

}  // namespace ridgeline::nc
