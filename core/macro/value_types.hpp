#pragma once

#include <map>
#include <vector>

#include "core/macro/program.hpp"

namespace ridgeline::macro {

/// What is known of the values of variables without running: enough to tell counters from computed
/// lengths.
enum class ValueType { Unknown, Vacant, Integer, Real };

/// Types of the variables that programs assign, over all programs of a text.
class ValueTypes {
public:
  explicit ValueTypes(const std::vector<Program>& programs);
  /// Type of an expression; `compared`, when given, receives the operand types of every EQ and NE
  /// in it, with the column.
  struct Comparison {
    ValueType left, right;
    int column = 0;
  };
  ValueType of(const Program& program, std::int32_t code,
               std::vector<Comparison>* compared = nullptr) const;
  bool is_assigned(int variable) const { return assigned_.contains(variable); }

private:
  ValueType of_variable(int variable) const;
  std::map<int, ValueType> assigned_;
};

}  // namespace ridgeline::macro
