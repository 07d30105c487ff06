#include "core/nc/expand.hpp"

#include <algorithm>
#include <array>

#include "core/base/error.hpp"
#include "core/nc/g_code_block.hpp"

namespace ridgeline::nc {
namespace {

constexpr int most_repeats = 100;
constexpr std::string_view never_arguments = "GLNOP";

/// A word as it stands in a line; `value` is absent for variables and expressions.
struct RawWord {
  char letter = 0;
  std::optional<Nano> value;
  std::string_view text;
  std::size_t begin = 0, end = 0;
};

/// The words of a line outside comments. Never fails: what is no word is passed over, because all
/// but the bound calls stays as it is.
std::vector<RawWord> words_of(std::string_view line) {
  std::vector<RawWord> words;
  std::size_t at = 0;
  while (at < line.size()) {
    const char c = line[at];
    if (c == ';') break;
    if (c == '(') {
      const std::size_t end = line.find(')', at);
      if (end == line.npos) break;
      at = end + 1;
      continue;
    }
    if (!is_letter(c)) {
      ++at;
      continue;
    }
    RawWord word;
    word.letter = upper_case(c);
    word.begin = at;
    std::string_view rest = line.substr(at + 1);
    while (rest.starts_with(' ') || rest.starts_with('\t')) rest.remove_prefix(1);
    word.value = take_number(rest);
    // After a variable or an expression the word goes on to the next blank.
    if (!word.value) {
      while (!rest.empty() && !is_letter(rest[0]) && rest[0] != ' ' && rest[0] != '(' &&
             rest[0] != '\r') {
        rest.remove_prefix(1);
      }
    }
    word.end = at = line.size() - rest.size();
    word.text = line.substr(word.begin, word.end - word.begin);
    words.push_back(word);
  }
  return words;
}

/// The comments between two places of a line, as written.
std::string comments_in(std::string_view text) {
  std::string comments;
  for (std::size_t open = text.find('('); open != text.npos; open = text.find('(')) {
    const std::size_t close = text.find(')', open);
    comments += text.substr(open, close - open + 1);
    comments += ' ';
    text.remove_prefix(close + 1);
  }
  return comments;
}

bool is_code(const RawWord& word, char letter, int number) {
  return word.letter == letter && word.value == number * nano;
}

void follow(Modes& modes, std::string_view line) {
  for (const RawWord& word : words_of(line)) {
    if (word.letter == 'F' && word.value) modes.feed = word.text;
    if (word.letter != 'G' || !word.value) continue;
    const Nano code = *word.value;
    const std::string name = "G" + std::to_string(code / nano);
    if (code % nano != 0) continue;
    if (code <= 3 * nano) modes.motion = name;
    if (code >= 17 * nano && code <= 19 * nano) modes.plane = name;
    if (code == 20 * nano || code == 21 * nano) modes.units = name;
    if (code == 90 * nano || code == 91 * nano) modes.positioning = name;
  }
}

/// One block that sets back what the motion changed; empty when nothing is to do. A mode that the
/// program had not said is the control's default, which cannot be known: it stays.
std::string restoring_block(const Modes& before, const Modes& after) {
  std::string block;
  const auto set_back = [&](const std::string& was, const std::string& is) {
    if (was.empty() || was == is) return;
    if (!block.empty()) block += ' ';
    block += was;
  };
  set_back(before.units, after.units);
  set_back(before.positioning, after.positioning);
  set_back(before.plane, after.plane);
  // G2 or G3 alone would be an arc without a centre: the program's next arc says it again.
  if (before.motion == "G0" || before.motion == "G1") set_back(before.motion, after.motion);
  set_back(before.feed, after.feed);
  return block;
}

class Expander {
public:
  Expander(const Binding& binding, const std::function<std::string(const Call&)>& motion)
      : binding_(binding), motion_(motion) {}

  std::string run(std::string_view program, const Progress& progress) {
    std::string text;
    int number = 0;
    const std::size_t size = program.size();
    while (!program.empty()) {
      if (number % 1024 == 0) progress.at(read_share(program, size), "reading");
      const std::size_t end = program.find('\n');
      const std::string_view line = program.substr(0, end == program.npos ? end : end + 1);
      program.remove_prefix(line.size());
      text += expanded(line, ++number);
    }
    return text;
  }

private:
  const BoundMacro* bound(const std::vector<RawWord>& words) const {
    for (const RawWord& word : words) {
      if (word.letter != 'P' || !word.value) continue;
      const auto found = std::ranges::find_if(
          binding_, [&](const BoundMacro& macro) { return word.value == macro.number * nano; });
      if (found != binding_.end()) return &*found;
    }
    return nullptr;
  }

  std::string expanded(std::string_view line, int number) {
    const std::vector<RawWord> words = words_of(line);
    const auto call = std::ranges::find_if(
        words, [](const RawWord& w) { return is_code(w, 'G', 65) || is_code(w, 'G', 66); });
    const BoundMacro* macro = call == words.end() ? nullptr : bound(words);
    if (macro == nullptr) {
      follow(modes_, line);
      return std::string(line);
    }
    const Spot spot{number, std::string(call->text)};
    if (is_code(*call, 'G', 66)) spot.unsupported("a modal call of a bound macro is not expanded");
    if (trimmed(line).starts_with('/')) spot.unsupported("a call in an optional block");
    const std::vector<RawWord> before(words.begin(), call), after(call + 1, words.end());
    for (const RawWord& word : before) {
      if (word.letter != 'N' || !word.value) {
        Spot{number, std::string(word.text)}.bad("stands before a macro call");
      }
    }
    int repeats = 1;
    Call asked = call_of(*macro, after, number, repeats);
    const std::size_t end = after.back().end;
    asked.text = line.substr(call->begin, end - call->begin);
    return std::string(line.substr(0, call->begin)) + comments_in(asked.text) +
           replacement(asked, repeats, line.ends_with("\r\n")) + std::string(line.substr(end));
  }

  Call call_of(const BoundMacro& macro, const std::vector<RawWord>& words, int line,
               int& repeats) const {
    Call call;
    call.macro = macro.number;
    call.line = line;
    call.modes = modes_;
    std::string seen;
    for (const RawWord& word : words) {
      const Spot spot{line, std::string(word.text)};
      if (!word.value) spot.bad("is not a number: variables and expressions are the control's");
      if (seen.find(word.letter) != seen.npos) spot.bad("a second value of its letter");
      seen += word.letter;
      if (word.letter == 'P') continue;
      if (word.letter == 'L') {
        if (*word.value % nano != 0 || *word.value < nano) spot.bad("is not a number of times");
        if (*word.value > most_repeats * nano) spot.unsupported("more than 100 times");
        repeats = static_cast<int>(*word.value / nano);
        continue;
      }
      const auto letter = std::ranges::find(macro.letters, word.letter, &BoundLetter::letter);
      if (letter == macro.letters.end()) {
        spot.bad("has no meaning in the binding of macro " + std::to_string(macro.number));
      }
      call.arguments.push_back({word.letter, letter->meaning, real(*word.value),
                                word.text.find('.') != word.text.npos, std::string(word.text)});
    }
    return call;
  }

  /// Motion, as often as asked, and what sets the modes back; no line end behind the last line.
  std::string replacement(const Call& call, int repeats, bool has_carriage_return) {
    std::string motion = motion_(call);
    while (motion.ends_with('\n')) motion.pop_back();
    std::string text;
    for (int n = 0; n < repeats; ++n) text += (n == 0 ? "" : "\n") + motion;
    Modes after = modes_;
    std::string_view rest = text;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      follow(after, rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    const std::string back = restoring_block(modes_, after);
    modes_ = after;
    follow(modes_, back);
    if (!back.empty()) text += (text.empty() ? "" : "\n") + back;
    if (!has_carriage_return) return text;
    std::string with_returns;
    for (const char c : text) {
      if (c == '\n') with_returns += '\r';
      with_returns += c;
    }
    return with_returns;
  }

  const Binding& binding_;
  const std::function<std::string(const Call&)>& motion_;
  Modes modes_;
};

void check(const Binding& binding) {
  for (const BoundMacro& macro : binding) {
    const std::string name = "macro " + std::to_string(macro.number);
    if (macro.number < 1 || macro.number > 99'999'999) {
      throw Error(ErrorCode::BadInput, name + ": the number must be 1 to 99999999");
    }
    std::string seen;
    for (const BoundLetter& letter : macro.letters) {
      const bool is_argument = letter.letter >= 'A' && letter.letter <= 'Z' &&
                               never_arguments.find(letter.letter) == never_arguments.npos;
      if (!is_argument || seen.find(letter.letter) != seen.npos) {
        throw Error(ErrorCode::BadInput,
                    name + ": letter " + letter.letter +
                        (is_argument ? " is bound twice" : " cannot be an argument of G65"));
      }
      seen += letter.letter;
    }
  }
}

}  // namespace

Binding default_binding() {
  return {{9100,
           {{'W', "workpiece"},
            {'H', "hole"},
            {'T', "tool"},
            {'Q', "cutting_amount"},
            {'V', "width"},
            {'E', "edge"},
            {'S', "side"},
            {'I', "inner_radius"},
            {'J', "outer_radius"},
            {'K', "length"},
            {'R', "hole_radius"},
            {'U', "eccentric_distance"},
            {'A', "arrangement_angle"},
            {'B', "penetration_angle"},
            {'X', "position_x"},
            {'Y', "position_y"},
            {'Z', "position_z"},
            {'C', "tolerance"},
            {'D', "tool_radius"},
            {'F', "feed"},
            {'M', "spindle_speed"}}}};
}

std::string expand(std::string_view program, const Binding& binding,
                   const std::function<std::string(const Call&)>& motion,
                   const Progress& progress) {
  check(binding);
  return Expander(binding, motion).run(program, progress);
}

}  // namespace ridgeline::nc
