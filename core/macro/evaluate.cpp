#include <array>
#include <cmath>
#include <string>

#include "core/base/angle.hpp"
#include "core/macro/parameters.hpp"
#include "core/macro/text.hpp"
#include "core/macro/variables.hpp"

namespace ridgeline::macro {

namespace {

// ASIN and ACOS accept an argument beyond +-1 by this much: rounding of the quotient before it.
constexpr double unit_slack = 1e-12;

double to_mantissa(double value, int bits) {
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  return std::ldexp(std::round(std::ldexp(fraction, bits)), exponent - bits);
}

// Sine of 0 to 90 degrees, exact where it is rational.
double first_quadrant(double angle) {
  if (angle == 30) return 0.5;
  if (angle == 90) return 1;
  return angle <= 45 ? std::sin(radians(angle)) : std::cos(radians(90 - angle));
}
double sine(double angle) {
  double turn = std::fmod(angle, 360.0);
  double sign = 1;
  if (turn < 0) {
    turn = -turn;
    sign = -1;
  }
  if (turn >= 180) {
    turn -= 180;
    sign = -sign;
  }
  return sign * first_quadrant(turn > 90 ? 180 - turn : turn);
}
double cosine(double angle) {
  return sine(90 - std::abs(std::fmod(angle, 360.0)));
}

double tangent(double angle, int column) {
  if (std::abs(std::fmod(angle, 180.0)) == 90) raise(AlarmNumber::ArgumentRange, "TAN[90]", column);
  return sine(angle) / cosine(angle);
}

std::int64_t bits_of(double value, int column) {
  const std::int64_t integer = rounded_integer(value, column);
  if (integer > 4294967295LL || integer < -2147483648LL) {
    raise(AlarmNumber::IntegerOverflow, "more than 32 bits", column);
  }
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(integer & 0xFFFFFFFFLL));
}

double from_bcd(double value, int column) {
  std::int64_t rest = rounded_integer(value, column);
  double result = 0, digit = 1;
  if (rest < 0) raise(AlarmNumber::ArgumentRange, "BIN of a negative number", column);
  for (; rest > 0; rest /= 16, digit *= 10) {
    if (rest % 16 > 9) raise(AlarmNumber::ArgumentRange, "BIN of a number that is not BCD", column);
    result += static_cast<double>(rest % 16) * digit;
  }
  return result;
}

double to_bcd(double value, int column) {
  std::int64_t rest = rounded_integer(value, column);
  std::int64_t result = 0, digit = 1;
  if (rest < 0 || rest > 99999999) {
    raise(AlarmNumber::ArgumentRange, "BCD takes 0 to 99999999", column);
  }
  for (; rest > 0; rest /= 10, digit *= 16) result += rest % 10 * digit;
  return static_cast<double>(result);
}

double modulo(double left, double right, int column) {
  const std::int64_t dividend = rounded_integer(left, column);
  const std::int64_t divisor = rounded_integer(right, column);
  if (divisor == 0) raise(AlarmNumber::ZeroDivide, "MOD 0", column);
  return static_cast<double>(divisor == -1 ? 0 : dividend % divisor);
}

double arc_function(Op op, double value, const Profile& profile, int column) {
  if (!(std::abs(value) <= 1 + unit_slack)) {
    raise(AlarmNumber::ArgumentRange, "ASIN or ACOS beyond 1", column);
  }
  const double x = std::min(1.0, std::max(-1.0, value));
  // 30 and 60 degrees come out exact, as on a control.
  if (op == Op::Acos) return x == 0.5 ? 60 : x == -0.5 ? 120 : degrees(std::acos(x));
  const double angle = std::abs(x) == 0.5 ? 60 * x : degrees(std::asin(x));
  return angle < 0 && !profile.half_turn_angles ? angle + 360 : angle;
}

double arc_tangent(double y, double x, const Profile& profile, int column) {
  if (x == 0 && y == 0) raise(AlarmNumber::ZeroDivide, "ATAN[0]/[0]", column);
  const double angle = degrees(std::atan2(y + 0.0, x + 0.0));  // + 0.0: -0 counts as 0
  return angle < 0 && !profile.half_turn_angles ? angle + 360 : angle;
}

double power(double base, double exponent, int column) {
  if ((base < 0 && exponent != std::round(exponent)) || (base == 0 && exponent < 0)) {
    raise(AlarmNumber::ArgumentRange, "POW", column);
  }
  return std::pow(base, exponent);
}

double function_of(Op op, double x, const Profile& profile, int column) {
  switch (op) {
    case Op::Sin: return sine(x);
    case Op::Cos: return cosine(x);
    case Op::Tan: return tangent(x, column);
    case Op::Asin:
    case Op::Acos: return arc_function(op, x, profile, column);
    case Op::Atan: return degrees(std::atan(x));
    case Op::Sqrt:
      if (!(x >= 0)) raise(AlarmNumber::ArgumentRange, "SQRT of a negative number", column);
      return std::sqrt(x);
    case Op::Abs: return std::abs(x);
    case Op::Bin: return from_bcd(x, column);
    case Op::Bcd: return to_bcd(x, column);
    case Op::Round: return std::round(x);
    case Op::Fix: return std::trunc(x);
    case Op::Fup: return x < 0 ? std::floor(x) : std::ceil(x);
    case Op::Ln:
      if (!(x > 0)) raise(AlarmNumber::ArgumentRange, "LN of zero or less", column);
      return std::log(x);
    case Op::Exp: return std::exp(x);
    default: return x;
  }
}

double arithmetic(Op op, double left, double right, int column) {
  switch (op) {
    case Op::Add: return left + right;
    case Op::Subtract: return left - right;
    case Op::Multiply: return left * right;
    case Op::Divide:
      if (right == 0) raise(AlarmNumber::ZeroDivide, {}, column);
      return left / right;
    case Op::Modulo: return modulo(left, right, column);
    case Op::BitAnd: return static_cast<double>(bits_of(left, column) & bits_of(right, column));
    case Op::BitOr: return static_cast<double>(bits_of(left, column) | bits_of(right, column));
    case Op::BitXor: return static_cast<double>(bits_of(left, column) ^ bits_of(right, column));
    case Op::Greater: return left > right ? 1.0 : 0.0;
    case Op::GreaterEqual: return left >= right ? 1.0 : 0.0;
    case Op::Less: return left < right ? 1.0 : 0.0;
    case Op::LessEqual: return left <= right ? 1.0 : 0.0;
    case Op::LogicalAnd: return left != 0 && right != 0 ? 1.0 : 0.0;
    case Op::LogicalOr: return left != 0 || right != 0 ? 1.0 : 0.0;
    default: return (left != 0) != (right != 0) ? 1.0 : 0.0;  // LogicalXor
  }
}

// Operand of the stack: a Value that needs no start value.
struct Operand {
  double number;
  bool vacant;
};
Operand operand(Value value) {
  return {value.number, value.vacant};
}

}  // namespace

std::int64_t rounded_integer(double value, int column) {
  if (!(std::abs(value) < 9e15)) raise(AlarmNumber::IntegerOverflow, {}, column);
  return std::llround(value);
}

Value evaluate(const Program& program, std::int32_t code, const Variables& variables) {
  // Brackets nest at most `brackets` deep, each level holds at most three operands.
  std::array<Operand, 64> stack;
  std::size_t top = 0;  // operands on the stack
  const Profile& profile = variables.profile();
  // As the control keeps it: a literal too has no more digits than a computed value.
  const auto kept = [bits = profile.mantissa_bits](double number, int column) -> Operand {
    if (!std::isfinite(number)) raise(AlarmNumber::FloatOverflow, {}, column);
    return {bits > 0 ? to_mantissa(number, bits) : number, false};
  };
  for (const Instruction* at = program.code.data() + code;; ++at) {
    switch (at->op) {
      case Op::Return: {
        const Operand result = stack[0];
        if (result.vacant) return {};
        if (!std::isfinite(result.number)) raise(AlarmNumber::FloatOverflow, {}, at->column);
        return result.number + 0.0;  // no negative zero
      }
      case Op::Literal: stack[top++] = kept(at->number, at->column); break;
      case Op::Local: stack[top++] = operand(variables.local(at->index)); break;
      case Op::Common: stack[top++] = operand(variables.common(at->index)); break;
      case Op::System: stack[top++] = operand(variables.read(at->index, at->column)); break;
      case Op::Indirect: {
        const std::int64_t number = rounded_integer(stack[top - 1].number, at->column);
        if (number < 0 || number > 999999999) {
          raise(AlarmNumber::VariableNumber, numbered("#", number), at->column);
        }
        stack[top - 1] = operand(variables.read(static_cast<int>(number), at->column));
        break;
      }
      case Op::Negate: stack[top - 1] = {0.0 - stack[top - 1].number, false}; break;
      case Op::Equal:
      case Op::NotEqual: {  // a vacant value equals only another
        const Operand& left = stack[top - 2];
        const Operand& right = stack[top - 1];
        const bool equal = left.number == right.number && left.vacant == right.vacant;
        stack[--top - 1] = {equal == (at->op == Op::Equal) ? 1.0 : 0.0, false};
        break;
      }
      case Op::NameNumber: {
        const std::string& name = program.names[static_cast<std::size_t>(at->index)];
        stack[top++] = {static_cast<double>(variables.named(name, at->column)), false};
        break;
      }
      case Op::Subscript: {
        const std::int64_t n = rounded_integer(stack[top - 1].number, at->column);
        if (n < 0 || static_cast<double>(n) > at->number) {
          raise(AlarmNumber::VariableNumber, "subscript out of range", at->column);
        }
        stack[top - 1] = {static_cast<double>(at->index + n), false};
        break;
      }
      case Op::Parameter: {
        ParameterPlace place;
        if ((at->index & 2) != 0) place.axis = rounded_integer(stack[--top].number, at->column);
        if ((at->index & 1) != 0) place.bit = rounded_integer(stack[--top].number, at->column);
        place.number = rounded_integer(stack[top - 1].number, at->column);
        stack[top - 1] = {parameter(profile, place, at->column), false};
        break;
      }
      case Op::Adp: stack[top++] = {variables.point_added(at->index), false}; break;
      case Op::Atan2:
        --top;
        stack[top - 1] = kept(
            arc_tangent(stack[top - 1].number, stack[top].number, profile, at->column), at->column);
        break;
      case Op::Pow:
        --top;
        stack[top - 1] =
            kept(power(stack[top - 1].number, stack[top].number, at->column), at->column);
        break;
      case Op::Sin:
      case Op::Cos:
      case Op::Tan:
      case Op::Asin:
      case Op::Acos:
      case Op::Atan:
      case Op::Sqrt:
      case Op::Abs:
      case Op::Bin:
      case Op::Bcd:
      case Op::Round:
      case Op::Fix:
      case Op::Fup:
      case Op::Ln:
      case Op::Exp:
        stack[top - 1] =
            kept(function_of(at->op, stack[top - 1].number, profile, at->column), at->column);
        break;
      default:
        --top;
        stack[top - 1] = kept(
            arithmetic(at->op, stack[top - 1].number, stack[top].number, at->column), at->column);
        break;
    }
  }
}

}  // namespace ridgeline::macro
