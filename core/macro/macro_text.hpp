#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ridgeline::macro {

enum class ProgramDialect { Fanuc, LinuxCnc };

/// Writes a macro program statement by statement, in Custom Macro B or in LinuxCNC's dialect. The
/// expressions are the same in both; loops and branches become o-words there.
class MacroText {
public:
  explicit MacroText(ProgramDialect dialect) : dialect_(dialect) {}

  bool is_fanuc() const { return dialect_ == ProgramDialect::Fanuc; }
  void line(std::string_view text);
  void comment(std::string_view text);
  /// #variable = expression, with a comment behind.
  void assign(int variable, std::string_view expression, std::string_view comment = {});
  /// Nest at most three deep.
  void begin_while(std::string_view condition);
  void end_while();
  /// What follows runs when `left op right` holds; op: EQ NE GT GE LT LE.
  void begin_if(std::string_view left, std::string_view op, std::string_view right);
  void end_if();
  /// IF[condition]THEN #variable=expression
  void if_then(std::string_view condition, int variable, std::string_view expression);
  /// Stops with alarm 3000 + number and the message when the condition holds.
  void alarm_if(std::string_view condition, int number, std::string_view message);
  const std::string& text() const { return text_; }

private:
  std::string value(std::string_view expression) const;

  ProgramDialect dialect_;
  std::string text_;
  int label_ = 100;            ///< last used N or o number
  std::vector<int> loops_;     ///< o numbers of open loops
  std::vector<int> branches_;  ///< N or o numbers of open branches
};

/// A number as programs write it: at most six decimals, always with a point.
std::string macro_number(double value);

}  // namespace ridgeline::macro
