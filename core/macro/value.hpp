#pragma once

namespace ridgeline::macro {

/// Value of a macro variable or expression: a number, or vacant (#0).
/// Vacant counts as 0 in arithmetic and in GT GE LT LE; EQ and NE tell it from 0.
struct Value {
  double number = 0;  ///< 0 while vacant
  bool vacant = true;

  constexpr Value() = default;
  constexpr Value(double value) : number(value), vacant(false) {}
  friend constexpr bool operator==(const Value&, const Value&) = default;
};

}  // namespace ridgeline::macro
