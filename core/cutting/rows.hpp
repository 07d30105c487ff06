#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "core/cutting/chip_force.hpp"

namespace ridgeline::cutting {

/// One tooth at one sample: chips[from] .. chips[to] of its table. A table that stands for all
/// teeth gives theta_o of tooth 0; tooth k was there `shift` samples earlier.
struct Row {
  const ToothChips* tooth = nullptr;
  std::size_t from = 0;
  std::size_t to = 0;
  std::int32_t shift = 0;
  int number = 0;  ///< of the tooth
};

/// Row of tooth k at a sample in [0, N).
inline Row row_at(const ChipTable& table, int sample, int k) {
  const int N = table.cut.samples;
  const std::int32_t shift = table.pitch_samples * k;  // 0 when each tooth has its own table
  const int at = sample + shift < N ? sample + shift : sample + shift - N;
  const ToothChips& tooth = table.teeth[table.pitch_samples > 0 ? 0 : static_cast<std::size_t>(k)];
  return {.tooth = &tooth,
          .from = static_cast<std::size_t>(tooth.first[static_cast<std::size_t>(at)]),
          .to = static_cast<std::size_t>(tooth.first[static_cast<std::size_t>(at) + 1]),
          .shift = shift,
          .number = k};
}

/// Rotating offset of the tool axis from the spindle axis: it displaces every edge as a deflection
/// does.
Eigen::Vector2d offset_at(const Cut& cut, int sample);

/// Sum of the elementary forces (14)..(16), (23), (24) on the tool at one sample, displaced by U.
/// `deflection_at(earlier, shift)` gives the displacement at theta_o; `on_chip(chip, row, cuts, t)`
/// sees every chip in order.
template <typename DeflectionAt, typename OnChip>
Eigen::Vector3d force_at(const ChipTable& table, int sample, const Eigen::Vector2d& U,
                         const DeflectionAt& deflection_at, const OnChip& on_chip) {
  const std::size_t terms = table.curves.size();
  const auto back = static_cast<std::size_t>(table.cut.earlier_teeth - 1);
  Eigen::Vector3d F = Eigen::Vector3d::Zero();
  for (int k = 0; k < teeth(table.cut.cutter); ++k) {
    const Row row = row_at(table, sample, k);
    const auto at_theta_o = [&](const Earlier& earlier) -> Eigen::Vector2d {
      return deflection_at(earlier, row.shift);
    };
    for (std::size_t index = row.from; index < row.to; ++index) {
      const ChipPlace at{row.tooth, index, terms, back};
      const bool is_in = at.chip().is_inside || is_engaged(table, at, U);
      const double t = is_in ? chip_thickness(table, at, U, at_theta_o) : 0;
      const bool cuts = t > least_chip;
      on_chip(at.chip(), row, cuts, t);
      if (cuts) F += at.chip().Fe + t * at.chip().Fc;
    }
  }
  return F;
}

}  // namespace ridgeline::cutting
