#include "core/nc/text.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ridgeline::nc {
namespace {

constexpr std::size_t comment_width = 60;
constexpr int largest_block_number = 99999;  // five digits on FANUC and LinuxCNC

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

/// Spelling of what machinists write beside ASCII.
std::string_view spelling(char32_t code) {
  static constexpr std::array<std::pair<char32_t, std::string_view>, 24> table{{
      {U'\u00B0', "deg"},   {U'\u00B1', "+-"}, {U'\u00B2', "2"},  {U'\u00B3', "3"},
      {U'\u00B5', "u"},     {U'\u00C4', "Ae"}, {U'\u00C9', "E"},  {U'\u00D6', "Oe"},
      {U'\u00D7', "x"},     {U'\u00D8', "D"},  {U'\u00DC', "Ue"}, {U'\u00DF', "ss"},
      {U'\u00E4', "ae"},    {U'\u00E8', "e"},  {U'\u00E9', "e"},  {U'\u00F6', "oe"},
      {U'\u00F8', "d"},     {U'\u00FC', "ue"}, {U'\u03BC', "u"},  {U'\u03C6', "phi"},
      {U'\u03B4', "delta"}, {U'\u2013', "-"},  {U'\u2014', "-"},  {U'\u2300', "D"},
  }};
  const auto* found = std::ranges::find(table, code, &std::pair<char32_t, std::string_view>::first);
  return found == table.end() ? "?" : found->second;
}

/// UTF-8 to ASCII; a byte that is not UTF-8 becomes ?, a control character a blank.
std::string ascii(std::string_view text) {
  std::string out;
  for (std::size_t n = 0; n < text.size();) {
    const auto byte = static_cast<unsigned char>(text[n]);
    if (byte < 0x80) {
      out += byte < 0x20 || byte == 0x7F ? ' ' : text[n];
      ++n;
      continue;
    }
    const std::size_t length = byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : byte >= 0xC2 ? 2 : 1;
    char32_t code = length == 1 ? 0 : byte & (0x7FU >> length);
    std::size_t used = 1;
    while (used < length && n + used < text.size()) {
      const auto next = static_cast<unsigned char>(text[n + used]);
      if ((next & 0xC0U) != 0x80U) break;
      code = (code << 6U) | (next & 0x3FU);
      ++used;
    }
    out += used == length ? spelling(code) : "?";
    n += used;
  }
  return out;
}

char allowed(char c, Dialect dialect) {
  if (dialect == Dialect::Heidenhain) return c == '~' ? '-' : c;  // ~ at an end joins two lines
  if (dialect == Dialect::Siemens) return c;
  if (c == '(' || c == '{') return '[';
  if (c == ')' || c == '}') return ']';
  if (dialect == Dialect::LinuxCnc) return c;
  if (c == ';') return ',';  // end of block in ISO code
  if (c == '"') return '\'';
  c = upper(c);
  constexpr std::string_view also = " .,+-*/=:#[]<>?!&@_$'";
  const bool known = is_letter(c) || (c >= '0' && c <= '9') || also.find(c) != also.npos;
  return known ? c : '?';  // % would end the tape
}

/// LinuxCNC acts on comments that begin with these words: (MSG, ...), (PROBEOPEN file) ...
bool is_active(std::string_view line) {
  static constexpr std::array<std::string_view, 14> words{
      "MSG",       "DEBUG",      "PRINT", "LOG",  "LOGOPEN", "LOGAPPEND", "LOGCLOSE",
      "PROBEOPEN", "PROBECLOSE", "ABORT", "AXIS", "PREVIEW", "PY",        "PYRUN"};
  const std::size_t end =
      static_cast<std::size_t>(std::ranges::find_if_not(line, is_letter) - line.begin());
  std::string word(line.substr(0, end));
  std::ranges::transform(word, word.begin(), upper);
  return std::ranges::find(words, word) != words.end();
}

}  // namespace

std::string decimal(std::int64_t value, int decimals, NumberStyle style) {
  const bool negative = value < 0;
  const std::int64_t magnitude = negative ? -value : value;
  const std::int64_t scale = power_of_ten(decimals);
  std::string fraction = std::to_string(magnitude % scale + scale).substr(1);
  fraction.erase(fraction.find_last_not_of('0') + 1);

  std::string text = negative ? "-" : style == NumberStyle::Signed ? "+" : "";
  text += std::to_string(magnitude / scale);
  if (!fraction.empty() || style == NumberStyle::Point) text += '.';
  return text + fraction;
}

std::vector<std::string> comment_lines(const std::vector<std::string>& comments, Dialect dialect) {
  std::vector<std::string> lines;
  for (const std::string& comment : comments) {
    std::string rest = ascii(comment);
    std::ranges::transform(rest, rest.begin(), [&](char c) { return allowed(c, dialect); });
    do {
      rest.erase(0, rest.find_first_not_of(' '));
      std::string line = rest.substr(0, comment_width);
      if (rest.size() > comment_width) {
        const std::size_t blank = rest.rfind(' ', comment_width);
        if (blank != rest.npos && blank > 0) line = rest.substr(0, blank);
      }
      rest.erase(0, line.size());
      line.erase(line.find_last_not_of(' ') + 1);
      if (dialect == Dialect::LinuxCnc && is_active(line)) line.insert(0, "- ");
      if (!line.empty()) lines.push_back(line);
    } while (!rest.empty());
  }
  return lines;
}

void Blocks::line(std::string_view text) {
  text_ += text;
  text_ += '\n';
}

void Blocks::block(std::string_view text) {
  if (next_) {
    text_ += prefix_;
    text_ += std::to_string(*next_);
    text_ += ' ';
    *next_ = *next_ > largest_block_number - step_ ? first_ : *next_ + step_;
  }
  line(text);
}

}  // namespace ridgeline::nc
