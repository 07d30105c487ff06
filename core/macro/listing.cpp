#include "core/macro/listing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/macro/text.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::macro {

namespace {

using Eigen::Vector3d;

constexpr std::array<const char*, 4> kind_names = {"rapid", "line", "arc", "dwell"};
constexpr std::array<const char*, 3> plane_names = {"XY", "ZX", "YZ"};
constexpr std::array<const char*, 3> plane_codes = {"G17", "G18", "G19"};

// A number with a decimal point, so that every control reads it as mm.
std::string coordinate(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  std::string text = number_text(std::round(value * scale) / scale);
  if (text.find('.') == std::string::npos) text += '.';
  return text;
}

std::string feed_text(double feed) {
  std::string text = number_text(std::round(feed * 1000) / 1000);
  if (text.find('.') == std::string::npos) text += '.';
  return text;
}

/// Writes blocks with what changed since the one before.
class NcWriter {
public:
  NcWriter(const Result& result, const NcStyle& style)
      : result_(result), decimals_(style.decimals), is_linuxcnc_(style.is_linuxcnc) {}

  std::string run(const Progress& progress) {
    const int number = result_.motion.empty() ? 1 : std::max(1, result_.motion.front().program);
    out_ = is_linuxcnc_ ? "%\n(EXPANDED)\n" : "%\nO" + std::to_string(number) + "(EXPANDED)\n";
    out_ += "G90 G21 G40 G49 G80\n";
    std::size_t event = 0, axis = 0;
    for (std::size_t i = 0; i < result_.motion.size(); ++i) {
      progress.step(i, result_.motion.size(), "program");
      for (; event < result_.events.size() && result_.events[event].before <= i; ++event) {
        function(result_.events[event].word);
      }
      extra_.clear();
      for (; axis < result_.axes.size() && result_.axes[axis].move <= i; ++axis) {
        extra_ += result_.axes[axis].axis + coordinate(result_.axes[axis].to, decimals_);
      }
      move(result_.motion[i]);
    }
    for (; event < result_.events.size(); ++event) function(result_.events[event].word);
    if (result_.alarm) {
      out_ += "(ALARM " + std::to_string(result_.alarm->number) + " LINE " +
              std::to_string(result_.alarm->line) + ")\n";
    }
    if (is_linuxcnc_) out_ += "M2\n";
    out_ += "%\n";
    return std::move(out_);
  }

private:
  void function(const std::string& word) {
    if (word.starts_with("G54") || word.starts_with("G55") || word.starts_with("G56") ||
        word.starts_with("G57") || word.starts_with("G58") || word.starts_with("G59") ||
        word == "G20" || word == "G21") {
      return;  // moves carry their work offset; everything is in mm
    }
    out_ += word + "\n";
  }

  void work_offset(const WorkShift& shift) {
    if (!work_offset_ || *work_offset_ != shift.work_offset) {
      work_offset_ = shift.work_offset;
      out_ += shift.work_offset >= 541000
                  ? "G54.1 P" + std::to_string(shift.work_offset - 541000) + "\n"
                  : numbered("G", shift.work_offset) + "\n";
      last_.reset();
    }
    if (shift.length_code != length_code_ || (shift.length_code != 49 && shift.H != H_)) {
      length_code_ = shift.length_code;
      H_ = shift.H;
      block_ += numbered("G", length_code_) + " ";
      if (length_code_ != 49) block_ += numbered("H", H_) + " ";
      last_.reset();
    }
  }

  void move(const Move& move) {
    block_.clear();
    if (move.kind == MoveKind::Dwell) {
      const char* const address = is_linuxcnc_ ? "G04 P" : "G04 X";
      out_ += address + coordinate(result_.dwells[move.detail], 3) + "\n";
      return;
    }
    const WorkShift& shift = result_.shifts[move.shift];
    if (move.machine_fixed) {
      block_ += move.kind == MoveKind::Rapid ? "G53 G00 " : "G53 G01 ";
      coordinates(machine_of(result_, move), false);
      if (move.kind != MoveKind::Rapid) feed(move.feed);
      motion_ = "";
      last_.reset();
    } else {
      work_offset(shift);
      code(move);
      coordinates(move.to + shift.local, move.kind == MoveKind::Arc);
      if (move.kind == MoveKind::Arc) centre(move);
      if (move.kind != MoveKind::Rapid) feed(move.feed);
      last_ = move.to + shift.local;
    }
    block_ += extra_;
    if (!block_.empty()) out_ += block_ + "\n";
    machine_ = machine_of(result_, move);
  }

  void code(const Move& move) {
    std::string motion = move.kind == MoveKind::Rapid ? "G00" : "G01";
    if (move.kind == MoveKind::Arc) {
      const ArcDetail& arc = arc_of(result_, move);
      const std::string plane = plane_codes[static_cast<std::size_t>(arc.plane)];
      if (plane != plane_) block_ += plane + " ";
      plane_ = plane;
      motion = arc.sense == path::ArcSense::Clockwise ? "G02" : "G03";
    }
    if (motion != motion_) block_ += motion + " ";
    motion_ = motion;
  }

  // An arc keeps the axes of its plane also when they do not change.
  void coordinates(const Vector3d& to, bool all) {
    for (int i = 0; i < 3; ++i) {
      const std::string text = coordinate(to[i], decimals_);
      if (!all && last_ && coordinate((*last_)[i], decimals_) == text) continue;
      block_ += "XYZ"[i] + text;
    }
  }

  void centre(const Move& move) {
    const ArcDetail& arc = arc_of(result_, move);
    const path::PlaneAxes axes = path::axes_of(arc.plane);
    const Vector3d from = machine_ - result_.shifts[move.shift].shift;
    for (const int i : {std::min(axes.first, axes.second), std::max(axes.first, axes.second)}) {
      block_ += "IJK"[i] + coordinate(arc.centre[i] - from[i], decimals_);
    }
  }

  void feed(double feed) {
    const std::string text = feed_text(feed);
    if (text != feed_) block_ += "F" + text;
    feed_ = text;
  }

  const Result& result_;
  int decimals_;
  bool is_linuxcnc_;
  std::string out_, block_, extra_, motion_, plane_ = "G17", feed_;
  std::optional<int> work_offset_;
  int length_code_ = 49, H_ = 0;
  std::optional<Vector3d> last_;
  Vector3d machine_ = Vector3d::Zero();  ///< where the last move ended
};

void append(std::string& line, const Vector3d& p) {
  for (int i = 0; i < 3; ++i) line += "," + number_text(p[i]);
}

}  // namespace

std::string nc_text(const Result& result, const NcStyle& style, const Progress& progress) {
  return NcWriter(result, style).run(progress);
}

std::string csv_text(const Result& result, const Progress& progress) {
  std::string out =
      "kind,x,y,z,machine_x,machine_y,machine_z,centre_x,centre_y,centre_z,plane,sense,turns,feed,"
      "seconds,program,line\n";
  constexpr std::size_t usual_line = 128;
  out.reserve(usual_line * result.motion.size());
  for (std::size_t i = 0; i < result.motion.size(); ++i) {
    progress.step(i, result.motion.size(), "program");
    const Move& move = result.motion[i];
    out += kind_names[static_cast<std::size_t>(move.kind)];
    append(out, move.to);
    append(out, machine_of(result, move));
    if (move.kind == MoveKind::Arc) {
      const ArcDetail& arc = arc_of(result, move);
      append(out, arc.centre);
      out += std::string(",") + plane_names[static_cast<std::size_t>(arc.plane)] +
             (arc.sense == path::ArcSense::Clockwise ? ",cw," : ",ccw,") +
             std::to_string(arc.turns);
    } else {
      out += ",,,,,,";
    }
    out += "," + number_text(move.feed) + ",";
    if (move.kind == MoveKind::Dwell) out += number_text(result.dwells[move.detail]);
    out += "," + std::to_string(move.program) + "," + std::to_string(move.line) + "\n";
  }
  return out;
}

std::string trace_text(const Result& result, const Progress& progress) {
  std::string out;
  for (std::size_t i = 0; i < result.trace.size(); ++i) {
    progress.step(i, result.trace.size(), "trace");
    const TraceStep& step = result.trace[i];
    out += numbered("O", step.program) + ":" + std::to_string(step.line) + "  " + step.text;
    if (step.variable) {
      out += numbered("    #", *step.variable) + "=" +
             (step.value.vacant ? std::string("vacant") : number_text(step.value.number));
    }
    out += "\n";
  }
  if (result.alarm) {
    out += numbered("ALARM ", result.alarm->number) + " " + result.alarm->message +
           numbered("  O", result.alarm->program) + ":" + std::to_string(result.alarm->line) + ":" +
           std::to_string(result.alarm->column) + "\n";
  }
  return out;
}

}  // namespace ridgeline::macro
