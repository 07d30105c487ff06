#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/macro/profile.hpp"
#include "core/macro/recorder.hpp"
#include "core/macro/segment.hpp"

namespace ridgeline::macro {

/// Cutter compensation C, start-up type A (design section 2.5). Moves pass in program order;
/// a compensated one is held until the next move in the plane tells how its end is cut off.
/// Inside corners: where the offset paths meet. Outside: where the offset tangents meet up to a
/// turn of 90 degrees, else two points one radius beyond. Moves without motion in the plane
/// happen at the corner.
class Compensation {
public:
  Compensation(Recorder& recorder, const Profile& profile)
      : recorder_(recorder), profile_(profile) {}

  /// Raises 033, 034, 041.
  void move(const Segment& segment);
  /// An M, S or T function of a block; `alone`: the block had no move.
  void event(const std::string& word, int program, int line, bool alone);
  /// Brings out what is held; its end is perpendicular to its path.
  void flush();
  bool is_active() const { return active_; }

private:
  struct Function {
    std::string word;
    int program = 0;
    int line = 0;
  };
  using Held = std::variant<Segment, Function>;

  void hold(Held held, bool counts);
  void start(const Segment& segment);
  void cancel(const Segment& segment);
  void turn_corner(const Segment& next);
  /// Records the pending move up to `end`, then what was held, displaced like its end.
  void finish_pending(const Eigen::Vector2d& end);
  void record_line(const Segment& like, const Eigen::Vector3d& to);
  void check_direction(const Segment& segment, const Eigen::Vector3d& from,
                       const Eigen::Vector3d& to) const;

  Recorder& recorder_;
  const Profile& profile_;
  bool active_ = false;
  bool starting_ = false;                             ///< the pending move is the start-up
  std::optional<Segment> pending_;                    ///< its end is not known yet
  Eigen::Vector3d from_ = Eigen::Vector3d::Zero();    ///< where the pending move really begins
  Eigen::Vector2d vector_ = Eigen::Vector2d::Zero();  ///< offset vector in force, in the plane
  std::vector<Held> held_;
  int blind_ = 0;  ///< blocks without motion in the plane since the pending move
};

}  // namespace ridgeline::macro
