#include "core/nc/tracer.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/tolerance.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::nc {
namespace {

constexpr int nano_decimals = 9;
constexpr int most_digits = 9;  ///< before the point

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::optional<Nano> take_number(std::string_view& text) {
  std::string_view rest = text;
  const bool negative = rest.starts_with('-');
  if (negative || rest.starts_with('+')) rest.remove_prefix(1);
  Nano value = 0;
  int whole = 0, decimals = 0, digits = 0;
  for (; !rest.empty() && is_digit(rest[0]); rest.remove_prefix(1), ++digits) {
    if (value > 0 || rest[0] != '0') ++whole;
    if (whole > most_digits) return std::nullopt;
    value = 10 * value + (rest[0] - '0');
  }
  if (rest.starts_with('.')) {
    rest.remove_prefix(1);
    Nano round_up = 0;
    for (; !rest.empty() && is_digit(rest[0]); rest.remove_prefix(1), ++digits) {
      if (decimals == nano_decimals) round_up = rest[0] >= '5' ? 1 : 0;
      if (decimals < nano_decimals) value = 10 * value + (rest[0] - '0');
      ++decimals;
    }
    for (int n = decimals; n < nano_decimals; ++n) value *= 10;
    value += round_up;
  } else {
    value *= nano;
  }
  if (digits == 0) return std::nullopt;
  text = rest;
  return negative ? -value : value;
}

void Spot::bad(const std::string& why) const {
  const std::string place = "line " + std::to_string(line);
  throw Error(ErrorCode::BadFile, place + ": " + word + ": " + why,
              {place, word, "", std::nullopt, std::nullopt});
}

void Spot::unsupported(const std::string& why) const {
  const std::string place = "line " + std::to_string(line);
  throw Error(ErrorCode::Unsupported, place + ": " + word + ": " + why,
              {place, word, "", std::nullopt, std::nullopt});
}

void Tracer::reserve(std::size_t lines) {
  reading_.motion.moves.reserve(lines);
  reading_.lines.reserve(lines);
}

Tracer::Tracer(const ReadOptions& options) {
  if (!options.start) return;
  for (std::size_t n = 0; n < 3; ++n) {
    const double x = (*options.start)[static_cast<int>(n)];
    if (!(std::abs(x) <= 1e6)) throw Error(ErrorCode::BadInput, "start is not within +-1e6 mm");
    at_[n] = std::llround(x * static_cast<double>(nano));
  }
  has_start_ = true;
  reading_.motion.start = position();
}

Nano Tracer::at(std::size_t axis, const Spot& spot) const {
  if (!at_[axis]) {
    spot.bad(std::string("the program has not said yet where ") + "XYZ"[axis] + " is");
  }
  return *at_[axis];
}

Eigen::Vector3d Tracer::position() const {
  return work({real(*at_[0]), real(*at_[1]), real(*at_[2])});
}

void Tracer::move_to(const Target& to, const Spot& spot) {
  for (std::size_t n = 0; n < 3; ++n) {
    if (!to[n]) continue;
    if (std::abs(*to[n]) > largest_read) spot.bad("it leads beyond 1000000 mm");
    at_[n] = to[n];
  }
}

void Tracer::begin() {
  reading_.motion.start = position();
  has_start_ = true;
}

void Tracer::record(const path::Move& move, const Spot& spot) {
  reading_.motion.moves.push_back(move);
  reading_.lines.push_back(spot.line);
}

// Where the tool is in the new frame is not known: the way out is not part of the motion.
void Tracer::leave(const Target& to, const Spot& spot) {
  move_to(to, spot);
  const bool goes = to[0] || to[1] || to[2];
  if (goes && !reading_.unmeasured_line) reading_.unmeasured_line = spot.line;
}

void Tracer::rapid(const Target& to, const Spot& spot) {
  if (is_lost_) return leave(to, spot);
  const bool was_known = all_known();
  const Target from = at_;
  move_to(to, spot);
  if (!all_known() || at_ == from) return;
  if (!was_known || !has_start_) return begin();
  record({path::MoveKind::Rapid, position(), 0, std::nullopt}, spot);
}

void Tracer::feed(const Target& to, double mm_per_s, const std::optional<ArcTarget>& arc,
                  const Spot& spot) {
  if (!(mm_per_s > 0)) spot.bad("there is no feed F for it");
  if (is_lost_) {
    spot.unsupported(
        "motion with a feed goes on after a machine position, another tool, offset or plane; one "
        "motion in one frame is read");
  }
  const bool was_known = all_known();
  const Target from = at_;
  if (!was_known) {
    if (arc || has_cut_) spot.bad("it begins where the tool is not known to be");
    return rapid(to, spot);
  }
  const Eigen::Vector3d start = position();
  move_to(to, spot);
  if (!arc && at_ == from) return;
  path::Move move{path::MoveKind::Cut, position(), mm_per_s, std::nullopt};
  if (arc) {
    const auto [i, j, k] = path::axes_of(arc->plane);
    Eigen::Vector3d centre;
    centre[i] = arc->centre.x();
    centre[j] = arc->centre.y();
    centre[k] = real(*from[static_cast<std::size_t>(k)]);
    move.arc = path::Arc{work(centre), arc->plane, arc->sense, axes_};
    const Eigen::Vector2d begin(real(*from[static_cast<std::size_t>(i)]),
                                real(*from[static_cast<std::size_t>(j)]));
    const Eigen::Vector2d end(real(*at_[static_cast<std::size_t>(i)]),
                              real(*at_[static_cast<std::size_t>(j)]));
    if (begin == arc->centre || end == arc->centre) spot.bad("an end of the arc is its centre");
    const path::ArcShape shape = path::arc_shape(start, move);
    if (!(std::abs(shape.start_radius - shape.end_radius) <= read_radius_tolerance)) {
      spot.bad("the ends of the arc are " + std::to_string(shape.start_radius) + " and " +
               std::to_string(shape.end_radius) + " mm from its centre");
    }
  }
  record(move, spot);
  has_cut_ = true;
}

void Tracer::lose(std::size_t axis) {
  at_[axis].reset();
  if (has_cut_) {
    is_lost_ = true;
    return;
  }
  // What came before only positioned the tool.
  has_start_ = false;
  reading_.motion.moves.clear();
  reading_.lines.clear();
}

void Tracer::lose_all() {
  for (std::size_t n = 0; n < 3; ++n) lose(n);
}

void Tracer::set_work_offset(const std::string& name) {
  if (name == reading_.work_offset) return;
  if (has_cut_) return lose_all();
  if (!reading_.work_offset.empty()) lose_all();
  reading_.work_offset = name;
}

void Tracer::set_tool(int number) {
  if (reading_.tool_number == number) return;
  if (has_cut_) return lose_all();
  reading_.tool_number = number;
}

void Tracer::set_length_offset(std::optional<int> number, std::optional<std::size_t> axis) {
  if (length_ == number) return;
  length_ = number;
  if (number) reading_.length_offset = number;
  axis ? lose(*axis) : lose_all();
}

void Tracer::set_plane(const std::optional<Eigen::Matrix3d>& axes, const Eigen::Vector3d& origin) {
  lose_all();
  if (has_cut_) return;  // the way out: of no plane that is read
  axes_ = axes.value_or(Eigen::Matrix3d::Identity());
  origin_ = origin;
  if (axes) reading_.tool_axis = axes->col(2);
}

Reading Tracer::take(Dialect dialect) {
  reading_.dialect = dialect;
  return std::move(reading_);
}

Eigen::Vector2d centre_of(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double R,
                          path::ArcSense sense, const Spot& spot) {
  const Eigen::Vector2d chord = to - from;
  const double half = chord.norm() / 2;
  if (!(half > coincident_ends)) spot.bad("the ends of an arc with a radius coincide");
  if (!(half <= std::abs(R) + read_radius_tolerance / 2)) {
    spot.bad("its ends are " + std::to_string(2 * half) + " mm apart, more than twice the radius");
  }
  // Counter-clockwise and up to half a turn: the centre is left of the chord.
  const double height = std::sqrt(std::max(0.0, R * R - half * half));
  const double side = (sense == path::ArcSense::CounterClockwise) == (R > 0) ? 1 : -1;
  const Eigen::Vector2d left = Eigen::Vector2d(-chord.y(), chord.x()) / (2 * half);
  return (from + to) / 2 + side * height * left;
}

bool is_harmless_m(int code) {
  static constexpr std::array codes{0,  1,  3,  4,  5,  6,  7,  8,  9,  10, 11,
                                    13, 14, 19, 25, 26, 48, 49, 50, 51, 60};
  return std::ranges::find(codes, code) != codes.end();
}

}  // namespace ridgeline::nc
