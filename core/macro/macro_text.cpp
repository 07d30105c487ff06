#include "core/macro/macro_text.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

namespace {

std::string_view opposite(std::string_view op) {
  if (op == "EQ") return "NE";
  if (op == "NE") return "EQ";
  if (op == "GT") return "LE";
  if (op == "GE") return "LT";
  if (op == "LT") return "GE";
  return "GT";
}

}  // namespace

// LinuxCNC wants an expression in brackets, also alone.
std::string MacroText::value(std::string_view expression) const {
  return is_fanuc() ? std::string(expression) : "[" + std::string(expression) + "]";
}

void MacroText::line(std::string_view text) {
  text_.append(text).append("\n");
}

void MacroText::comment(std::string_view text) {
  text_.append("(").append(text).append(")\n");
}

void MacroText::assign(int variable, std::string_view expression, std::string_view comment) {
  text_.append(numbered("#", variable)).append("=").append(value(expression));
  if (!comment.empty()) text_.append(is_fanuc() ? "(" : " (").append(comment).append(")");
  text_.append("\n");
}

void MacroText::begin_while(std::string_view condition) {
  loops_.push_back(++label_);
  if (loops_.size() > 3) throw Error(ErrorCode::Internal, "a program nests more than three loops");
  if (is_fanuc()) {
    text_.append("WHILE[").append(condition).append("]DO");
    text_.append(std::to_string(loops_.size())).append("\n");
  } else {
    text_.append(numbered("o", label_)).append(" while [").append(condition).append("]\n");
  }
}

void MacroText::end_while() {
  text_.append(is_fanuc() ? numbered("END", static_cast<int>(loops_.size()))
                          : numbered("o", loops_.back()) + " endwhile");
  text_.append("\n");
  loops_.pop_back();
}

void MacroText::begin_if(std::string_view left, std::string_view op, std::string_view right) {
  branches_.push_back(++label_);
  if (is_fanuc()) {
    text_.append("IF[").append(left).append(" ").append(opposite(op)).append(" ").append(right);
    text_.append("]GOTO").append(std::to_string(label_)).append("\n");
  } else {
    text_.append(numbered("o", label_)).append(" if [").append(left).append(" ").append(op);
    text_.append(" ").append(right).append("]\n");
  }
}

void MacroText::end_if() {
  text_.append(is_fanuc() ? numbered("N", branches_.back())
                          : numbered("o", branches_.back()) + " endif");
  text_.append("\n");
  branches_.pop_back();
}

void MacroText::if_then(std::string_view condition, int variable, std::string_view expression) {
  if (is_fanuc()) {
    text_.append("IF[").append(condition).append("]THEN ");
    text_.append(numbered("#", variable)).append("=").append(expression).append("\n");
    return;
  }
  const std::string label = numbered("o", ++label_);
  text_.append(label).append(" if [").append(condition).append("]\n");
  text_.append(numbered("#", variable)).append("=").append(value(expression)).append("\n");
  text_.append(label).append(" endif\n");
}

void MacroText::alarm_if(std::string_view condition, int number, std::string_view message) {
  if (is_fanuc()) {
    text_.append("IF[").append(condition).append("]THEN #3000=").append(std::to_string(number));
    text_.append("(").append(message).append(")\n");
    return;
  }
  const std::string label = numbered("o", ++label_);
  text_.append(label).append(" if [").append(condition).append("]\n");
  text_.append("(abort, ").append(message).append(")\n");
  text_.append(label).append(" endif\n");
}

std::string macro_number(double value) {
  constexpr double millionths = 1e6;
  std::string text = number_text(std::round(value * millionths) / millionths);
  if (text.find('.') == std::string::npos) text += '.';
  return text;
}

}  // namespace ridgeline::macro
