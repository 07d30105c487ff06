#include <cmath>
#include <string>

#include "core/base/angle.hpp"
#include "core/macro/nc_executor.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

using Eigen::Vector3d;

namespace {

int integer_word(const NcWords& words, char letter, int otherwise) {
  if (!words.has(letter)) return otherwise;
  const std::int64_t value = rounded_integer(words[letter], words.column_of(letter));
  if (value < 0 || value > 1000000) {
    raise(AlarmNumber::ArgumentRange, std::string(1, letter), words.column_of(letter));
  }
  return static_cast<int>(value);
}

}  // namespace

// G10: L2 work offsets, L20 additional ones, L10..L13 offset memory, L50 and L52 parameters.
void NcExecutor::set_data() {
  const int L = integer_word(*words_, 'L', 1);
  switch (L) {
    case 2: set_work_offset_data(0, 6); break;
    case 20: set_work_offset_data(7, Offsets::work_offsets - 1); break;
    case 1:
    case 10:
    case 11:
    case 12:
    case 13: set_offset_data(L); break;
    case 3:
    case 50:
    case 52:
    case 70:
      setting_parameters_ = true;
      result_.warnings.push_back(numbered("G10 L", L) + " up to G11 is not simulated");
      break;
    default: raise(AlarmNumber::ArgumentRange, numbered("G10 L", L), words_->column_of('L'));
  }
}

void NcExecutor::set_work_offset_data(int first, int last) {
  const int number = integer_word(*words_, 'P', first == 0 ? state_.work_offset : 1);
  const int index = first == 0 ? number : 6 + number;
  if (index < first || index > last) {
    raise(AlarmNumber::ArgumentRange, numbered("G10 P", number), words_->column_of('P'));
  }
  Axes& offset = state_.offsets.work[static_cast<std::size_t>(index)];
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (!words_->has(axis_names[i])) continue;
    const double value = coordinate(axis_names[i]);
    offset[i] = state_.modal.distance == 910 ? offset[i] + value : value;
  }
  follow_machine(state_);
}

// L10 H geometry, L11 (and the old L1) H wear, L12 D geometry, L13 D wear.
void NcExecutor::set_offset_data(int L) {
  const int number = integer_word(*words_, 'P', 0);
  if (number < 1 || number >= Offsets::registers) {
    raise(AlarmNumber::IllegalOffsetNumber, "G10 P", words_->column_of('P'));
  }
  if (!words_->has('R')) raise(AlarmNumber::NoDataAfterAddress, "G10 R");
  Offsets& offsets = state_.offsets;
  const bool is_simple = state_.profile.offset_memory == OffsetMemory::A;
  const bool is_split = state_.profile.offset_memory == OffsetMemory::C;
  std::vector<double>& registers = L == 12 && is_split               ? offsets.radius_geometry
                                   : L == 13 && is_split             ? offsets.radius_wear
                                   : L == 10 || L == 12 || is_simple ? offsets.length_geometry
                                                                     : offsets.length_wear;
  double& offset = registers[static_cast<std::size_t>(number)];
  const double value = length_word('R');
  offset = state_.modal.distance == 910 ? offset + value : value;
}

void NcExecutor::local_system() {
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (words_->has(axis_names[i])) state_.local[i] = coordinate(axis_names[i]);
  }
  follow_machine(state_);
}

// G92: here the tool is at the given coordinates, in every work system; G52 of these axes ends.
void NcExecutor::preset_system() {
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (!words_->has(axis_names[i])) continue;
    state_.preset[i] += state_.position[i] + state_.local[i] - coordinate(axis_names[i]);
    state_.local[i] = 0;
  }
  follow_machine(state_);
}

// G92.1: the named axes lose G92 and G52; without a name all of them.
void NcExecutor::preset_system_off() {
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (has_axis_word() && !words_->has(axis_names[i])) continue;
    state_.preset[i] = state_.local[i] = 0;
  }
  follow_machine(state_);
}

// G68. Under mirror image and scaling the centre is an image too, and one mirrored axis of the
// plane turns the other way. Incremental moves after G68 turn about the position at G68 until the
// first absolute move.
void NcExecutor::rotation_on() {
  if (compensation_.is_active() && state_.rotation.is_active) {
    raise(AlarmNumber::PlaneMismatch, "G68 in cutter compensation");
  }
  const Vector3d before = transformed(state_, linear(state_.position));
  Rotation rotation;
  rotation.is_active = true;
  rotation.plane = plane_of(state_.modal);
  rotation.centre = linear(state_.position);
  const path::PlaneAxes axes = path::axes_of(rotation.plane);
  for (const int axis : {axes.first, axes.second}) {
    const char name = axis_names[axis];
    if (!words_->has(name)) continue;
    const double value = coordinate(name);
    rotation.centre[axis] = state_.modal.distance == 910 ? rotation.centre[axis] + value : value;
  }
  rotation.centre = imaged(state_, rotation.centre);
  const double side = reverses_arcs(state_, rotation.plane) ? -1 : 1;
  const double angle = words_->has('R') ? side * angle_word('R') : 0;
  rotation.cosine = std::cos(radians(angle));
  rotation.sine = std::sin(radians(angle));
  state_.rotation = rotation;
  state_.rotation.drift = before - transformed(state_, linear(state_.position));
}

void NcExecutor::rotation_off() {
  state_.modal.rotation = 690;
  if (!state_.rotation.is_active) return;
  state_.rotation.is_active = false;
  follow_machine(state_);
}

// G51 X Y Z P, or I J K for each axis; without a point in thousandths.
void NcExecutor::scaling_on() {
  Scaling scaling;
  scaling.is_active = true;
  const auto factor = [this](char letter) {
    return words_->is_scaled(letter) ? (*words_)[letter] / 1000 : (*words_)[letter];
  };
  for (int i = 0; i < 3; ++i) {
    scaling.centre[i] = words_->has(axis_names[i]) ? coordinate(axis_names[i])
                                                   : state_.position[static_cast<std::size_t>(i)];
    const char own = "IJK"[i];
    if (words_->has('P')) scaling.factor[i] = factor('P');
    if (words_->has(own)) scaling.factor[i] = factor(own);
  }
  if (scaling.factor.cwiseAbs().minCoeff() < 1e-9) {
    raise(AlarmNumber::ArgumentRange, "a scale of 0", words_->column_of('P'));
  }
  state_.scaling = scaling;
  state_.modal.scaling = 510;
  follow_machine(state_);
}

void NcExecutor::mirror(bool on) {
  bool any = false;
  for (int i = 0; i < 3; ++i) {
    if (!words_->has(axis_names[i])) continue;
    any = true;
    state_.mirror.centre[i] = coordinate(axis_names[i]);
    state_.mirror.factor[i] = on ? -1 : 1;
  }
  if (!any && !on) state_.mirror.factor.setOnes();
  state_.mirror.is_active = state_.mirror.factor.minCoeff() < 0;
  state_.modal.mirror = state_.mirror.is_active ? 511 : 501;
  follow_machine(state_);
}

}  // namespace ridgeline::macro
