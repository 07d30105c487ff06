#include "core/macro/value_types.hpp"

#include <cmath>

namespace ridgeline::macro {

namespace {

ValueType joined(ValueType a, ValueType b) {
  if (a == ValueType::Real || b == ValueType::Real) return ValueType::Real;
  if (a == ValueType::Unknown || b == ValueType::Unknown) return ValueType::Unknown;
  return ValueType::Integer;
}

ValueType of_function(Op op, ValueType operand) {
  switch (op) {
    case Op::Round:
    case Op::Fix:
    case Op::Fup:
    case Op::Bin:
    case Op::Bcd: return ValueType::Integer;
    case Op::Abs:
    case Op::Negate: return operand == ValueType::Vacant ? ValueType::Integer : operand;
    default: return ValueType::Real;
  }
}

}  // namespace

ValueTypes::ValueTypes(const std::vector<Program>& programs) {
  for (const Program& program : programs) {
    for (const Block& block : program.blocks) {
      if (block.kind == BlockKind::Assign && block.variable > 0) {
        assigned_.emplace(block.variable, ValueType::Integer);
      }
    }
  }
  for (bool has_changed = true; has_changed;) {  // types only grow, so this ends
    has_changed = false;
    for (const Program& program : programs) {
      for (const Block& block : program.blocks) {
        if (block.kind != BlockKind::Assign || block.variable <= 0) continue;
        ValueType& type = assigned_.at(block.variable);
        const ValueType grown = joined(type, of(program, block.code));
        has_changed = has_changed || grown != type;
        type = grown;
      }
    }
  }
}

ValueType ValueTypes::of_variable(int variable) const {
  if (variable == 0) return ValueType::Vacant;
  if (variable > 4000 && variable < 4600) return ValueType::Integer;
  if (variable > 5000 && variable < 5200) return ValueType::Real;
  const auto found = assigned_.find(variable);
  return found == assigned_.end() ? ValueType::Unknown : found->second;
}

ValueType ValueTypes::of(const Program& program, std::int32_t code,
                         std::vector<Comparison>* compared) const {
  std::vector<ValueType> stack;
  const auto take = [&stack] {
    const ValueType type = stack.back();
    stack.pop_back();
    return type;
  };
  for (const Instruction* at = program.code.data() + code;; ++at) {
    switch (at->op) {
      case Op::Return: return stack.back();
      case Op::Literal:
        stack.push_back(at->number == std::floor(at->number) ? ValueType::Integer
                                                             : ValueType::Real);
        break;
      case Op::Local:
      case Op::Common:
      case Op::System:
      case Op::Adp: stack.push_back(of_variable(at->index)); break;
      case Op::NameNumber: stack.push_back(ValueType::Unknown); break;
      case Op::Parameter:
        for (int parts = at->index; parts > 0; parts >>= 1) {
          if ((parts & 1) != 0) take();
        }
        stack.back() = ValueType::Unknown;
        break;
      case Op::Subscript:
      case Op::Indirect: stack.back() = ValueType::Unknown; break;
      case Op::Add:
      case Op::Subtract:
      case Op::Multiply: {
        const ValueType right = take();
        stack.back() = joined(stack.back(), right);
        break;
      }
      case Op::Divide:
      case Op::Atan2:
      case Op::Pow:
        take();
        stack.back() = ValueType::Real;
        break;
      case Op::Equal:
      case Op::NotEqual: {
        const ValueType right = take();
        if (compared != nullptr) compared->push_back({stack.back(), right, at->column});
        stack.back() = ValueType::Integer;
        break;
      }
      case Op::Modulo:
      case Op::BitAnd:
      case Op::BitOr:
      case Op::BitXor:
      case Op::Greater:
      case Op::GreaterEqual:
      case Op::Less:
      case Op::LessEqual:
      case Op::LogicalAnd:
      case Op::LogicalOr:
      case Op::LogicalXor:
        take();
        stack.back() = ValueType::Integer;
        break;
      default: stack.back() = of_function(at->op, stack.back()); break;
    }
  }
}

}  // namespace ridgeline::macro
