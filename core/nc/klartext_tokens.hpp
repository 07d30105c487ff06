#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/nc/tracer.hpp"

namespace ridgeline::nc {

/// Letters with the number behind them, if any: IX+5, FMAX, R0, DR+.
struct Token {
  std::string name;
  std::optional<Nano> value;
  char sign = 0;  ///< a sign without a number
  std::string text;
};

/// Takes the words of a Klartext block apart. Throws Error{BadFile}.
std::vector<Token> tokens_of(std::string_view rest, int line);

}  // namespace ridgeline::nc
