// LinuxCNC's interpreter beside ours: the part of Custom Macro B that its dialect can express, and
// random motion that both read as it is.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <regex>
#include <sstream>

#include "core/macro/interpreter.hpp"
#include "tests/core/macro/plain_moves.hpp"

namespace ridgeline::macro {
namespace {

using Eigen::Vector3d;

/// LinuxCNC wants expressions in brackets.
std::string bracketed(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (!assignment.starts_with('#') || equals == std::string::npos) return assignment;
  return assignment.substr(0, equals + 1) + "[" + assignment.substr(equals + 1) + "]";
}

/// Custom Macro B without jumps, in LinuxCNC's dialect: loops and conditions become o-words, a call
/// its arguments and the called text.
class Translator {
public:
  std::string run(const std::string& text) {
    std::istringstream lines(text);
    static const std::regex head(R"(O(\d+).*)");
    std::string number;
    for (std::string line; std::getline(lines, line);) {
      if (line.ends_with('\r')) line.pop_back();
      std::smatch match;
      if (std::regex_match(line, match, head))
        number = match[1];
      else if (line != "%" && !line.empty())
        programs_[number].push_back(line);
      if (main_.empty()) main_ = number;
    }
    translate(main_);
    for (int v = 100; v <= 140; ++v)
      out_ += "(debug,V" + std::to_string(v) + "=#" + std::to_string(v) + ")\n";
    return out_ + "M2\n";
  }

private:
  void translate(const std::string& number) {
    static const std::regex loop(R"(WHILE\[(.*)\]DO\d)"), end(R"(END\d)"),
        then(R"(IF\[(.*)\]THEN (.*))"), call(R"(G65 P(\d+)(.*))"), alarm(R"(#3000=.*)"),
        argument(R"(([A-Z])(-?[\d.]+))");
    for (const std::string& line : programs_.at(number)) {
      std::smatch match;
      if (std::regex_match(line, match, loop)) {
        open_.push_back(++label_);
        out_ += "o" + std::to_string(label_) + " while [" + match.str(1) + "]\n";
      } else if (std::regex_match(line, end)) {
        out_ += "o" + std::to_string(open_.back()) + " endwhile\n";
        open_.pop_back();
      } else if (std::regex_match(line, match, then)) {
        const std::string label = "o" + std::to_string(++label_);
        const std::string consequence = match.str(2);
        out_ += label + " if [" + match.str(1) + "]\n";
        out_ += (std::regex_match(consequence, alarm) ? "(abort,alarm)" : bracketed(consequence)) +
                "\n";
        out_ += label + " endif\n";
      } else if (std::regex_match(line, match, call)) {
        const std::string arguments = match.str(2);
        static const std::string letters = "ABCIJKDEFxHxMxxxQRSTUVWXYZ";  // #1.. by their places
        for (std::sregex_iterator at(arguments.begin(), arguments.end(), argument), none;
             at != none; ++at) {
          out_ += "#" + std::to_string(letters.find((*at)[1].str()) + 1) + "=" + (*at)[2].str();
          out_ += "\n";
        }
        const std::string called = match.str(1);
        translate(called);
      } else if (line != "M30" && line != "M99") {
        out_ += bracketed(line) + "\n";
      }
    }
  }

  std::map<std::string, std::vector<std::string>> programs_;
  std::string main_, out_;
  std::vector<int> open_;
  int label_ = 100;
};

TEST(LinuxCnc, OracleProgramsInItsDialectGiveTheSame) {
  int compared = 0;
  for (const char* name : {"09_while_nest3", "29_maclaurin_sin", "33_hole_edge_newton"}) {
    SCOPED_TRACE(name);
    std::ifstream file(std::string(RIDGELINE_TESTS) + "/oracle/macro/" + name + ".nc");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const Result ours = run(text);
    ASSERT_FALSE(ours.alarm);
    const std::string translated = Translator().run(text);
    const nc::CanonRun theirs = nc::run_rs274(translated);
    ASSERT_EQ(theirs.exit_code, 0) << translated << theirs.output;
    expect_same(moves_of(ours), moves_of(theirs), 0.0011);  // ours are rounded to 0.001
    static const std::regex variable(R"(V(\d+)=(-?[\d.]+))");
    for (std::sregex_iterator at(theirs.output.begin(), theirs.output.end(), variable), none;
         at != none; ++at) {
      const auto found = ours.variables.find(std::stoi((*at)[1].str()));
      if (found == ours.variables.end()) continue;
      EXPECT_NEAR(found->second.number, std::stod((*at)[2].str()), 1e-6) << (*at)[1];
      ++compared;
    }
  }
  EXPECT_GE(compared, 12);
}

/// Random expressions of what both dialects write and mean the same way.
class Expressions {
public:
  explicit Expressions(unsigned seed) : random_(seed) {}
  std::string value(int depth) {
    if (depth == 0) return literal();
    switch (pick(12)) {
      case 0: return "SIN[" + value(depth - 1) + "]";
      case 1: return "COS[" + value(depth - 1) + "]";
      case 2: return "SQRT[ABS[" + value(depth - 2 > 0 ? depth - 2 : 0) + "]]";
      case 3: return "ABS[" + value(depth - 1) + "]";
      case 4: return "ROUND[" + value(depth - 1) + "]";
      case 5: return "EXP[SIN[" + value(depth - 2 > 0 ? depth - 2 : 0) + "]]";
      case 6: return "[" + value(depth - 1) + "]/[2.5+ABS[" + literal() + "]]";
      case 7:
        return "ATAN[ABS[" + literal() + "]+1]/[" + literal() + "]";  // upper half: same range
      case 8: return "[" + value(depth - 1) + "-" + literal() + "*" + literal() + "]";
      case 9: return literal() + "+" + literal() + "*" + literal() + "-" + literal() + "/4";
      case 10: return literal() + "-" + literal() + "-" + literal() + "/7/3*" + literal();
      default: return "#" + std::to_string(1 + pick(4)) + "*" + literal();
    }
  }

private:
  std::size_t pick(std::size_t n) { return random_() % n; }
  std::string literal() {
    const auto thousandths = static_cast<int>(pick(20000));
    std::ostringstream text;
    text << thousandths / 1000 << "."
         << std::string(thousandths % 1000 < 10    ? "00"
                        : thousandths % 1000 < 100 ? "0"
                                                   : "")
         << thousandths % 1000;
    return text.str();
  }
  std::mt19937 random_;
};

TEST(LinuxCnc, RandomExpressionsHaveTheSameValue) {
  Expressions expressions(77);
  std::string program = "#1=1.25\n#2=-3.5\n#3=0.001\n#4=17\n";
  constexpr int count = 400;
  for (int i = 0; i < count; ++i) {
    program += "#" + std::to_string(500 + i) + "=" + expressions.value(3) + "\n";
  }
  const Result ours = run(program);
  ASSERT_FALSE(ours.alarm) << ours.alarm->message << " line " << ours.alarm->line << "\n"
                           << program;
  std::string theirs_text;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);) theirs_text += bracketed(line) + "\n";
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(500 + i);
    theirs_text += "(debug,V" + number + "=#" + number + ")\n";
  }
  const nc::CanonRun theirs = nc::run_rs274(theirs_text + "M2\n");
  ASSERT_EQ(theirs.exit_code, 0) << theirs.output.substr(0, 2000);
  static const std::regex variable(R"(V(\d+)=(-?[\d.]+))");
  int compared = 0;
  for (std::sregex_iterator at(theirs.output.begin(), theirs.output.end(), variable), none;
       at != none; ++at, ++compared) {
    const double value = std::stod((*at)[2].str());
    const double own = ours.variables.at(std::stoi((*at)[1].str())).number;
    // Its ROUND and its quotients take what is within 1e-4 of zero as zero.
    const double slack = value == 0 ? 1e-4 : 1e-6 + 1e-9 * std::abs(value);
    EXPECT_NEAR(own, value, slack) << (*at)[1];
  }
  EXPECT_EQ(compared, count);
}

std::string number(double value) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(3);
  text << value;
  return text.str();
}

/// Random motion blocks that mean the same in both.
class Motions {
public:
  explicit Motions(unsigned seed) : random_(seed) {}
  std::string program(int blocks) {
    std::string text = "G21 G90 G17 G54 G94\nG00 X0. Y0. Z0.\nG01 F500.\n";
    for (int i = 0; i < blocks; ++i) text += block() + "\n";
    return text;
  }

private:
  double uniform(double low, double high) {
    return std::round((low + (high - low) * (static_cast<double>(random_()) / 4294967296.0)) *
                      1000) /
           1000;
  }
  std::string block() {
    switch (random_() % 6) {
      case 0: return straight("G00");
      case 1: return straight("G01");
      case 2: return straight("G01");
      case 3: return radius_arc();
      default: return centre_arc();
    }
  }
  std::string straight(const std::string& code) {
    std::string words = code;
    const bool is_incremental = random_() % 4 == 0;
    if (is_incremental) words = "G91 " + words;
    for (int axis = 0; axis < 3; ++axis) {
      if (random_() % 3 == 0) continue;
      const double to = uniform(-50, 50);
      words += std::string(" ") + "XYZ"[axis] + number(is_incremental ? to - at_[axis] : to);
      at_[axis] = to;
    }
    if (code == "G01" && random_() % 3 == 0) words += " F" + number(uniform(10, 2000));
    return words + (is_incremental ? "\nG90" : "");
  }
  void choose_plane() {
    plane_ = static_cast<int>(random_() % 3);  // G17 XY, G18 ZX, G19 YZ
    first_ = plane_ == 0 ? 0 : plane_ == 1 ? 2 : 1;
    second_ = (first_ + 1) % 3;
    third_ = (first_ + 2) % 3;
  }
  std::string head() {
    return "G1" + std::to_string(7 + plane_) + (random_() % 2 == 0 ? " G02" : " G03");
  }
  std::string end_words(double u, double v) {
    at_[first_] = u;
    at_[second_] = v;
    std::string words;
    words += std::string(" ") + "XYZ"[first_] + number(u) + " " + "XYZ"[second_] + number(v);
    if (random_() % 3 == 0) {
      at_[third_] = uniform(-50, 50);
      words += std::string(" ") + "XYZ"[third_] + number(at_[third_]);
    }
    return words;
  }
  std::string centre_arc() {
    choose_plane();
    const double i = uniform(-30, 30), j = uniform(-30, 30);
    const double radius = std::hypot(i, j);
    if (radius < 1) return straight("G01");
    const std::string centre =
        std::string(" ") + "IJK"[first_] + number(i) + " " + "IJK"[second_] + number(j);
    if (random_() % 6 == 0) return head() + centre;  // full circle
    const double angle = uniform(0, 6.28);
    const double u = at_[first_] + i + radius * std::cos(angle);
    const double v = at_[second_] + j + radius * std::sin(angle);
    const double ru = std::round(u * 1000) / 1000, rv = std::round(v * 1000) / 1000;
    if (std::hypot(ru - at_[first_], rv - at_[second_]) < 0.5) return straight("G01");
    const std::string begin = head();
    return begin + end_words(ru, rv) + centre;
  }
  std::string radius_arc() {
    choose_plane();
    const double u = uniform(-50, 50), v = uniform(-50, 50);
    const double chord = std::hypot(u - at_[first_], v - at_[second_]);
    if (chord < 1) return straight("G01");
    const double radius = std::ceil(chord / 2 * 1.05 * 1000) / 1000 + uniform(0, 30);
    const std::string begin = head();
    return begin + end_words(u, v) + " R" + number(random_() % 2 == 0 ? radius : -radius);
  }

  std::mt19937 random_;
  Vector3d at_ = Vector3d::Zero();
  int plane_ = 0, first_ = 0, second_ = 1, third_ = 2;
};

TEST(LinuxCnc, RandomMotionInAllPlanesIsTheSame) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    SCOPED_TRACE(seed);
    const std::string program = Motions(seed).program(400);
    Options options;
    options.profile.arc_tolerance = 0.05;
    const Result ours = run(program + "M30\n", options);
    ASSERT_FALSE(ours.alarm) << ours.alarm->message << " line " << ours.alarm->line << "\n"
                             << program;
    const nc::CanonRun theirs = nc::run_rs274(program + "M2\n");
    ASSERT_EQ(theirs.exit_code, 0) << theirs.output.substr(0, 3000);
    const std::vector<Plain> moves = moves_of(ours);
    EXPECT_GT(moves.size(), 350U);
    ASSERT_NO_FATAL_FAILURE(expect_same(moves, moves_of(theirs), 6e-4));
  }
}

}  // namespace
}  // namespace ridgeline::macro
