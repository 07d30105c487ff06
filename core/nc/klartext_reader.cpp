#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/nc/g_code_block.hpp"
#include "core/nc/klartext_tokens.hpp"
#include "core/nc/plan.hpp"
#include "core/nc/tilted_plane.hpp"
#include "core/nc/tracer.hpp"
#include "core/path/arc.hpp"

namespace ridgeline::nc {
namespace {

constexpr std::string_view axis_letters = "XYZ";

class KlartextReader {
public:
  KlartextReader(std::string_view text, const ReadOptions& options)
      : rest_(text), tracer_(options) {}

  Reading run(const Progress& progress) {
    const std::size_t size = rest_.size();
    tracer_.reserve(static_cast<std::size_t>(std::ranges::count(rest_, '\n')) + 1);
    for (int blocks = 0; !rest_.empty() && !has_ended_; ++blocks) {
      if (blocks % 1024 == 0) progress.at(read_share(rest_, size), "reading");
      block();
    }
    return tracer_.take(Dialect::Heidenhain);
  }

private:
  std::string_view physical_line() {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return line;
  }

  /// One block: its lines joined by ~, without comments and its number.
  void block() {
    std::string text;
    bool more = true;
    int first = 0;
    while (more && !rest_.empty()) {
      std::string_view line = physical_line();
      if (first == 0) first = number_;
      more = line.ends_with('~');
      if (more) line.remove_suffix(1);
      text += line.substr(0, std::min(line.find(';'), line.size()));
      text += ' ';
    }
    std::string_view words = trimmed(text);
    while (!words.empty() && words[0] >= '0' && words[0] <= '9') words.remove_prefix(1);
    words = trimmed(words);
    if (words.empty() || words[0] == '*') return;
    spot_ = {first, std::string(words)};
    run(words);
  }

  static bool take_word(std::string_view& words, std::string_view word) {
    const bool is_whole =
        words.size() == word.size() || !is_letter(words[std::min(word.size(), words.size() - 1)]);
    if (!words.starts_with(word) || !is_whole) return false;
    words = trimmed(words.substr(word.size()));
    return true;
  }

  void run(std::string_view words) {
    const std::string_view all = words;
    if (take_word(words, "BEGIN PGM")) return begin(words);
    if (take_word(words, "END PGM")) return void(has_ended_ = true);
    if (take_word(words, "BLK FORM") || take_word(words, "TOOL DEF")) return;
    if (take_word(words, "TOOL CALL")) return tool_call(words);
    if (take_word(words, "CYCL DEF")) return cycle(words);
    if (take_word(words, "PLANE VECTOR")) return plane_vector(words);
    if (take_word(words, "PLANE RESET")) {
      return tracer_.set_plane(std::nullopt, Eigen::Vector3d::Zero());
    }
    if (take_word(words, "STOP")) return rest(tokens_of(words, spot_.line));
    if (take_word(words, "L")) return line(tokens_of(words, spot_.line));
    if (take_word(words, "CC")) return centre(tokens_of(words, spot_.line));
    if (take_word(words, "CR")) return radius_arc(tokens_of(words, spot_.line));
    if (take_word(words, "CP")) return polar_arc(tokens_of(words, spot_.line));
    if (take_word(words, "C")) return arc(tokens_of(words, spot_.line));
    if (all[0] == 'M') return rest(tokens_of(all, spot_.line));
    for (const std::string_view name : {"CALL", "LBL", "FN", "RND", "CHF", "CT", "LP", "Q"}) {
      if (all.starts_with(name)) spot_.unsupported("is not read");
    }
    spot_.bad("is not read");
  }

  void begin(std::string_view words) {
    if (words.ends_with(" INCH")) {
      is_inch_ = true;
    } else if (!words.ends_with(" MM")) {
      spot_.bad("names neither MM nor INCH");
    }
  }

  void tool_call(std::string_view words) {
    for (const Token& token : tokens_of(words, spot_.line)) {
      const Spot spot{spot_.line, token.text};
      if (token.name.empty() && token.value && *token.value % nano == 0) {
        const int number = static_cast<int>(*token.value / nano);
        if (tracer_.reading().tool_number != number) {
          tracer_.set_tool(number);
          tracer_.lose_all();
        }
      } else if (token.name == "S" && token.value) {
        tracer_.reading().spindle_speed = real(*token.value);
      } else if (token.name == "F" && token.value) {
        feed_ = feed_of(token);
      } else if ((token.name == "DL" || token.name == "DR") && token.value) {
        if (*token.value != 0) spot.unsupported("tool oversizes are not read");
      } else if (token.name != "X" && token.name != "Y" && token.name != "Z") {
        spot.bad("is not read in a tool call");
      }
    }
  }

  void cycle(std::string_view words) {
    const std::optional<Nano> number = take_number(words);
    if (!number) spot_.bad("has no number");
    if (*number >= 32 * nano && *number < 33 * nano) return;  // tolerance of the contour
    if (*number != 247 * nano) spot_.unsupported("cycles other than 247 and 32 are not read");
    const std::size_t at = words.find("Q339=");
    std::string_view value = at == words.npos ? "" : words.substr(at + 5);
    const std::optional<Nano> datum = take_number(value);
    if (!datum) spot_.bad("has no datum number Q339");
    tracer_.set_work_offset(std::to_string(*datum / nano));
  }

  void plane_vector(std::string_view words) {
    static constexpr std::array<std::string_view, 15> positioning{
        "TURN", "MOVE", "STAY",  "FMAX",  "F",   "DIST", "MB",  "MAX",
        "SEQ",  "SYM",  "TABLE", "COORD", "ROT", "ABST", "AUTO"};
    Eigen::Vector3d base = Eigen::Vector3d::Zero(), normal = base;
    int found = 0;
    for (const Token& token : tokens_of(words, spot_.line)) {
      const std::size_t axis =
          token.name.size() == 2 ? axis_letters.find(token.name[1]) : axis_letters.npos;
      if (token.value && axis != axis_letters.npos &&
          (token.name[0] == 'B' || token.name[0] == 'N')) {
        (token.name[0] == 'B' ? base : normal)[static_cast<int>(axis)] = real(*token.value);
        ++found;
      } else if (std::ranges::find(positioning, token.name) == positioning.end()) {
        Spot{spot_.line, token.text}.bad("is not read in a plane");
      }
    }
    const Eigen::Vector3d across = base - base.dot(normal) / normal.squaredNorm() * normal;
    if (found != 6 || !(normal.norm() > 1e-6 && across.norm() > 1e-6)) {
      spot_.bad("the vectors B and N span no plane");
    }
    tracer_.set_plane(plane_of_vectors(base, normal), Eigen::Vector3d::Zero());
  }

  Nano length_of(const Token& token) const {
    if (!token.value) Spot{spot_.line, token.text}.bad("has no number");
    if (std::abs(*token.value) > largest_read) {
      Spot{spot_.line, token.text}.bad("it leads beyond 1000000 mm");
    }
    return is_inch_ ? (*token.value * 254 + (*token.value < 0 ? -5 : 5)) / 10 : *token.value;
  }

  double feed_of(const Token& token) const {
    if (!token.value || *token.value <= 0 || *token.value > largest_read) {
      Spot{spot_.line, token.text}.bad("is not a feed");
    }
    return real(*token.value) * (is_inch_ ? 25.4 : 1);
  }

  /// A coordinate X+5 or IX+5 goes into `to`. False: the token is none.
  bool coordinate(const Token& token, Tracer::Target& to) {
    const bool incremental = token.name.size() == 2 && token.name[0] == 'I';
    if (token.name.size() != (incremental ? 2U : 1U)) return false;
    const std::size_t axis = axis_letters.find(token.name.back());
    if (axis == axis_letters.npos) return false;
    const Spot spot{spot_.line, token.text};
    if (to[axis]) spot.bad("a second coordinate of its axis");
    to[axis] = length_of(token) + (incremental ? tracer_.at(axis, spot) : 0);
    return true;
  }

  /// F, FMAX, R0 and M codes, which any block of motion may have.
  bool common(const Token& token) {
    const Spot spot{spot_.line, token.text};
    if (token.name == "FMAX") {
      is_rapid_ = true;
    } else if (token.name == "F") {
      feed_ = feed_of(token);
    } else if (token.name == "R" && token.value == Nano{0}) {
      return true;
    } else if (token.name == "RL" || token.name == "RR") {
      spot.unsupported("the radius that the control would correct is not known");
    } else if (token.name == "M" && token.value && *token.value % nano == 0) {
      apply_m(static_cast<int>(*token.value / nano), spot);
    } else {
      return false;
    }
    return true;
  }

  void apply_m(int code, const Spot& spot) {
    if (code == 2 || code == 30) {
      ends_here_ = true;
    } else if (code == 3 || code == 4) {
      tracer_.reading().spindle_clockwise = code == 3;
    } else if (code == 91 || code == 92) {
      is_machine_ = true;
    } else if (code == 128 || code == 129 || code == 140) {
      tracer_.lose_all();  // M140: back along the tool
    } else if (!is_harmless_m(code)) {
      spot.bad("this M code is not read");
    }
  }

  void start_block() { is_rapid_ = is_machine_ = ends_here_ = false; }

  void rest(const std::vector<Token>& tokens) {
    start_block();
    for (const Token& token : tokens) {
      if (!common(token)) Spot{spot_.line, token.text}.bad("is not understood here");
    }
    has_ended_ = ends_here_;
  }

  /// The coordinates of a block of motion; the other tokens go to `other` or are an error.
  template <typename Other>
  Tracer::Target target(const std::vector<Token>& tokens, const Other& other) {
    start_block();
    Tracer::Target to{};
    for (const Token& token : tokens) {
      if (token.name == "M" && (token.value == 91 * nano || token.value == 92 * nano)) {
        is_machine_ = true;
      }
    }
    for (const Token& token : tokens) {
      if (!is_machine_ ? coordinate(token, to) : machine_coordinate(token)) continue;
      if (other(token) || common(token)) continue;
      Spot{spot_.line, token.text}.bad("is not understood here");
    }
    has_ended_ = ends_here_;
    return to;
  }

  bool machine_coordinate(const Token& token) {
    const std::size_t axis =
        token.name.size() == 1 ? axis_letters.find(token.name[0]) : axis_letters.npos;
    if (axis == axis_letters.npos) return false;
    tracer_.lose(axis);
    return true;
  }

  void line(const std::vector<Token>& tokens) {
    const bool goes_back = std::ranges::any_of(
        tokens, [](const Token& token) { return token.name == "M" && token.value == 140 * nano; });
    const Tracer::Target to = target(tokens, [&](const Token& token) {
      const bool turns = token.name == "A" || token.name == "B" || token.name == "C";
      return (turns && (is_machine_ || tracer_.is_lost())) ||
             (goes_back && (token.name == "MB" || token.name == "MAX"));
    });
    if (is_machine_) return;
    if (is_rapid_) return tracer_.rapid(to, spot_);
    if (to[0] || to[1] || to[2]) tracer_.feed(to, feed_ / 60, std::nullopt, spot_);
  }

  void centre(const std::vector<Token>& tokens) {
    start_block();
    Tracer::Target to{};
    for (const Token& token : tokens) {
      if (!coordinate(token, to)) Spot{spot_.line, token.text}.bad("is not understood here");
    }
    if (tokens.empty()) {
      // The centre is where the tool is, in the working plane of Z.
      to[0] = tracer_.at(0, spot_);
      to[1] = tracer_.at(1, spot_);
    }
    const int given = int(to[0].has_value()) + int(to[1].has_value()) + int(to[2].has_value());
    if (given != 2) spot_.bad("a centre has two coordinates");
    centre_ = to;
  }

  path::ArcPlane centre_plane() const {
    if (!centre_) spot_.bad("there is no centre CC before it");
    if (!(*centre_)[2]) return path::ArcPlane::XY;
    return (*centre_)[0] ? path::ArcPlane::ZX : path::ArcPlane::YZ;
  }

  std::optional<path::ArcSense> sense_;
  bool sense(const Token& token) {
    if (token.name != "DR" || token.sign == 0) return false;
    sense_ = token.sign == '+' ? path::ArcSense::CounterClockwise : path::ArcSense::Clockwise;
    return true;
  }

  void arc(const std::vector<Token>& tokens) {
    const path::ArcPlane plane = centre_plane();
    sense_.reset();
    const Tracer::Target to = target(tokens, [&](const Token& token) { return sense(token); });
    finish_arc(to, plane, centre_in(plane));
  }

  Eigen::Vector2d centre_in(path::ArcPlane plane) const {
    const auto [i, j, k] = path::axes_of(plane);
    return {real(*(*centre_)[static_cast<std::size_t>(i)]),
            real(*(*centre_)[static_cast<std::size_t>(j)])};
  }

  void finish_arc(const Tracer::Target& to, path::ArcPlane plane, const Eigen::Vector2d& centre) {
    if (!sense_) spot_.bad("has no sense DR+ or DR-");
    if (is_rapid_ || is_machine_) spot_.bad("an arc needs a feed and work coordinates");
    tracer_.feed(to, feed_ / 60, Tracer::ArcTarget{plane, *sense_, centre}, spot_);
  }

  /// CR X Y R DR: R below zero is the arc above half a turn. Plane by the coordinates.
  void radius_arc(const std::vector<Token>& tokens) {
    sense_.reset();
    std::optional<Nano> radius;
    const Tracer::Target to = target(tokens, [&](const Token& token) {
      if (token.name == "R" && token.value && *token.value != 0) radius = length_of(token);
      return (token.name == "R" && radius) || sense(token);
    });
    if (!radius || !sense_) spot_.bad("needs R and DR");
    path::ArcPlane plane = path::ArcPlane::XY;
    if (to[2]) plane = to[0] ? path::ArcPlane::ZX : path::ArcPlane::YZ;
    const auto [i, j, k] = path::axes_of(plane);
    if (to[static_cast<std::size_t>(k)]) spot_.bad("a circle has two coordinates");
    const auto ends = [&](int axis) {
      const Nano from = tracer_.at(static_cast<std::size_t>(axis), spot_);
      return std::array{real(from), real(to[static_cast<std::size_t>(axis)].value_or(from))};
    };
    const auto [from_1, to_1] = ends(i);
    const auto [from_2, to_2] = ends(j);
    finish_arc(to, plane, centre_of({from_1, from_2}, {to_1, to_2}, real(*radius), *sense_, spot_));
  }

  /// CP IPA Z DR: a turn of up to 360 degrees about CC, at the radius where it begins.
  void polar_arc(const std::vector<Token>& tokens) {
    const path::ArcPlane plane = centre_plane();
    sense_.reset();
    std::optional<Nano> turn;
    Tracer::Target to = target(tokens, [&](const Token& token) {
      if (token.name == "IPA" && token.value) turn = token.value;
      return token.name == "IPA" || sense(token);
    });
    if (!turn || !sense_) spot_.bad("needs IPA and DR");
    const bool is_positive = *sense_ == path::ArcSense::CounterClockwise;
    if (*turn == 0 || (*turn > 0) != is_positive) spot_.bad("the signs of IPA and DR differ");
    if (std::abs(*turn) > 360 * nano) spot_.unsupported("more than one turn is not read");
    const auto [i, j, k] = path::axes_of(plane);
    const auto first = static_cast<std::size_t>(i), second = static_cast<std::size_t>(j);
    if (to[first] || to[second]) spot_.bad("has coordinates in its plane");

    Eigen::Vector3d from = Eigen::Vector3d::Zero(), centre = from;
    const Eigen::Vector2d c = centre_in(plane);
    from[i] = real(tracer_.at(first, spot_));
    from[j] = real(tracer_.at(second, spot_));
    centre[i] = c.x();
    centre[j] = c.y();
    const Eigen::Vector3d end = polar_end(from, centre, plane, *turn, 0);
    to[first] = std::llround(end[i] * static_cast<double>(nano));
    to[second] = std::llround(end[j] * static_cast<double>(nano));
    finish_arc(to, plane, c);
  }

  std::string_view rest_;
  Tracer tracer_;
  Spot spot_;
  int number_ = 0;
  bool has_ended_ = false;
  bool is_inch_ = false;
  double feed_ = 0;                       ///< [mm/min]
  std::optional<Tracer::Target> centre_;  ///< CC: two of the three

  // Of the block.
  bool is_rapid_ = false, is_machine_ = false, ends_here_ = false;
};

}  // namespace

Reading read_klartext(std::string_view text, const ReadOptions& options, const Progress& progress) {
  return KlartextReader(text, options).run(progress);
}

}  // namespace ridgeline::nc
