#pragma once

#include <cstdint>
#include <vector>

#include "core/macro/line_reader.hpp"
#include "core/macro/program.hpp"

namespace ridgeline::macro {

/// Compiles expressions (design section 2.3) into instructions. Precedence: functions;
/// * / AND MOD; + - OR XOR; comparisons. Every member returns the index of the first instruction
/// and raises AlarmRaised with the column.
class ExpressionParser {
public:
  ExpressionParser(LineReader& line, Program& program, const Profile& profile)
      : line_(line), program_(program), code_(program.code), profile_(profile) {}

  /// A value: must not be a condition.
  std::int32_t value();
  /// [ condition ] with its brackets.
  std::int32_t condition();
  /// [+|-] then #variable or [expression].
  std::int32_t signed_operand();
  /// After '#': a plain number >= 0, or -1 when the number is computed by `index_code`.
  std::int32_t variable_number(std::int32_t& index_code);
  /// A name of letters, digits and _, its index in Program::names. Raises `AddressNotFound`.
  std::int32_t name();

private:
  enum class Type { Number, Condition };
  Type comparison();
  Type sum();
  Type product();
  Type factor();
  Type primary();
  void variable();
  std::int32_t named_variable();
  bool at_name() const;
  void function();
  void parameter(std::uint16_t column);
  void emit(Op op, std::uint16_t column, std::int32_t index = 0, double number = 0);
  void open();
  void close();
  bool take_operator(std::string_view name);
  Type combine(Op arithmetic, Op logical, Type left, Type right, std::uint16_t column);
  static void require_number(Type type, std::uint16_t column);

  LineReader& line_;
  Program& program_;
  std::vector<Instruction>& code_;
  const Profile& profile_;
  int depth_ = 0;
};

}  // namespace ridgeline::macro
