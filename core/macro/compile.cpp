#include <algorithm>
#include <utility>

#include "core/macro/block_parser.hpp"
#include "core/macro/line_reader.hpp"
#include "core/macro/loops.hpp"
#include "core/macro/program.hpp"

namespace ridgeline::macro {

namespace {

char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

// A file from a control whose blocks end with CR alone.
std::string with_line_ends(std::string text) {
  if (text.find('\n') == std::string::npos) std::ranges::replace(text, '\r', '\n');
  return text;
}

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\0' || c == '\v' || c == '\f';
}

// Where the blocks of a text begin: the leader of a tape, before its first %, is not read. It is
// one when a program head follows the % and none stands before it, nor the end of a program.
std::size_t begin_of(const std::string& text) {
  const std::size_t begin = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  const auto is_head = [&](std::size_t at) {
    if (at + 1 >= text.size()) return false;
    const char next = text[at + 1];
    const bool has_number = upper(text[at]) == 'O' || text[at] == ':';
    return text[at] == '<' || (has_number && (is_digit(next) || next == '<'));
  };
  bool begins_line = true;
  for (std::size_t at = begin; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\n') begins_line = true;
    if (is_blank(c) || c == '\n' || c == '/') continue;
    if (begins_line && c == '%') {
      std::size_t next = at;
      while (next < text.size() && (is_blank(text[next]) || text[next] == '%' ||
                                    text[next] == ';' || text[next] == '\n')) {
        ++next;
      }
      return is_head(next) ? at : begin;
    }
    if (begins_line && is_head(at)) return begin;
    begins_line = false;
    if (upper(c) != 'M') continue;
    const std::string_view code = std::string_view(text).substr(at + 1, 2);
    if (code == "30" || code == "99" || code == "02") return begin;
  }
  return begin;
}

/// Splits a text into programs and blocks.
class TextCompiler {
public:
  TextCompiler(std::string text, const Profile& profile)
      : source_(std::make_shared<const std::string>(with_line_ends(std::move(text)))),
        profile_(profile) {
    open_program(0, 1);
    // Room for a long main program, so that it is not copied while it grows.
    const auto lines = std::count(source_->begin(), source_->end(), '\n');
    programs_.back().blocks.reserve(static_cast<std::size_t>(lines) + 1);
    programs_.back().words.reserve(source_->size() / 5);
  }

  std::vector<Program> run() {
    const std::string& text = *source_;
    std::size_t at = begin_of(text);
    const auto skipped = std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
    for (auto line = static_cast<std::uint32_t>(skipped + 1); at < text.size(); ++line) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      split_line(at, end, line);
      at = end + 1;
    }
    close_program();
    if (programs_.size() > 1 && programs_.front().blocks.empty() && programs_.front().number == 0 &&
        programs_.front().name.empty()) {
      programs_.erase(programs_.begin());
    }
    return std::move(programs_);
  }

private:
  void open_program(int number, int line) {
    programs_.emplace_back();
    programs_.back().number = number;
    programs_.back().line = line;
    programs_.back().source = source_;
  }

  void close_program() {
    Program& program = programs_.back();
    pair_loops(program);
    for (std::size_t i = 0; i < program.blocks.size(); ++i) {
      const std::int32_t label = program.blocks[i].label;
      if (label >= 0) program.labels.push_back({label, static_cast<std::int32_t>(i)});
    }
    std::stable_sort(program.labels.begin(), program.labels.end(),
                     [](const Label& a, const Label& b) { return a.number < b.number; });
    resolve_jumps(program);
  }

  static void resolve_jumps(Program& program) {
    for (std::size_t i = 0; i < program.blocks.size(); ++i) {
      Block& block = program.blocks[i];
      const bool is_jump = block.kind == BlockKind::Goto || block.kind == BlockKind::IfGoto;
      if (!is_jump || block.goto_code >= 0) continue;
      block.variable = block.target;  // the N number, for the alarm and for check()
      block.target = goto_target(program, block.target, static_cast<std::int32_t>(i));
    }
  }

  // Comments go, ';' ends a block; a comment after ';' as other interpreters write it is dropped.
  void split_line(std::size_t begin, std::size_t end, std::uint32_t line) {
    const std::string& text = *source_;
    Block block;
    block.line = line;
    block.text = static_cast<std::uint32_t>(begin);
    reader_.clear();
    bool in_comment = false, any = false;
    for (std::size_t i = begin; i < end; ++i) {
      const char c = text[i];
      if (in_comment) {
        in_comment = c != ')';
        continue;
      }
      if (c == '(') {
        in_comment = true;
      } else if (c == ';') {
        add_block(block);
        any = true;
        reader_.clear();
        if (!starts_block(text, i + 1, end)) return;
      } else if (c == '%' && !reader_.at_end() && reader_.peek() != '%') {  // M30%
        add_block(block);
        reader_.clear();
        reader_.add(c, i - begin + 1);
      } else if (!is_blank(c)) {
        reader_.add(upper(c), i - begin + 1);
      }
    }
    if (!any || !reader_.at_end()) add_block(block);
  }

  static bool starts_block(const std::string& text, std::size_t at, std::size_t end) {
    while (at < end && (text[at] == ' ' || text[at] == '\t' || text[at] == '\r')) ++at;
    if (at + 1 >= end) return at < end && text[at] == ';';
    const char first = upper(text[at]);
    const char second = upper(text[at + 1]);
    if (first == '#' || first == '/' || first == '(' || first == ';') return true;
    const bool is_value = is_digit(second) || second == '#' || second == '[' || second == '-' ||
                          second == '.' || second == '+';
    const auto word = [&](std::string_view name) { return first == name[0] && second == name[1]; };
    return (is_letter(first) && is_value) || word("IF") || word("WH") || word("GO") || word("EN") ||
           word("DO");
  }

  void add_block(const Block& block) {
    if (tape_mark()) return;
    if (program_name(block) || program_head(block)) return;
    if (after_end_) return;
    BlockParser(reader_, programs_.back(), profile_).parse(block);
  }

  // '%' begins and ends a tape: what follows the end is not read until the next O word.
  bool tape_mark() {
    if (reader_.peek() != '%') return false;
    after_end_ = !programs_.back().blocks.empty();
    while (reader_.take_if('%')) {
    }
    const bool has_head =
        (reader_.peek() == 'O' || reader_.peek() == ':') && is_digit(reader_.peek(1));
    return !has_head;
  }

  // <NAME> or O<NAME>, a program without a number; words may follow on the line.
  bool program_name(const Block& block) {
    const std::size_t at = reader_.peek() == 'O' ? 1 : 0;
    if (reader_.peek(at) != '<') return false;
    reader_.skip(at + 1);
    std::string name;
    while (!reader_.at_end() && reader_.peek() != '>') name += reader_.take();
    reader_.take_if('>');
    begin_program(0, block);
    programs_.back().name = std::move(name);
    return reader_.at_end();
  }

  // O1234 or :1234 begins a program; words may follow on the line.
  bool program_head(const Block& block) {
    const char c = reader_.peek();
    if (c != 'O' && c != ':') return false;
    if (!is_digit(reader_.peek(1))) return false;
    reader_.skip(1);
    std::int64_t number = 0;
    while (is_digit(reader_.peek())) {
      number = std::min<std::int64_t>(number * 10 + (reader_.take() - '0'), 99999999);
    }
    begin_program(static_cast<int>(number), block);
    return reader_.at_end();
  }

  void begin_program(int number, const Block& block) {
    const Program& last = programs_.back();
    if (last.blocks.empty() && last.number == 0 && last.name.empty()) {
      programs_.back().number = number;
      programs_.back().line = static_cast<int>(block.line);
    } else {
      close_program();
      open_program(number, static_cast<int>(block.line));
    }
    after_end_ = false;
  }

  std::shared_ptr<const std::string> source_;
  const Profile& profile_;
  std::vector<Program> programs_;
  LineReader reader_;
  bool after_end_ = false;
};

}  // namespace

std::vector<Program> compile(std::string text, const Profile& profile) {
  return TextCompiler(std::move(text), profile).run();
}

std::int32_t goto_target(const Program& program, int n, std::int32_t from) {
  const auto less = [](const Label& label, int number) { return label.number < number; };
  auto label = std::lower_bound(program.labels.begin(), program.labels.end(), n, less);
  if (label == program.labels.end() || label->number != n) return -1;
  const std::int32_t first = label->block;
  for (; label != program.labels.end() && label->number == n; ++label) {
    if (label->block > from) return label->block;
  }
  return first;
}

std::string_view line_text(const Program& program, const Block& block) {
  const std::string_view text = *program.source;
  std::string_view line = text.substr(std::min<std::size_t>(block.text, text.size()));
  line = line.substr(0, line.find('\n'));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string_view comment_text(const Program& program, const Block& block) {
  std::string_view line = line_text(program, block);
  const std::size_t open = line.find('(', block.column > 0 ? block.column - 1U : 0U);
  if (open == std::string_view::npos) return {};
  line.remove_prefix(open + 1);
  return line.substr(0, line.find(')'));
}

}  // namespace ridgeline::macro
