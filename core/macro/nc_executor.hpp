#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "core/macro/compensation.hpp"
#include "core/macro/corner_break.hpp"
#include "core/macro/nc_words.hpp"
#include "core/macro/recorder.hpp"
#include "core/macro/state.hpp"

namespace ridgeline::macro {

/// What a block asks of the program flow.
struct BlockEffect {
  bool moved = false;  ///< had a move command: G66 calls its macro after it
  enum class Flow { Next, End, Call, Return } flow = Flow::Next;
};

/// Executes NC blocks (design section 2.5): changes the state and sends moves through corner
/// breaking and cutter compensation to the record.
class NcExecutor {
public:
  NcExecutor(State& state, Recorder& recorder, Result& result)
      : state_(state),
        recorder_(recorder),
        result_(result),
        compensation_(recorder, state.profile),
        corner_break_(compensation_) {}

  BlockEffect execute(const NcWords& words, int program, int line);
  /// Of a block whose words are arguments of G66.1, only the modal G codes.
  void execute_modes(const NcWords& words);
  /// Brings out moves that still wait for the next one.
  void finish();
  int ended_modal_calls = 0;  ///< G67 of the last block
  const NcWords& words() const { return *words_; }

private:
  // nc_executor.cpp: the block, one G code at a time
  void apply_g(int code, int column);
  bool apply_modal(int code);
  void set_motion(int code);
  void select_plane(int code);
  bool is_additional_offset() const;
  void select_work_offset(int code);
  void select_units(int code);
  void apply_length(int code);
  void functions_before_move();
  void functions_after_move(BlockEffect& effect);
  void function(const std::string& word);
  bool has_axis_word() const;
  bool run_special();
  void dwell();

  // nc_setting.cpp: G codes that set coordinates
  void set_data();
  void set_work_offset_data(int first, int last);
  void set_offset_data(int L);
  void local_system();
  void preset_system();
  void preset_system_off();
  void rotation_on();
  void rotation_off();
  void scaling_on();
  void mirror(bool on);

  // nc_motion.cpp: moves
  Axes target();
  void polar_target(Axes& target);
  void drop_drift();
  double coordinate(char letter) const;
  double length_word(char letter) const;
  double angle_word(char letter) const;
  void straight(MoveKind kind, const Axes& target);
  void arc(const Axes& target);
  Eigen::Vector2d arc_centre(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                             bool counter_clockwise) const;
  void move_to(Segment segment, const Axes& target);
  Segment segment(MoveKind kind);
  void send(const Segment& segment);
  double feed_of(double length) const;
  double side_offset() const;
  void machine_move();
  void reference_check();
  void reference_return(int code);
  void from_reference();
  void skip_move();

  // canned.cpp: drilling cycles
  void canned_cycle();
  void read_cycle_words();
  void drill(const Axes& hole, double initial);
  void peck();
  void bore_back(double initial);
  void cycle_shift(double direction);
  void cycle_move(MoveKind kind, int axis, double to);
  void cycle_dwell();

  State& state_;
  Recorder& recorder_;
  Result& result_;
  Compensation compensation_;
  CornerBreak corner_break_;
  const NcWords* words_ = nullptr;
  int program_ = 0;
  int line_ = 0;
  bool moved_ = false;
  bool switches_compensation_ = false;  ///< this block starts or cancels it
  bool setting_parameters_ = false;     ///< between G10 L50 and G11
  Axes intermediate_{};                 ///< point of the last G28 or G30, for G29
  int one_shot_ = 0;                    ///< G code of group 00 in this block
  struct Cycle {
    double R = 0, Z = 0, Q = 0, P = 0, shift_i = 0, shift_j = 0;
    double initial = 0;
    bool is_set = false;
  } cycle_;
};

}  // namespace ridgeline::macro
