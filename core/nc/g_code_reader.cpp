#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/nc/g_code_block.hpp"
#include "core/nc/g_code_words.hpp"
#include "core/nc/tilted_plane.hpp"
#include "core/nc/tracer.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::nc {
namespace {

constexpr std::string_view axis_letters = "XYZ";
constexpr std::string_view centre_letters = "IJK";

/// G codes in tenths, so that G54.1 is 541.
constexpr int tenths = 10;

class GCodeReader {
public:
  GCodeReader(std::string_view text, Dialect dialect, const ReadOptions& options)
      : rest_(text), dialect_(dialect), tracer_(options) {}

  Reading run(const Progress& progress) {
    const std::size_t size = rest_.size();
    tracer_.reserve(static_cast<std::size_t>(std::ranges::count(rest_, '\n')) + 1);
    while (!rest_.empty() && !has_ended_) {
      if (number_ % 1024 == 0) progress.at(read_share(rest_, size), "reading");
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line(trimmed(rest_.substr(0, end)), ++number_);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
    }
    if (!tracer_.reading().tool_number) tracer_.reading().tool_number = chosen_tool_;
    return tracer_.take(dialect_);
  }

private:
  enum class Motion { None, Rapid, Line, Clockwise, CounterClockwise };

  void line(std::string_view text, int number) {
    if (text.starts_with('%')) {
      // The first % opens the tape, the second closes it.
      has_ended_ = has_run_;
      return;
    }
    if (!text.empty() && (text[0] == 'O' || text[0] == 'o')) return o_word(text, number);
    Block block = block_of(text, number, dialect_);
    if (block.words.empty() && block.names.empty()) return;
    has_run_ = true;
    run(block);
  }

  /// O1234 heads a program; of LinuxCNC's flow only one subprogram around the motion is read.
  void o_word(std::string_view text, int number) {
    const Spot spot{number, std::string(text)};
    std::string_view rest = text.substr(1);
    if (rest.starts_with('<')) {
      const std::size_t end = rest.find('>');
      if (end == rest.npos) spot.bad("the name has no end");
      rest.remove_prefix(end + 1);
    } else if (!take_number(rest)) {
      spot.bad("has no number");
    }
    std::string word;
    rest = trimmed(rest);
    while (!rest.empty() && is_letter(rest[0])) {
      word += upper_case(rest[0]);
      rest.remove_prefix(1);
    }
    rest = trimmed(rest);
    if (!rest.empty() && rest[0] != '(' && rest[0] != ';') spot.bad("is not read");
    if (word == "ENDSUB" || word == "RETURN") {
      has_ended_ = true;
    } else if (word.empty() ? has_run_ : word != "SUB") {
      spot.unsupported(word.empty() ? "a second program in the file" : "flow control is not read");
    }
  }

  void run(Block& block) {
    if (Word* n = block.use('N')) whole(block, *n, 0, 99'999'999);
    radius_.reset();
    is_machine_ = is_reference_ = is_dwell_ = has_ended_here_ = false;
    for (const Name& name : block.names) apply(name, block);
    // Modes first, whatever their order in the block.
    for (Word& word : block.words) {
      if (word.letter == 'G') apply_g(word, block);
    }
    values(block);
    for (Word& word : block.words) {
      if (word.letter == 'M') apply_m(word, block);
    }
    move(block);
    for (const Word& word : block.words) {
      if (!word.used) Spot{block.spot.line, word.text}.bad("is not understood here");
    }
    has_ended_ = has_ended_here_;
  }

  static int whole(const Block& block, const Word& word, int low, int high) {
    if (word.value % nano != 0 || word.value < low * nano || word.value > high * nano) {
      Spot{block.spot.line, word.text}.bad("must be a whole number from " + std::to_string(low) +
                                           " to " + std::to_string(high));
    }
    return static_cast<int>(word.value / nano);
  }

  void apply_g(Word& word, Block& block) {
    const Spot spot{block.spot.line, word.text};
    word.used = true;
    if (word.value < 0 || word.value % (nano / tenths) != 0 || word.value > 1000 * nano) {
      spot.bad("there is no such G code");
    }
    const int code = static_cast<int>(word.value / (nano / tenths));
    is_dwell_ = is_dwell_ || code == 40;
    if (apply_mode(code) || apply_frame(code, block, spot) ||
        is_harmless_g(code, block, dialect_)) {
      return;
    }
    refuse_g(code, spot);
  }

  /// Modes without a word of their own. False: not one of them.
  bool apply_mode(int code) {
    switch (code) {
      case 0: motion_ = Motion::Rapid; return true;
      case 10: motion_ = Motion::Line; return true;
      case 20: motion_ = Motion::Clockwise; return true;
      case 30: motion_ = Motion::CounterClockwise; return true;
      case 170: plane_ = path::ArcPlane::XY; return true;
      case 180: plane_ = path::ArcPlane::ZX; return true;
      case 190: plane_ = path::ArcPlane::YZ; return true;
      case 200: is_inch_ = true; return true;
      case 210: is_inch_ = false; return true;
      case 800:
        if (dialect_ == Dialect::LinuxCnc) motion_ = Motion::None;
        return true;
      case 900: is_incremental_ = false; return true;
      case 910: is_incremental_ = true; return true;
      case 901: is_centre_absolute_ = true; return true;
      case 911: is_centre_absolute_ = false; return true;
      case 530: is_machine_ = true; return true;
      default: break;
    }
    if (dialect_ != Dialect::Siemens) return false;
    if (code == 1530) return is_machine_ = true;
    if (code == 740 || code == 750) return is_reference_ = true;
    if (code == 700 || code == 7000) is_inch_ = true;
    if (code == 710 || code == 7100) is_inch_ = false;
    return code == 700 || code == 7000 || code == 710 || code == 7100;
  }

  /// Offsets, lengths, planes, the reference point.
  bool apply_frame(int code, Block& block, const Spot& spot) {
    const bool siemens_offset = dialect_ == Dialect::Siemens && code % 10 == 0 &&
                                (code == 5000 || (code >= 5050 && code <= 5990));
    if ((code >= 540 && code <= 590 && code % 10 == 0) || (code >= 591 && code <= 593) ||
        siemens_offset) {
      std::string name = "G" + std::to_string(code / 10);
      if (code % 10 != 0) name += "." + std::to_string(code % 10);
      tracer_.set_work_offset(name);
      return true;
    }
    switch (code) {
      case 541: {
        const Word* p = block.use('P');
        if (p == nullptr) spot.bad("has no P");
        tracer_.set_work_offset("G54.1 P" + std::to_string(whole(block, *p, 1, 300)));
        return true;
      }
      case 430:
      case 431:
      case 434:
      case 440: {
        if (const Word* h = block.use('H')) length_number_ = whole(block, *h, 0, 9999);
        has_length_ = true;
        follows_tool_ = code == 431 || code == 434;
        set_length(length_number_.value_or(tracer_.reading().tool_number.value_or(0)));
        return true;
      }
      case 490:
        has_length_ = false;
        set_length(std::nullopt);
        return true;
      case 280:
      case 300: is_reference_ = true; return true;
      case 682: tilt(block, spot); return true;
      case 690: tracer_.set_plane(std::nullopt, Eigen::Vector3d::Zero()); return true;
      default: return false;
    }
  }

  /// The length lies along the axis across the plane, unless the control follows the tool.
  void set_length(std::optional<int> number) {
    const auto axis = static_cast<std::size_t>(path::axes_of(plane_).third);
    tracer_.set_length_offset(number, follows_tool_ ? std::nullopt : std::optional(axis));
  }

  Nano length_of(const Word& word, const Block& block) const {
    if (std::abs(word.value) > largest_read) {
      Spot{block.spot.line, word.text}.bad("it leads beyond 1000000 mm");
    }
    return is_inch_ ? (word.value * 254 + (word.value < 0 ? -5 : 5)) / 10 : word.value;
  }

  /// G68.2 X Y Z I J K: the origin, then Euler angles.
  void tilt(Block& block, const Spot& spot) {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    std::array<double, 3> angles{};
    for (std::size_t n = 0; n < 3; ++n) {
      if (const Word* word = block.use(axis_letters[n])) {
        origin[static_cast<int>(n)] = real(length_of(*word, block));
      }
      const Word* angle = block.use(centre_letters[n]);
      if (angle == nullptr) spot.bad("has not all of the angles I, J and K");
      angles[n] = real(angle->value);
    }
    tracer_.set_plane(plane_of_euler(angles), origin);
  }

  void apply(const Name& name, Block& block) {
    const Spot spot{block.spot.line, name.text};
    if (name.name == "RET") {
      has_ended_here_ = true;
    } else if (name.name == "SUPA") {
      is_machine_ = true;
    } else if (name.name == "TRAORI" || name.name == "TRAFOOF") {
      tracer_.lose_all();
    } else if (name.name == "CYCLE800") {
      const SwivelPlane plane = swivel_plane(name, spot);
      tracer_.set_plane(plane.axes, plane.origin);
    } else if ((name.name == "ROT" || name.name == "TRANS") && block.words.empty()) {
      tracer_.set_plane(std::nullopt, Eigen::Vector3d::Zero());
    } else if (name.name == "CR") {
      std::string_view text = name.arguments;
      radius_ = take_number(text);
      if (!radius_ || !text.empty()) spot.bad("has no number");
    } else if (name.name == "PROC") {
      block.words.clear();
    } else if (!is_harmless_name(name.name)) {
      spot.bad("is not read");
    }
  }

  /// F S T H D.
  void values(Block& block) {
    if (Word* f = block.use('F')) {
      const Spot spot{block.spot.line, f->text};
      if (f->value < 0 || f->value > largest_read) spot.bad("is not a feed");
      feed_ = real(f->value) * (is_inch_ ? 25.4 : 1);
    }
    if (Word* s = block.use('S')) {
      if (s->value < 0) Spot{block.spot.line, s->text}.bad("is not a speed");
      tracer_.reading().spindle_speed = real(s->value);
    }
    if (Word* t = block.use('T')) chosen_tool_ = whole(block, *t, 0, 99'999'999);
    if (Word* d = block.use('D')) {
      const int number = whole(block, *d, 0, 9999);
      if (dialect_ == Dialect::Siemens) {
        if (chosen_tool_) tracer_.set_tool(*chosen_tool_);
        set_length(number == 0 ? std::nullopt : std::optional(number));
      }
    }
    if (const Word* h = block.use('H')) {
      length_number_ = whole(block, *h, 0, 9999);
      if (has_length_) set_length(length_number_);
    }
  }

  void apply_m(Word& word, Block& block) {
    const Spot spot{block.spot.line, word.text};
    word.used = true;
    const int code = whole(block, word, 0, 999);
    if (code == 2 || code == 30 || code == 99 || code == 17) {
      has_ended_here_ = true;
    } else if (code == 3 || code == 4) {
      tracer_.reading().spindle_clockwise = code == 3;
    } else if (code == 6) {
      if (!chosen_tool_) spot.bad("no tool T is chosen");
      tracer_.set_tool(*chosen_tool_);
    } else if (code == 97 || code == 98) {
      spot.unsupported("subprograms are not read");
    } else if (!is_harmless_m(code)) {
      spot.bad("this M code is not read");
    }
  }

  void move(Block& block) {
    if (is_dwell_) return;
    // Axes that turn: to a machine position, or on the way out.
    for (const char rotary : {'A', 'B', 'C'}) {
      if (is_machine_ || is_reference_ || tracer_.is_lost()) block.use(rotary);
    }
    Tracer::Target to{};
    bool any = false;
    for (std::size_t n = 0; n < 3; ++n) {
      const Word* word = block.use(axis_letters[n]);
      if (word == nullptr) continue;
      any = true;
      const Spot spot{block.spot.line, word->text};
      if (is_machine_) {
        tracer_.lose(n);
        continue;
      }
      to[n] = length_of(*word, block);
      if (is_incremental_ && tracer_.is_known(n)) {
        *to[n] += tracer_.at(n, spot);
      } else if (is_incremental_) {
        // From an unknown height G91 G28 Z0 goes straight up; anything else needs to be known.
        if (!is_reference_) tracer_.at(n, spot);
        to[n].reset();
        tracer_.lose(n);
      }
    }
    if (is_reference_) return reference(block, to, any);
    if (is_machine_) return;
    if (motion_ == Motion::Clockwise || motion_ == Motion::CounterClockwise) {
      if (any || radius_ || block.has('I') || block.has('J') || block.has('K') || block.has('R')) {
        arc(block, to);
      }
      return;
    }
    if (!any) return;
    if (motion_ == Motion::None) block.spot.bad("neither G0 nor G1, G2, G3 is active");
    if (motion_ == Motion::Rapid) {
      tracer_.rapid(to, block.spot);
    } else {
      tracer_.feed(to, feed_ / 60, std::nullopt, block.spot);
    }
  }

  /// By the point given to the reference point, which only the machine knows.
  void reference(Block& block, const Tracer::Target& to, bool any) {
    block.use('P');
    if (dialect_ != Dialect::Siemens) tracer_.rapid(to, block.spot);  // its values mean nothing
    for (std::size_t n = 0; n < 3; ++n) {
      if (!any || block.has(axis_letters[n])) tracer_.lose(n);
    }
  }

  void arc(Block& block, const Tracer::Target& to) {
    const Spot& spot = block.spot;
    const auto [i, j, k] = path::axes_of(plane_);
    const auto first = static_cast<std::size_t>(i), second = static_cast<std::size_t>(j);
    const Nano from_1 = tracer_.at(first, spot), from_2 = tracer_.at(second, spot);
    const path::ArcSense sense =
        motion_ == Motion::Clockwise ? path::ArcSense::Clockwise : path::ArcSense::CounterClockwise;
    if (dialect_ != Dialect::Siemens) {
      if (const Word* r = block.use('R')) radius_ = length_of(*r, block);
    }
    const Word* c1 = block.use(centre_letters[first]);
    const Word* c2 = block.use(centre_letters[second]);
    Eigen::Vector2d centre;
    if (radius_) {
      if (c1 != nullptr || c2 != nullptr) spot.bad("an arc has a radius or a centre, not both");
      centre = centre_of({real(from_1), real(from_2)},
                         {real(to[first].value_or(from_1)), real(to[second].value_or(from_2))},
                         real(*radius_), sense, spot);
    } else {
      if (c1 == nullptr && c2 == nullptr) spot.bad("the arc has neither a radius nor a centre");
      if (is_centre_absolute_ && (c1 == nullptr || c2 == nullptr)) {
        spot.bad("an absolute centre needs both its coordinates");
      }
      const auto coordinate = [&](const Word* word, Nano from) {
        const Nano value = word == nullptr ? 0 : length_of(*word, block);
        return real(is_centre_absolute_ ? value : from + value);
      };
      centre = {coordinate(c1, from_1), coordinate(c2, from_2)};
    }
    tracer_.feed(to, feed_ / 60, Tracer::ArcTarget{plane_, sense, centre}, spot);
  }

  std::string_view rest_;
  Dialect dialect_;
  Tracer tracer_;
  int number_ = 0;
  bool has_run_ = false, has_ended_ = false;

  // Modal.
  Motion motion_ = Motion::None;
  path::ArcPlane plane_ = path::ArcPlane::XY;
  bool is_inch_ = false, is_incremental_ = false, is_centre_absolute_ = false;
  bool has_length_ = false, follows_tool_ = false;
  double feed_ = 0;  ///< [mm/min]
  std::optional<int> chosen_tool_, length_number_;

  // Of the block.
  std::optional<Nano> radius_;
  bool is_machine_ = false, is_reference_ = false, is_dwell_ = false, has_ended_here_ = false;
};

}  // namespace

Reading read_g_code(std::string_view text, Dialect dialect, const ReadOptions& options,
                    const Progress& progress) {
  return GCodeReader(text, dialect, options).run(progress);
}

}  // namespace ridgeline::nc
