#include <cmath>
#include <string>

#include "core/nc/text.hpp"
#include "core/nc/tilted_plane.hpp"
#include "core/nc/validate.hpp"
#include "core/nc/writers.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::nc {
namespace {

constexpr std::string_view axis_letters = "XYZ";
constexpr int feed_decimals = 3;
constexpr int turn_decimals = 4;

/// HEIDENHAIN Klartext. Every line is a numbered block; a cycle goes over two lines joined by ~.
class KlartextWriter {
public:
  KlartextWriter(const Program& program, const Plan& plan)
      : program_(program),
        plan_(plan),
        axis_(static_cast<std::size_t>(length_axis(program))),
        blocks_("", 0, 1) {}

  std::string run(const Progress& progress) {
    const std::string name = std::to_string(program_.number);
    blocks_.block("BEGIN PGM " + name + " MM");
    for (const std::string& line : head_comments(program_)) blocks_.block("; " + line);
    prepare();
    approach();
    for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
      progress.step(i, plan_.steps.size(), "program");
      motion(plan_.steps[i]);
    }
    end();
    blocks_.block("END PGM " + name + " MM");
    return blocks_.take();
  }

private:
  void prepare() {
    if (!program_.work_offset.empty()) {
      blocks_.block("CYCL DEF 247 DATUM SETTING ~");
      blocks_.line("    Q339=+" + work_offset(program_).words + " ;DATUM NUMBER");
    }
    if (program_.tool_number != 0 || program_.spindle_speed > 0) {
      // Without a number the call sets the speed of the tool in the spindle.
      std::string call = "TOOL CALL ";
      if (program_.tool_number != 0) call += std::to_string(program_.tool_number) + ' ';
      call += axis_letters[axis_];
      if (program_.spindle_speed > 0) {
        call += " S" + std::to_string(std::llround(program_.spindle_speed));
      }
      blocks_.block(call);
    }
    if (in_work_plane(program_)) tilt();
    if (follows_tool(program_)) blocks_.block("M128");
    if (program_.spindle_speed > 0) blocks_.block(program_.spindle_clockwise ? "M3" : "M4");
  }

  void tilt() {
    const PlaneVectors vectors = plane_vectors(path::tilted_axes(program_.tool_axis.normalized()));
    std::string plane = "PLANE VECTOR";
    const auto add = [&](char letter, const std::array<std::int64_t, 3>& vector) {
      for (std::size_t n = 0; n < 3; ++n) {
        plane += std::string(" ") + letter + axis_letters[n] +
                 decimal(vector[n], vector_decimals, NumberStyle::Signed);
      }
    };
    add('B', vectors.base);
    add('N', vectors.normal);
    blocks_.block("L Z+0 R0 FMAX M91");  // clear of the part before the rotary axes turn
    blocks_.block(plane + " TURN FMAX");
  }

  void approach() {
    std::string across = "L";
    for (std::size_t n = 0; n < 3; ++n) {
      if (n != axis_) across += absolute(n, plan_.start[n]);
    }
    blocks_.block(across + " R0 FMAX");
    blocks_.block("L" + absolute(axis_, plan_.start[axis_]) + " FMAX");
    if (program_.coolant == Coolant::Flood) blocks_.block("M8");
    if (program_.coolant == Coolant::Mist) blocks_.block("M7");
    at_ = plan_.start;
  }

  std::string number(std::int64_t value) const {
    return decimal(value, program_.decimals, NumberStyle::Signed);
  }
  std::string absolute(std::size_t axis, std::int64_t value) const {
    return std::string(" ") + axis_letters[axis] + number(value);
  }
  /// The coordinate as the positioning says, but absolute where the control is off the grid.
  std::string coordinate(std::size_t axis, std::int64_t value) const {
    const bool incremental = program_.positioning == Positioning::Incremental;
    if (!incremental || off_grid_[axis]) return absolute(axis, value);
    return std::string(" I") + axis_letters[axis] + number(value - at_[axis]);
  }

  void motion(const Step& step) {
    std::string text;
    if (step.arc) {
      centre(*step.arc);
      text = arc(step);
    } else {
      text = "L";
      for (std::size_t n = 0; n < 3; ++n) {
        if (step.to[n] != at_[n] || off_grid_[n]) text += coordinate(n, step.to[n]);
      }
      off_grid_ = {};
    }
    if (step.rapid) {
      text += " FMAX";
    } else if (step.feed != feed_) {
      text += " F" + decimal(step.feed, feed_decimals, NumberStyle::Plain);
      feed_ = step.feed;
    }
    at_ = step.to;
    blocks_.block(text);
  }

  /// The centre, incremental from where the tool is.
  void centre(const ArcStep& arc) {
    const int decimals = centre_decimals(program_);
    const std::int64_t finer = power_of_ten(decimals - program_.decimals);
    std::string text = "CC";
    for (std::size_t n = 0; n < 3; ++n) {
      if (static_cast<int>(n) == path::axes_of(arc.plane).third) continue;
      const bool incremental = program_.positioning == Positioning::Incremental && !off_grid_[n];
      const std::int64_t value = incremental ? arc.centre[n] - at_[n] * finer : arc.centre[n];
      text += incremental ? " I" : " ";
      text += axis_letters[n] + decimal(value, decimals, NumberStyle::Signed);
    }
    blocks_.block(text);
  }

  std::string arc(const Step& step) {
    const auto third = static_cast<std::size_t>(path::axes_of(step.arc->plane).third);
    const std::string sense = step.arc->sense == path::ArcSense::Clockwise ? " DR-" : " DR+";
    if (step.arc->polar) {
      std::string text = "CP IPA" + decimal(*step.arc->polar, turn_decimals, NumberStyle::Signed);
      if (step.to[third] != at_[third]) text += coordinate(third, step.to[third]);
      text += sense;
      off_grid_ = {true, true, true};
      off_grid_[third] = false;
      return text;
    }
    std::string text = "C";
    for (std::size_t n = 0; n < 3; ++n) {
      if (n == third) continue;
      text += coordinate(n, step.to[n]);
      off_grid_[n] = false;
    }
    return text + sense;
  }

  void end() {
    if (program_.coolant != Coolant::None) blocks_.block("M9");
    if (program_.spindle_speed > 0) blocks_.block("M5");
    if (follows_tool(program_)) blocks_.block("M129");
    if (in_work_plane(program_)) blocks_.block("PLANE RESET STAY");
    // A called program ends with its last block.
    if (program_.kind == ProgramKind::Main) blocks_.block("M30");
  }

  const Program& program_;
  const Plan& plan_;
  std::size_t axis_;  ///< the tool's
  Blocks blocks_;
  std::int64_t feed_ = -1;
  Grid at_{};
  /// Ends of a polar helix fall between the units; the next coordinate is then absolute.
  std::array<bool, 3> off_grid_{};
};

}  // namespace

std::string write_klartext(const Program& program, const Plan& plan, const Progress& progress) {
  return KlartextWriter(program, plan).run(progress);
}

}  // namespace ridgeline::nc
