#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/macro/compensation.hpp"
#include "core/macro/segment.hpp"

namespace ridgeline::macro {

/// Chamfers (,C) and roundings (,R) at the end of a straight move: the move waits for the next one
/// in the plane, both are shortened, and the chamfer or arc goes between.
class CornerBreak {
public:
  explicit CornerBreak(Compensation& next) : next_(next) {}

  /// Raises 055 when the moves are too short, or one of them is an arc.
  void move(const Segment& segment);
  void event(const std::string& word, int program, int line, bool alone);
  /// Brings out what is held, without a break.
  void flush();
  bool is_holding() const { return held_.has_value(); }

private:
  struct Function {
    std::string word;
    int program = 0;
    int line = 0;
    bool alone = false;
  };
  Compensation& next_;
  std::optional<Segment> held_;
  std::vector<Function> functions_;
};

}  // namespace ridgeline::macro
