#pragma once

#include <string>

#include "core/macro/result.hpp"
#include "core/macro/segment.hpp"

namespace ridgeline::macro {

/// Writes moves and events into a Result, in the order of motion.
class Recorder {
public:
  Recorder(Result& result, std::size_t move_limit, double rapid_feed)
      : result_(result), move_limit_(move_limit), rapid_feed_(rapid_feed) {}

  /// Index for Segment::shift_index; the table grows when the shift changes.
  std::uint32_t shift_index(const WorkShift& shift);
  void move(const Segment& segment);
  void event(std::string word, int program, int line);
  void axis(char axis, double to);
  std::size_t moves() const { return result_.motion.size(); }
  const Eigen::Vector3d& machine() const { return machine_; }
  /// Sets where the machine is without a move.
  void place(const Eigen::Vector3d& machine) { machine_ = machine; }

private:
  Result& result_;
  std::size_t move_limit_;
  double rapid_feed_;
  Eigen::Vector3d machine_ = Eigen::Vector3d::Zero();
};

/// Keeps the first `count` moves and what belongs to them, the first events, messages and prints,
/// and says so in the warnings: what an endless program did is the same again and again.
void shorten(Result& result, std::size_t count);

}  // namespace ridgeline::macro
