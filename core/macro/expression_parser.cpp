#include "core/macro/expression_parser.hpp"
#include "core/macro/names.hpp"
#include "core/macro/text.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>

namespace ridgeline::macro {

namespace {

constexpr std::array<std::pair<std::string_view, Op>, 18> functions = {{
    {"SIN", Op::Sin},
    {"COS", Op::Cos},
    {"TAN", Op::Tan},
    {"ASIN", Op::Asin},
    {"ACOS", Op::Acos},
    {"ATAN", Op::Atan},
    {"SQRT", Op::Sqrt},
    {"ABS", Op::Abs},
    {"BIN", Op::Bin},
    {"BCD", Op::Bcd},
    {"ROUND", Op::Round},
    {"RND", Op::Round},
    {"FIX", Op::Fix},
    {"FUP", Op::Fup},
    {"LN", Op::Ln},
    {"EXP", Op::Exp},
    {"POW", Op::Pow},
    {"ADP", Op::Adp},
}};

constexpr std::array<std::pair<std::string_view, Op>, 6> comparisons = {{
    {"EQ", Op::Equal},
    {"NE", Op::NotEqual},
    {"GT", Op::Greater},
    {"GE", Op::GreaterEqual},
    {"LT", Op::Less},
    {"LE", Op::LessEqual},
}};

bool begins_name(char c) {
  return is_letter(c) || c == '_' || c == '<';
}
bool is_of_name(char c) {
  return is_letter(c) || is_digit(c) || c == '_';
}

}  // namespace

std::int32_t ExpressionParser::value() {
  const auto first = static_cast<std::int32_t>(code_.size());
  const std::uint16_t column = line_.column();
  require_number(sum(), column);
  emit(Op::Return, column);
  return first;
}

std::int32_t ExpressionParser::condition() {
  const auto first = static_cast<std::int32_t>(code_.size());
  const std::uint16_t column = line_.column();
  if (!line_.take_if('[')) raise(AlarmNumber::ExpressionFormat, "[ is expected", column);
  if (comparison() != Type::Condition) {
    raise(AlarmNumber::ExpressionFormat, "a comparison is expected", column);
  }
  close();
  emit(Op::Return, column);
  return first;
}

std::int32_t ExpressionParser::signed_operand() {
  const auto first = static_cast<std::int32_t>(code_.size());
  const std::uint16_t column = line_.column();
  require_number(factor(), column);
  emit(Op::Return, column);
  return first;
}

std::int32_t ExpressionParser::variable_number(std::int32_t& index_code) {
  const std::uint16_t column = line_.column();
  if (at_name()) {
    index_code = static_cast<std::int32_t>(code_.size());
    const std::int32_t number = named_variable();
    if (number >= 0) return number;
    emit(Op::Return, column);
    return -1;
  }
  if (line_.peek() == '[') {
    index_code = static_cast<std::int32_t>(code_.size());
    open();
    require_number(sum(), column);
    close();
    emit(Op::Return, column);
    return -1;
  }
  if (!is_digit(line_.peek())) {
    raise(AlarmNumber::ExpressionFormat, "a variable number is expected after #", column);
  }
  std::int64_t number = 0;
  while (is_digit(line_.peek())) {
    number = number * 10 + (line_.take() - '0');
    if (number > 999999999) raise(AlarmNumber::VariableNumber, numbered("#", number), column);
  }
  if (line_.peek() == '.') raise(AlarmNumber::IllegalPoint, "in a variable number", line_.column());
  return static_cast<std::int32_t>(number);
}

// As FANUC writes it, DATE in [#_DATE], and as others do, <DATE>.
std::int32_t ExpressionParser::name() {
  const std::uint16_t column = line_.column();
  const bool is_in_angles = line_.take_if('<');
  std::string text;
  while (is_in_angles ? line_.peek() != '>' && !line_.at_end() : is_of_name(line_.peek())) {
    text += line_.take();
  }
  if (is_in_angles && !line_.take_if('>')) {
    raise(AlarmNumber::AddressNotFound, "> is expected", line_.column());
  }
  if (text.empty() || text.size() > longest_name) {
    raise(AlarmNumber::AddressNotFound, numbered("a name of 1 to ", longest_name) + " characters",
          column);
  }
  program_.names.push_back(std::move(text));
  return static_cast<std::int32_t>(program_.names.size()) - 1;
}

// A name, or the name of a system variable in brackets: nobody means the variable of its value.
bool ExpressionParser::at_name() const {
  return begins_name(line_.peek()) || line_.rest().starts_with("[#_");
}

// The number when it is known, or -1 and code that pushes it.
std::int32_t ExpressionParser::named_variable() {
  if (line_.peek() == '[') {
    open();
    line_.skip(1);
    const std::int32_t number = named_variable();
    close();
    return number;
  }
  const std::uint16_t column = line_.column();
  const std::int32_t index = name();
  const std::string& text = program_.names[static_cast<std::size_t>(index)];
  const std::optional<SystemName> system = system_name(text);
  if (!system) {
    if (text.starts_with('_')) raise(AlarmNumber::VariableNumber, "#" + text, column);
    emit(Op::NameNumber, column, index);
    return -1;
  }
  if (system->count == 1) return system->first;
  open();
  require_number(sum(), column);
  close();
  emit(Op::Literal, column, 0, system->base);
  emit(Op::Subtract, column);
  emit(Op::Subscript, column, system->first, system->count - 1);
  return -1;
}

void ExpressionParser::emit(Op op, std::uint16_t column, std::int32_t index, double number) {
  code_.push_back({op, column, index, number});
}

void ExpressionParser::open() {
  const std::uint16_t column = line_.column();
  if (!line_.take_if('[')) raise(AlarmNumber::ExpressionFormat, "[ is expected", column);
  if (++depth_ > profile_.brackets) {
    raise(AlarmNumber::TooManyBrackets,
          numbered("more than ", profile_.brackets) + " in one another", column);
  }
}

void ExpressionParser::close() {
  const std::uint16_t column = line_.column();
  if (!line_.take_if(']')) raise(AlarmNumber::ExpressionFormat, "] is expected", column);
  if (depth_ > 0) --depth_;
}

bool ExpressionParser::take_operator(std::string_view name) {
  if (!line_.rest().starts_with(name)) return false;
  line_.skip(name.size());
  return true;
}

void ExpressionParser::require_number(Type type, std::uint16_t column) {
  if (type != Type::Number) {
    raise(AlarmNumber::ExpressionFormat, "a condition is not a value", column);
  }
}

ExpressionParser::Type ExpressionParser::combine(Op arithmetic, Op logical, Type left, Type right,
                                                 std::uint16_t column) {
  if (left != right) {
    raise(AlarmNumber::ExpressionFormat, "a value combined with a condition", column);
  }
  if (left == Type::Condition && !profile_.condition_logic) {
    raise(AlarmNumber::ExpressionFormat, "this control does not combine conditions", column);
  }
  emit(left == Type::Condition ? logical : arithmetic, column);
  return left;
}

ExpressionParser::Type ExpressionParser::comparison() {
  const std::uint16_t start = line_.column();
  const Type left = sum();
  for (const auto& [name, op] : comparisons) {
    const std::uint16_t column = line_.column();
    if (!take_operator(name)) continue;
    require_number(left, start);
    const std::uint16_t right = line_.column();
    require_number(sum(), right);
    emit(op, column);
    return Type::Condition;
  }
  return left;
}

ExpressionParser::Type ExpressionParser::sum() {
  const std::uint16_t start = line_.column();
  Type type = product();
  for (;;) {
    const std::uint16_t column = line_.column();
    if (line_.peek() == '+' || line_.peek() == '-') {
      require_number(type, start);
      const Op op = line_.take() == '+' ? Op::Add : Op::Subtract;
      const std::uint16_t right = line_.column();
      require_number(product(), right);
      emit(op, column);
    } else if (take_operator("OR")) {
      type = combine(Op::BitOr, Op::LogicalOr, type, product(), column);
    } else if (take_operator("XOR")) {
      type = combine(Op::BitXor, Op::LogicalXor, type, product(), column);
    } else {
      return type;
    }
  }
}

ExpressionParser::Type ExpressionParser::product() {
  const std::uint16_t start = line_.column();
  Type type = factor();
  for (;;) {
    const std::uint16_t column = line_.column();
    Op op = Op::Return;
    if (line_.peek() == '*' || line_.peek() == '/') {
      op = line_.take() == '*' ? Op::Multiply : Op::Divide;
    } else if (take_operator("MOD")) {
      op = Op::Modulo;
    } else if (take_operator("AND")) {
      type = combine(Op::BitAnd, Op::LogicalAnd, type, factor(), column);
      continue;
    } else {
      return type;
    }
    require_number(type, start);
    const std::uint16_t right = line_.column();
    require_number(factor(), right);
    emit(op, column);
  }
}

ExpressionParser::Type ExpressionParser::factor() {
  const std::uint16_t column = line_.column();
  int negations = 0, signs = 0;
  for (; line_.peek() == '+' || line_.peek() == '-'; ++signs) {
    negations += line_.take() == '-' ? 1 : 0;
  }
  const Type type = primary();
  if (signs > 0) require_number(type, column);
  if (negations % 2 != 0) {
    emit(Op::Negate, column);
  } else if (negations > 0) {
    emit(Op::Negate, column);  // a vacant operand becomes 0 under any sign
    emit(Op::Negate, column);
  }
  return type;
}

ExpressionParser::Type ExpressionParser::primary() {
  const std::uint16_t column = line_.column();
  const char c = line_.peek();
  if (c == '[') {
    open();
    const Type type = comparison();
    close();
    return type;
  }
  if (c == '#') {
    line_.skip(1);
    variable();
  } else if (is_digit(c) || c == '.') {
    emit(Op::Literal, column, 0, line_.take_number(profile_.literal_digits).value);
  } else if (is_letter(c) && is_letter(line_.peek(1))) {
    function();
  } else {
    raise(AlarmNumber::ExpressionFormat, "a value is expected", column);
  }
  return Type::Number;
}

void ExpressionParser::variable() {
  const std::uint16_t column = line_.column();
  std::int32_t number = 0, none = 0;
  if (at_name()) {
    number = named_variable();
    if (number < 0) return emit(Op::Indirect, column);
  } else if (line_.peek() == '[') {
    open();
    require_number(sum(), column);
    close();
    return emit(Op::Indirect, column);
  } else {
    number = variable_number(none);
  }
  const bool is_local = number >= 1 && number <= 33;
  const bool is_common = (number >= 100 && number <= profile_.last_low_common) ||
                         (number >= 500 && number <= profile_.last_high_common);
  emit(is_local ? Op::Local : is_common ? Op::Common : Op::System, column, number);
}

// PRM[number], PRM[number, bit], and with an axis PRM[number]/[axis], PRM[number, bit]/[axis].
void ExpressionParser::parameter(std::uint16_t column) {
  std::int32_t parts = 0;
  open();
  require_number(sum(), column);
  if (line_.take_if(',')) {
    parts |= 1;
    require_number(sum(), column);
  }
  close();
  if (line_.peek() == '/' && line_.peek(1) == '[') {
    parts |= 2;
    line_.skip(1);
    open();
    require_number(sum(), column);
    close();
  }
  emit(Op::Parameter, column, parts);
}

void ExpressionParser::function() {
  const std::uint16_t column = line_.column();
  if (take_operator("PRM[")) {
    line_.back();
    return parameter(column);
  }
  Op op = Op::Return;
  for (const auto& [name, candidate] : functions) {
    std::size_t matched = 0;
    while (matched < name.size() && line_.peek(matched) == name[matched]) ++matched;
    if (matched < 2 || line_.peek(matched) != '[') continue;
    line_.skip(matched);
    op = candidate;
    break;
  }
  const bool is_power = op == Op::Pow || op == Op::Adp;
  if (op == Op::Return || (is_power && !profile_.power_functions)) {
    raise(AlarmNumber::ExpressionFormat, "unknown function", column);
  }
  open();
  if (op == Op::Adp) {  // needs the variable itself: was its argument written without a point?
    std::int32_t none = 0;
    const std::int32_t number = line_.take_if('#') ? variable_number(none) : -1;
    if (number < 1 || number > 33) {
      raise(AlarmNumber::ExpressionFormat, "ADP takes a local variable #1 to #33", column);
    }
    close();
    emit(Op::Adp, column, number);
    return;
  }
  require_number(sum(), column);
  if (op == Op::Pow || (op == Op::Atan && line_.peek() == ',')) {
    if (!line_.take_if(',')) raise(AlarmNumber::ExpressionFormat, "POW takes two values", column);
    require_number(sum(), column);
    op = op == Op::Atan ? Op::Atan2 : op;
  }
  close();
  if (op == Op::Atan && line_.peek() == '/' && line_.peek(1) == '[') {
    line_.skip(1);
    open();
    require_number(sum(), column);
    close();
    op = Op::Atan2;
  }
  emit(op, column);
}

}  // namespace ridgeline::macro
