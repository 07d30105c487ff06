#include "core/nc/cl.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/base/error.hpp"
#include "core/nc/text.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::nc {
namespace {

constexpr int cl_decimals = 6;
constexpr double csv_arc_tolerance = 0.001;  // [mm]

std::string apt_number(double value) {
  const auto scale = static_cast<double>(power_of_ten(cl_decimals));
  return decimal(std::llround(value * scale), cl_decimals, NumberStyle::Point);
}

/// Shortest text that reads back as the same number.
std::string exact(double value) {
  std::array<char, 32> buffer{};
  const auto [end, failure] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  if (failure != std::errc{}) throw Error(ErrorCode::Internal, "a number does not print");
  return {buffer.data(), end};
}

/// mm/s to mm/min, without the noise of the division that made it (programs have 0.001 mm/min).
double per_minute(double feed) {
  return std::round(feed * 60 * 1e6) / 1e6;
}

/// The program that a post-processor would start from: straight moves in the work frame.
Program in_chords(Program program, double arc_tolerance, const Progress& progress) {
  program.dialect = Dialect::Fanuc;
  program.work_offset.clear();
  program.tilted = TiltedOutput::WorkFrame;
  program.motion = path::linearised(program.motion, arc_tolerance, progress);
  return program;
}

class ClWriter {
public:
  ClWriter(Program program, double arc_tolerance, const Progress& progress)
      : program_(in_chords(std::move(program), arc_tolerance, progress.part(0, 0.2))),
        motion_(rounded(program_, progress.part(0.2, 0.5))) {}

  std::string run(const Progress& progress) {
    line("PARTNO/RIDGELINE " + std::to_string(program_.number));
    for (std::string comment : comment_lines(program_.comments, Dialect::Fanuc)) {
      for (char& c : comment) {
        if (c == '$') c = ' ';  // ends a statement in APT
      }
      line("PPRINT/" + comment);
    }
    line("UNITS/MM");
    if (is_multax()) line("MULTAX/ON");
    if (program_.tool_number != 0) line("LOADTL/" + std::to_string(program_.tool_number));
    if (program_.spindle_speed > 0) {
      line("SPINDL/RPM," + apt_number(program_.spindle_speed) +
           (program_.spindle_clockwise ? ",CLW" : ",CCLW"));
    }
    if (program_.coolant == Coolant::Flood) line("COOLNT/FLOOD");
    if (program_.coolant == Coolant::Mist) line("COOLNT/MIST");
    rapid_to(motion_.start);
    for (std::size_t i = 0; i < motion_.moves.size(); ++i) {
      progress.step(i, motion_.moves.size(), "program");
      add(motion_.moves[i]);
    }
    if (program_.coolant != Coolant::None) line("COOLNT/OFF");
    if (program_.spindle_speed > 0) line("SPINDL/OFF");
    if (is_multax()) line("MULTAX/OFF");
    line("FINI");
    return std::move(text_);
  }

private:
  bool is_multax() const { return program_.tool_axis != Eigen::Vector3d::UnitZ(); }

  void line(std::string_view text) {
    text_ += text;
    text_ += '\n';
  }

  /// RAPID is for the next GOTO only.
  void rapid_to(const Eigen::Vector3d& point) {
    line("RAPID");
    go_to(point);
  }

  void go_to(const Eigen::Vector3d& point) {
    std::string text = "GOTO/";
    for (int n = 0; n < 3; ++n) text += (n == 0 ? "" : ",") + apt_number(point[n]);
    if (is_multax()) {
      for (const double x : program_.tool_axis) text += ',' + apt_number(x);
    }
    line(text);
  }

  void add(const path::Move& move) {
    if (move.feed == 0) return rapid_to(move.to);
    if (move.feed != feed_) line("FEDRAT/" + apt_number(per_minute(move.feed)) + ",MMPM");
    feed_ = move.feed;
    go_to(move.to);
  }

  Program program_;  ///< in chords
  path::Motion motion_;
  std::string text_;
  double feed_ = 0;
};

std::string arc_cells(const std::optional<path::Arc>& arc) {
  if (!arc) return ",,,,,";
  constexpr std::array<std::string_view, 3> planes{"XY", "ZX", "YZ"};
  std::string cells = ",";
  cells += planes.at(static_cast<std::size_t>(arc->plane));
  cells += arc->sense == path::ArcSense::Clockwise ? ",cw" : ",ccw";
  for (const double x : arc->centre) cells += ',' + exact(x);
  return cells;
}

}  // namespace

std::string write_cl(Program program, double arc_tolerance, const Progress& progress) {
  return ClWriter(std::move(program), arc_tolerance, progress).run(progress.part(0.5, 1));
}

std::string write_csv(const path::Motion& motion, const Progress& progress) {
  const auto cells = [](const Eigen::Vector3d& point, double feed) {
    return exact(point.x()) + ',' + exact(point.y()) + ',' + exact(point.z()) + ',' +
           exact(per_minute(feed));
  };
  std::string text = "index,kind,x,y,z,feed,plane,sense,centre_x,centre_y,centre_z\n";
  text += "0,start," + cells(motion.start, 0) + arc_cells(std::nullopt) + '\n';
  std::size_t index = 0;
  Eigen::Vector3d from = motion.start;
  for (std::size_t i = 0; i < motion.moves.size(); ++i) {
    progress.step(i, motion.moves.size(), "program");
    const path::Move& move = motion.moves[i];
    std::vector<path::Move> rows{move};
    if (move.arc && move.arc->axes != Eigen::Matrix3d::Identity()) {
      rows = path::linearised({from, {move}}, csv_arc_tolerance).moves;
    }
    for (const path::Move& row : rows) {
      text += std::to_string(++index) + ',' + std::string(name(row.kind)) + ',' +
              cells(row.to, row.feed) + arc_cells(row.arc) + '\n';
    }
    from = move.to;
  }
  return text;
}

}  // namespace ridgeline::nc
