#include "core/nc/g_code_block.hpp"

#include <algorithm>

namespace ridgeline::nc {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

class Lexer {
public:
  Lexer(std::string_view line, int number, Dialect dialect)
      : rest_(line), dialect_(dialect), block_{{number, std::string(trimmed(line))}, {}, {}} {}

  Block run() {
    for (skip_blanks(); !rest_.empty(); skip_blanks()) {
      if (rest_[0] == ';') break;
      if (rest_[0] == '(' && dialect_ != Dialect::Siemens) {
        comment();
      } else if (dialect_ == Dialect::Siemens && is_name()) {
        name();
      } else if (is_letter(rest_[0])) {
        word();
      } else {
        fail(1, reason(rest_[0]));
      }
    }
    return std::move(block_);
  }

private:
  void skip_blanks() {
    while (!rest_.empty() && is_blank(rest_[0])) rest_.remove_prefix(1);
  }

  [[noreturn]] void fail(std::size_t length, const std::string& why) const {
    Spot{block_.spot.line, std::string(rest_.substr(0, length))}.bad(why);
  }

  static std::string reason(char c) {
    if (c == '#' || c == '[') return "variables and expressions are for `ridgeline macro run`";
    if (c == '/') return "an optional block may run or not";
    return "is not a word of a program";
  }

  void comment() {
    const std::size_t end = rest_.find(')');
    if (end == rest_.npos) fail(rest_.size(), "the comment has no end");
    rest_.remove_prefix(end + 1);
  }

  /// Two letters in a row, or $: not a word with a number.
  bool is_name() const {
    if (rest_[0] == '$') return true;
    return rest_.size() > 1 && is_letter(rest_[0]) && (is_letter(rest_[1]) || rest_[1] == '_');
  }

  void name() {
    const std::string_view all = rest_;
    const auto is_part = [](char c) { return is_letter(c) || is_digit(c) || c == '_' || c == '$'; };
    Name name;
    while (!rest_.empty() && is_part(rest_[0])) {
      name.name += upper_case(rest_[0]);
      rest_.remove_prefix(1);
    }
    skip_blanks();
    if (rest_.starts_with('(')) {
      const std::size_t end = rest_.find(')');
      if (end == rest_.npos) fail(rest_.size(), "the bracket has no end");
      name.arguments = rest_.substr(1, end - 1);
      rest_.remove_prefix(end + 1);
    } else if (rest_.starts_with('=')) {
      rest_.remove_prefix(1);
      skip_blanks();
      while (!rest_.empty() && !is_blank(rest_[0]) && rest_[0] != ';') {
        name.arguments += rest_[0];
        rest_.remove_prefix(1);
      }
    }
    name.text = trimmed(all.substr(0, all.size() - rest_.size()));
    block_.names.push_back(name);
  }

  void word() {
    const std::string_view all = rest_;
    Word word;
    word.letter = upper_case(rest_[0]);
    rest_.remove_prefix(1);
    skip_blanks();
    if (dialect_ == Dialect::Siemens) equals(word.letter);
    const std::optional<Nano> value = take_number(rest_);
    if (!value) {
      const std::string why = rest_.empty() ? "has no number" : reason(rest_[0]);
      const std::size_t used = all.size() - rest_.size();
      rest_ = all;
      fail(used + 1, why == reason(' ') ? "has no number" : why);
    }
    word.value = *value;
    word.text = all.substr(0, all.size() - rest_.size());
    block_.words.push_back(word);
  }

  /// X=5; of machine axes and spindles with their number, Z1=0, S1=500.
  void equals(char letter) {
    std::string_view after = rest_;
    const bool has_number = std::string_view("XYZSM").find(letter) != std::string_view::npos;
    while (has_number && !after.empty() && is_digit(after[0])) after.remove_prefix(1);
    if (!after.starts_with('=')) return;
    rest_ = after.substr(1);
    skip_blanks();
  }

  std::string_view rest_;
  Dialect dialect_;
  Block block_;
};

}  // namespace

char upper_case(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

bool is_letter(char c) {
  return upper_case(c) >= 'A' && upper_case(c) <= 'Z';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string> pieces(std::string_view text) {
  std::vector<std::string> found;
  for (std::size_t comma = text.find(','); comma != text.npos; comma = text.find(',')) {
    found.emplace_back(trimmed(text.substr(0, comma)));
    text.remove_prefix(comma + 1);
  }
  found.emplace_back(trimmed(text));
  return found;
}

Word* Block::use(char letter) {
  Word* found = nullptr;
  for (Word& word : words) {
    if (word.letter != letter) continue;
    if (found != nullptr) {
      Spot{spot.line, word.text}.bad(std::string("a second ") + letter + " in one block");
    }
    found = &word;
  }
  if (found == nullptr || found->used) return nullptr;
  found->used = true;
  return found;
}

bool Block::has(char letter) const {
  return std::ranges::find(words, letter, &Word::letter) != words.end();
}

Block block_of(std::string_view line, int number, Dialect dialect) {
  return Lexer(line, number, dialect).run();
}

}  // namespace ridgeline::nc
