#include "core/macro/block_parser.hpp"
#include "core/macro/text.hpp"

#include <string>

namespace ridgeline::macro {

namespace {

constexpr std::int32_t last_sequence_number = 99999999;
constexpr std::int32_t last_goto_number = 99999;
constexpr std::int32_t last_variable = 999999999;
constexpr int most_conditions = 10;  // IF..THEN IF..THEN; no control documents more than one

std::string address_name(char letter) {
  if (letter == 'r') return ",R";
  if (letter == 'c') return ",C";
  return std::string(1, letter);
}

}  // namespace

void BlockParser::parse(Block block) {
  const std::size_t before = program_.blocks.size();
  try {
    head(block);
    statement(block);
  } catch (const AlarmRaised& raised) {
    program_.blocks.resize(before);  // the IF of an IF..THEN whose statement is wrong
    block.kind = BlockKind::Faulty;
    block.code = block.goto_code = -1;  // an expression may have been left half done
    block.words = 0;
    block.target = static_cast<std::int32_t>(program_.alarms.size());
    program_.alarms.push_back(raised.alarm);
    program_.blocks.push_back(block);
  }
}

void BlockParser::head(Block& block) {
  skip_mark(block);
  if (line_.peek() == 'N' && !is_letter(line_.peek(1))) {
    const std::uint16_t column = line_.column();
    line_.skip(1);
    if (!is_digit(line_.peek())) raise(AlarmNumber::NoDataAfterAddress, "N", column);
    block.label = sequence_number();
    skip_mark(block);
  }
  block.column = line_.column();
}

void BlockParser::skip_mark(Block& block) {
  while (line_.peek() == '/') {
    line_.skip(1);
    block.optional = true;
    if (is_digit(line_.peek())) line_.skip(1);
  }
}

std::int32_t BlockParser::sequence_number() {
  std::int64_t number = 0;
  const std::uint16_t column = line_.column();
  while (is_digit(line_.peek())) {
    number = number * 10 + (line_.take() - '0');
    if (number > last_sequence_number) raise(AlarmNumber::TooManyDigits, "N", column);
  }
  return static_cast<std::int32_t>(number);
}

void BlockParser::statement(Block& block) {
  if (line_.at_end()) {
    if (block.label >= 0) program_.blocks.push_back(block);
  } else if (line_.peek() == '#' || (line_.peek() == '[' && line_.peek(1) == '#')) {
    assignment(block);
  } else if (is_letter(line_.peek(1)) && is_letter(line_.peek())) {
    keyword(block);
  } else {
    nc(block);
  }
}

void BlockParser::keyword(Block& block) {
  if (line_.rest().starts_with("IF")) {
    line_.skip(2);
    conditional(block);
  } else if (line_.take_keyword("WHILE")) {
    loop(block, BlockKind::While);
  } else if (line_.rest().starts_with("DO")) {
    loop(block, BlockKind::Do);
  } else if (line_.take_keyword("END")) {
    block.kind = BlockKind::End;
    block.target = loop_number();
    finish(block);
  } else if (line_.take_keyword("GOTO")) {
    jump(block, BlockKind::Goto);
  } else if (line_.rest().starts_with("DPRNT")) {
    print(block);
  } else if (line_.rest().starts_with("SETVN")) {
    names(block);
  } else if (line_.rest().starts_with("POPEN") || line_.rest().starts_with("PCLOS") ||
             line_.rest().starts_with("BPRNT")) {
    block.kind = BlockKind::Ignored;
    line_.skip(line_.rest().size());
    finish(block);
  } else {
    nc(block);  // finds the letter that lacks its number
  }
}

void BlockParser::finish(const Block& block) {
  if (!line_.at_end()) leftover();
  program_.blocks.push_back(block);
}

void BlockParser::leftover() {
  if (is_letter(line_.peek())) {
    raise(AlarmNumber::NcAndMacroInBlock, line_.rest(), line_.column());
  }
  raise(AlarmNumber::ExpressionFormat, line_.rest(), line_.column());
}

void BlockParser::assignment(Block& block) {
  const bool is_in_brackets = line_.take_if('[');  // [#NAME] = ..
  line_.skip(1);
  block.kind = BlockKind::Assign;
  block.variable = expression_.variable_number(block.goto_code);
  if (is_in_brackets && !line_.take_if(']')) {
    raise(AlarmNumber::ExpressionFormat, "] is expected", line_.column());
  }
  if (!line_.take_if('=')) {
    raise(AlarmNumber::ExpressionFormat, "= is expected", line_.column());
  }
  block.code = expression_.value();
  finish(block);
}

void BlockParser::conditional(Block& block) {
  if (++conditions_ > most_conditions) {
    raise(AlarmNumber::MacroFormat, "too many IF in one block", line_.column());
  }
  block.code = expression_.condition();
  if (line_.take_keyword("GOTO")) {
    jump(block, BlockKind::IfGoto);
  } else if (line_.take_keyword("THEN")) {
    block.kind = BlockKind::IfThen;
    const std::size_t index = program_.blocks.size();
    program_.blocks.push_back(block);
    Block then = block;
    then.kind = BlockKind::Empty;
    then.label = -1;
    then.code = -1;
    then.column = line_.column();
    consequence(then);
    program_.blocks[index].target = static_cast<std::int32_t>(program_.blocks.size());
  } else {
    raise(AlarmNumber::ExpressionFormat, "GOTO or THEN is expected", line_.column());
  }
}

// One macro statement; M98, M99 and G65 count as such.
void BlockParser::consequence(Block& then) {
  if (line_.peek() == '#' || (line_.peek() == '[' && line_.peek(1) == '#')) {
    assignment(then);
  } else if (line_.rest().starts_with("GO")) {
    keyword(then);
  } else if (line_.rest().starts_with("G65") || line_.rest().starts_with("M98") ||
             line_.rest().starts_with("M99")) {
    nc(then);
  } else if (line_.rest().starts_with("IF")) {
    keyword(then);
  } else if (is_letter(line_.peek())) {
    raise(AlarmNumber::NcAndMacroInBlock, "THEN takes one macro statement", line_.column());
  } else {
    raise(AlarmNumber::ExpressionFormat, "THEN takes one macro statement", line_.column());
  }
}

void BlockParser::loop(Block& block, BlockKind kind) {
  block.kind = kind;
  if (kind == BlockKind::While) block.code = expression_.condition();
  if (!line_.rest().starts_with("DO")) {
    raise(AlarmNumber::ExpressionFormat, "DO is expected", line_.column());
  }
  line_.skip(2);
  block.target = loop_number();
  finish(block);
}

std::int32_t BlockParser::loop_number() {
  const std::uint16_t column = line_.column();
  if (!is_digit(line_.peek())) raise(AlarmNumber::LoopNumber, "1, 2 or 3 is expected", column);
  const double number = line_.take_number(profile_.literal_digits).value;
  if (number != 1 && number != 2 && number != 3) {
    raise(AlarmNumber::LoopNumber, "1, 2 or 3 is expected", column);
  }
  return static_cast<std::int32_t>(number);
}

void BlockParser::jump(Block& block, BlockKind kind) {
  block.kind = kind;
  const std::uint16_t column = line_.column();
  if (is_digit(line_.peek())) {
    const double number = line_.take_number(profile_.literal_digits).value;
    if (!(number >= 1 && number <= last_goto_number)) {
      raise(AlarmNumber::GotoTarget, "1 to 99999", column);
    }
    block.target = static_cast<std::int32_t>(number);
  } else if (line_.peek() == '#' || line_.peek() == '[' || line_.peek() == '-' ||
             line_.peek() == '+') {
    block.goto_code = expression_.signed_operand();
  } else {
    raise(AlarmNumber::GotoTarget, "a sequence number is expected", column);
  }
  finish(block);
}

// DPRNT[X#100[53]...]: the text is read again when the block runs.
void BlockParser::print(Block& block) {
  block.kind = BlockKind::Print;
  line_.skip(5);
  const std::uint16_t column = line_.column();
  if (!line_.take_if('[')) raise(AlarmNumber::MacroFormat, "DPRNT[", column);
  block.first_word = static_cast<std::uint32_t>(program_.words.size());
  while (!line_.at_end() && line_.peek() != ']') {
    Word word;
    word.column = line_.column();
    if (line_.take_if('#')) {
      std::int32_t index_code = -1;
      word.letter = '#';
      const std::int32_t number = expression_.variable_number(index_code);
      word.code = index_code;
      word.number = number;
      word.flags = static_cast<std::uint8_t>(print_format());
    } else {
      word.letter = line_.take();
    }
    program_.words.push_back(word);
    ++block.words;
  }
  if (!line_.take_if(']')) raise(AlarmNumber::MacroFormat, "] is expected", line_.column());
  finish(block);
}

// SETVN 510[NAME, ...]: names #510 and those after it.
void BlockParser::names(Block& block) {
  block.kind = BlockKind::Name;
  line_.skip(5);
  line_.take_if('#');
  const std::uint16_t column = line_.column();
  const double number = line_.take_number(profile_.literal_digits).value;
  if (number > last_variable) {
    raise(AlarmNumber::VariableNumber, numbered("#", static_cast<std::int64_t>(number)), column);
  }
  block.variable = static_cast<std::int32_t>(number);
  if (!line_.take_if('[')) raise(AlarmNumber::MacroFormat, "SETVN n[NAME, ..]", column);
  block.first_word = static_cast<std::uint32_t>(program_.words.size());
  do {
    Word word;
    word.column = line_.column();
    word.letter = '<';
    word.number = expression_.name();
    if (program_.names.back().starts_with('_') || is_digit(program_.names.back()[0])) {
      raise(AlarmNumber::MacroFormat, "a name of a variable begins with a letter", word.column);
    }
    program_.words.push_back(word);
    ++block.words;
  } while (line_.take_if(','));
  if (!line_.take_if(']')) raise(AlarmNumber::MacroFormat, "] is expected", line_.column());
  finish(block);
}

// [ab]: a digits before and b after the point.
int BlockParser::print_format() {
  if (!line_.take_if('[')) raise(AlarmNumber::MacroFormat, "[ab] is expected", line_.column());
  int format = 0;
  while (is_digit(line_.peek()) && format < 10) format = format * 10 + (line_.take() - '0');
  if (!line_.take_if(']')) raise(AlarmNumber::MacroFormat, "[ab] is expected", line_.column());
  return format;
}

void BlockParser::nc(Block& block) {
  block.kind = BlockKind::Nc;
  block.first_word = static_cast<std::uint32_t>(program_.words.size());
  while (!line_.at_end()) {
    if (line_.peek() == '/' || line_.peek() == ')') {  // skip mark; end of a nested comment
      line_.skip(1);
      continue;
    }
    if (line_.peek() == '#') {
      raise(AlarmNumber::NcAndMacroInBlock, line_.rest(), line_.column());
    }
    if (line_.peek() == 'N' && is_digit(line_.peek(1)) && block.label < 0) {
      line_.skip(1);
      block.label = sequence_number();
      continue;
    }
    program_.words.push_back(word());
    ++block.words;
    classify(block, program_.words.back());
  }
  program_.blocks.push_back(block);
}

void BlockParser::classify(Block& block, const Word& word) const {
  if (word.letter != 'G' || (word.flags & Word::is_literal) == 0) return;
  const bool is_call = block.kind == BlockKind::Call || block.kind == BlockKind::ModalCall;
  if (is_call) {
    const auto number = static_cast<std::int64_t>(word.number);
    raise(AlarmNumber::GAsArgument, numbered("G", number), word.column);
  }
  if (word.number == 65) block.kind = BlockKind::Call;
  if (word.number == 66 || word.number == 66.1) block.kind = BlockKind::ModalCall;
}

Word BlockParser::word() {
  Word word;
  word.column = line_.column();
  if (line_.peek() == 'P' && line_.peek(1) == '<') line_.skip(1);
  if (line_.peek() == '<') {
    word.letter = '<';
    word.flags = Word::is_literal;
    word.number = expression_.name();
    return word;
  }
  word.letter = line_.take();
  if (word.letter == ',' && (line_.peek() == 'R' || line_.peek() == 'C')) {
    word.letter = line_.take() == 'R' ? 'r' : 'c';
  } else if (!is_letter(word.letter)) {
    raise(AlarmNumber::AddressNotFound, std::string("'") + word.letter + "'", word.column);
  }
  const char next = line_.peek();
  const char after = line_.peek(1);
  if (next == '#' || next == '[' ||
      ((next == '-' || next == '+') && (after == '#' || after == '['))) {
    word.code = expression_.signed_operand();
    return word;
  }
  literal(word);
  return word;
}

void BlockParser::literal(Word& word) {
  bool is_negative = false;
  if (line_.peek() == '-' || line_.peek() == '+') is_negative = line_.take() == '-';
  if (line_.peek() == '-' || line_.peek() == '+') {
    raise(AlarmNumber::IllegalMinus, "two signs", line_.column());
  }
  if (!is_digit(line_.peek()) && line_.peek() != '.') {
    raise(AlarmNumber::NoDataAfterAddress, address_name(word.letter), word.column);
  }
  const LineReader::Number number = line_.take_number(profile_.literal_digits);
  word.number = is_negative ? -number.value : number.value;
  word.flags =
      static_cast<std::uint8_t>(Word::is_literal | (number.has_point ? Word::has_point : 0));
}

}  // namespace ridgeline::macro
