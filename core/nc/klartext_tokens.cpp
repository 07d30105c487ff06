#include "core/nc/klartext_tokens.hpp"

#include "core/nc/g_code_block.hpp"

namespace ridgeline::nc {

std::vector<Token> tokens_of(std::string_view rest, int line) {
  std::vector<Token> tokens;
  for (rest = trimmed(rest); !rest.empty(); rest = trimmed(rest)) {
    const std::string_view all = rest;
    Token token;
    while (!rest.empty() && is_letter(rest[0])) {
      token.name += upper_case(rest[0]);
      rest.remove_prefix(1);
    }
    token.value = take_number(rest);
    if (!token.value && (rest.starts_with('+') || rest.starts_with('-'))) {
      token.sign = rest[0];
      rest.remove_prefix(1);
    }
    if (all.size() == rest.size()) {
      Spot{line, std::string(all.substr(0, 1))}.bad("is not a word of a program");
    }
    token.text = all.substr(0, all.size() - rest.size());
    tokens.push_back(token);
  }
  return tokens;
}

}  // namespace ridgeline::nc
