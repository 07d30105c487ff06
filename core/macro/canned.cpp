#include <cmath>

#include "core/macro/nc_executor.hpp"

namespace ridgeline::macro {

namespace {

constexpr double chip_clearance = 1;  // G73 and G83 stop or start this far from the last depth [mm]
constexpr int most_pecks = 100000;    // of one hole

}  // namespace

// G73 to G89 (control manual, drilling cycles): to the hole, to R, the hole itself, back to R (G99)
// or to the initial level (G98).
void NcExecutor::canned_cycle() {
  if (!cycle_.is_set) {
    cycle_ = {};
    cycle_.initial = state_.position[2];
    cycle_.R = cycle_.Z = cycle_.initial;
    cycle_.is_set = true;
  }
  read_cycle_words();
  const NcWords& words = *words_;
  const char repeat = words.has('K') ? 'K' : 'L';
  const bool has_repeat = words.has(repeat);
  const std::int64_t times =
      has_repeat ? rounded_integer(words[repeat], words.column_of(repeat)) : 1;
  for (std::int64_t i = 0; i < times; ++i) {
    Axes hole = target();  // in G91 one step farther each time
    hole[2] = state_.position[2];
    drill(hole, cycle_.initial);
  }
  moved_ = true;
}

// R and Z: in G91 from the initial level and from R.
void NcExecutor::read_cycle_words() {
  const bool is_absolute = state_.modal.distance == 900;
  const NcWords& words = *words_;
  if (words.has('R')) cycle_.R = (is_absolute ? 0 : cycle_.initial) + length_word('R');
  if (words.has('Z')) cycle_.Z = (is_absolute ? 0 : cycle_.R) + length_word('Z');
  if (words.has('Q')) cycle_.Q = std::abs(length_word('Q'));
  if (words.has('P')) cycle_.P = words['P'] / 1000;
  if (words.has('I')) cycle_.shift_i = length_word('I');
  if (words.has('J')) cycle_.shift_j = length_word('J');
}

void NcExecutor::cycle_move(MoveKind kind, int axis, double to) {
  Axes target = state_.position;
  target[static_cast<std::size_t>(axis)] = to;
  move_to(segment(kind), target);
}

void NcExecutor::cycle_dwell() {
  if (!(cycle_.P > 0)) return;
  Segment wait = segment(MoveKind::Dwell);
  wait.to = wait.from;
  wait.seconds = cycle_.P;
  send(wait);
}

// The tip leaves the wall along I and J, or along X by Q; `direction` -1 comes back.
void NcExecutor::cycle_shift(double direction) {
  const bool has_vector = cycle_.shift_i != 0 || cycle_.shift_j != 0;
  const double i = has_vector ? cycle_.shift_i : cycle_.Q;
  if (i != 0) cycle_move(MoveKind::Rapid, 0, state_.position[0] + direction * i);
  if (cycle_.shift_j != 0) {
    cycle_move(MoveKind::Rapid, 1, state_.position[1] + direction * cycle_.shift_j);
  }
}

// G73 and G83: depth by depth, back by a little (G73) or to R (G83).
void NcExecutor::peck() {
  const double R = cycle_.R, Z = cycle_.Z, Q = cycle_.Q;
  if ((R - Z) / Q > most_pecks) raise(AlarmNumber::ArgumentRange, "Q", words_->column_of('Q'));
  const bool clears = state_.modal.canned == 830;
  for (int i = 1;; ++i) {
    const double depth = std::max(Z, R - i * Q);
    const double above = R - (i - 1) * Q + chip_clearance;
    if (clears && above < state_.position[2]) cycle_move(MoveKind::Rapid, 2, above);
    cycle_move(MoveKind::Line, 2, depth);
    if (depth <= Z) return;
    cycle_move(MoveKind::Rapid, 2, clears ? R : std::min(R, depth + chip_clearance));
  }
}

// G87: in below the part beside the bore, back to the centre, and up.
void NcExecutor::bore_back(double initial) {
  cycle_shift(1);
  cycle_move(MoveKind::Rapid, 2, cycle_.R);
  cycle_shift(-1);
  cycle_move(MoveKind::Line, 2, cycle_.Z);
  cycle_dwell();
  cycle_shift(1);
  cycle_move(MoveKind::Rapid, 2, initial);
  cycle_shift(-1);
}

void NcExecutor::drill(const Axes& hole, double initial) {
  const int cycle = state_.modal.canned;
  move_to(segment(MoveKind::Rapid), hole);
  if (cycle == 870) {
    bore_back(initial);
    return;
  }
  const double back = state_.modal.return_level == 980 ? initial : cycle_.R;
  if (state_.position[2] != cycle_.R) cycle_move(MoveKind::Rapid, 2, cycle_.R);
  if ((cycle == 730 || cycle == 830) && cycle_.Q > 0 && cycle_.Z < cycle_.R) {
    peck();
  } else {
    cycle_move(MoveKind::Line, 2, cycle_.Z);
  }
  if (cycle != 810 && cycle != 850 && cycle != 860) cycle_dwell();
  if (cycle == 740 || cycle == 840 || cycle == 850 || cycle == 890) {
    cycle_move(MoveKind::Line, 2, cycle_.R);
  }
  if (cycle == 760) cycle_shift(1);
  if (state_.position[2] != back) cycle_move(MoveKind::Rapid, 2, back);
  if (cycle == 760) cycle_shift(-1);
}

}  // namespace ridgeline::macro
