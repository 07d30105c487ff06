#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/macro/alarm.hpp"
#include "core/macro/value.hpp"
#include "core/path/motion.hpp"

namespace ridgeline::macro {

enum class MoveKind : std::uint8_t { Rapid, Line, Arc, Dwell };

/// One move that a program made, after offsets, rotation and compensation. mm; feeds as the NC
/// language has them, mm/min. Small, because programs make millions: what few moves need stands in
/// tables of the Result.
struct Move {
  MoveKind kind = MoveKind::Rapid;
  bool machine_fixed = false;  ///< G53, G28, G30: commanded in machine coordinates
  std::int32_t program = 0;    ///< O number that commanded it
  std::int32_t line = 0;       ///< of that program's text
  std::uint32_t shift = 0;     ///< index into Result::shifts
  std::uint32_t detail = 0;    ///< index into Result::arcs or Result::dwells
  Eigen::Vector3d to = Eigen::Vector3d::Zero();  ///< work coordinates of the active offset
  double feed = 0;                               ///< [mm/min]; 0 for rapids and dwells
};

/// What an arc has besides its end.
struct ArcDetail {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< work coordinates, at the start's height
  path::ArcPlane plane = path::ArcPlane::XY;
  path::ArcSense sense = path::ArcSense::CounterClockwise;
  int turns = 0;  ///< full circles that it contains
};

/// What turns work into machine coordinates during some moves.
struct WorkShift {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  ///< machine minus work coordinates
  Eigen::Vector3d local = Eigen::Vector3d::Zero();  ///< the part that G52 and G92 give
  int work_offset = 54;                             ///< 54..59; G54.1 Pn: 541000 + n
  int length_code = 49;                             ///< 43, 44, 49
  int H = 0;
  friend bool operator==(const WorkShift&, const WorkShift&) = default;
};

/// Position of an axis other than X, Y, Z that a move brought it to [deg or mm].
struct AxisMove {
  std::size_t move = 0;  ///< index
  char axis = 'A';
  double to = 0;
};

/// What happened between moves: M, S and T functions, and the work offset in force.
struct Event {
  std::size_t before = 0;  ///< index of the move that follows
  std::string word;        ///< e.g. "M8", "S2000", "T5", "G55"
  int program = 0;
  int line = 0;
};

/// One executed block.
struct TraceStep {
  int program = 0;
  int line = 0;
  int level = 0;  ///< macro level
  std::string text;
  std::optional<int> variable;  ///< assigned by the block
  Value value;
  std::size_t moves = 0;  ///< moves made so far
};

/// Everything that a run gives. After an alarm: what was done before it.
struct Result {
  std::optional<Alarm> alarm;
  std::vector<Move> motion;
  std::vector<WorkShift> shifts;
  std::vector<ArcDetail> arcs;
  std::vector<double> dwells;  ///< [s]
  std::vector<AxisMove> axes;
  std::vector<Event> events;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< at the end, work coordinates
  Eigen::Vector3d machine = Eigen::Vector3d::Zero();
  std::map<int, Value> variables;     ///< commons named or written, system variables written
  std::map<int, Value> locals;        ///< of the main program, those that are not vacant
  std::vector<std::string> messages;  ///< #3006 and operator messages
  std::vector<std::string> prints;    ///< lines of DPRNT
  std::vector<std::string> warnings;  ///< e.g. reads that a control would do ahead of the motion
  std::uint64_t statements = 0;       ///< blocks executed
  int tool = 0;
  double spindle_speed = 0;  ///< [rev/min]
  double seconds = 0;        ///< machining time: path over feed, dwells, rapids
  std::vector<TraceStep> trace;
};

/// Machine position of the end of a move [mm].
inline Eigen::Vector3d machine_of(const Result& result, const Move& move) {
  return move.to + result.shifts[move.shift].shift;
}
/// Of a move of kind Arc.
inline const ArcDetail& arc_of(const Result& result, const Move& move) {
  return result.arcs[move.detail];
}

}  // namespace ridgeline::macro
