#include "core/cutting/compliance.hpp"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <string>

#include "core/cutting/require.hpp"

namespace ridgeline::cutting {
namespace {

std::complex<double> sum_of_modes(const Modes& modes, double frequency) {
  std::complex<double> sum = 0;
  for (const auto& [fn, zeta, k] : modes) {
    const double ratio = frequency / fn;
    sum += 1 / k / std::complex<double>(1 - ratio * ratio, 2 * zeta * ratio);
  }
  return sum;
}

std::complex<double> interpolated(const MeasuredResponse& measured, double frequency) {
  const auto& [lines, values] = measured;
  if (frequency <= lines.front()) {
    return frequency < lines.front() ? values.front().real() : values.front();
  }
  if (frequency >= lines.back()) {
    const double fall = lines.back() / frequency;
    return values.back() * (fall * fall);
  }
  const auto above = static_cast<std::size_t>(
      std::upper_bound(lines.begin(), lines.end(), frequency) - lines.begin());
  const double s = (frequency - lines[above - 1]) / (lines[above] - lines[above - 1]);
  return values[above - 1] * (1 - s) + values[above] * s;
}

// Does |G| fall below half the power of line `top` before it rises above it, going by `step`?
bool stands_out(const MeasuredResponse& measured, std::size_t top, int step) {
  const double here = std::abs(measured.value[top]);
  const auto count = static_cast<std::ptrdiff_t>(measured.value.size());
  for (auto i = static_cast<std::ptrdiff_t>(top) + step; i >= 0 && i < count; i += step) {
    const double there = std::abs(measured.value[static_cast<std::size_t>(i)]);
    if (there > here) return false;
    if (there < here / std::numbers::sqrt2) return true;
  }
  return false;
}

// Local maxima of |G| of at least a tenth of the greatest that stand out on both sides: noise on
// the flank of a peak is none.
std::vector<double> peaks(const MeasuredResponse& measured) {
  const auto& [lines, values] = measured;
  double greatest = 0;
  for (const auto& value : values) greatest = std::max(greatest, std::abs(value));
  std::vector<double> found;
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    const bool is_large = std::abs(values[i]) >= greatest / 10;
    if (is_large && stands_out(measured, i, -1) && stands_out(measured, i, 1)) {
      found.push_back(lines[i]);
    }
  }
  return found;
}

void validate(const Direction& direction, const std::string& field) {
  if (const auto* modes = std::get_if<Modes>(&direction)) {
    for (const Mode& mode : *modes) {
      require_between("/case/modes_" + field, mode.frequency, 0.1, 1e6, "Hz");
      require_between("/case/modes_" + field, mode.damping, 1e-6, 0.999, "of critical damping");
      require_between("/case/modes_" + field, mode.stiffness, 1e-3, 1e9, "N/mm");
    }
    return;
  }
  const auto& [lines, values] = std::get<MeasuredResponse>(direction);
  require_between("/case/frf_" + field, static_cast<double>(lines.size()), 2, 1e6, "lines");
  require_between("/case/frf_" + field, static_cast<double>(values.size()),
                  static_cast<double>(lines.size()), static_cast<double>(lines.size()), "values");
  require_between("/case/frf_" + field, lines.front(), 0, 1e6, "Hz");
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double from = i == 0 ? 0 : lines[i - 1] * (1 + 1e-12);
    require_between("/case/frf_" + field, lines[i], from, 1e6, "Hz, ascending");
    require_between("/case/frf_" + field, std::abs(values[i]), 0, 1e3, "mm/N");
  }
}

}  // namespace

std::complex<double> compliance_at(const Direction& direction, double frequency) {
  if (const auto* modes = std::get_if<Modes>(&direction)) return sum_of_modes(*modes, frequency);
  return interpolated(std::get<MeasuredResponse>(direction), frequency);
}

std::vector<double> natural_frequencies(const Compliance& compliance) {
  std::vector<double> found;
  for (const Direction* direction : {&compliance.x, &compliance.y}) {
    if (const auto* modes = std::get_if<Modes>(direction)) {
      for (const Mode& mode : *modes) found.push_back(mode.frequency);
    } else {
      const std::vector<double> tops = peaks(std::get<MeasuredResponse>(*direction));
      found.insert(found.end(), tops.begin(), tops.end());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

const Modes& modes_of(const Direction& direction) {
  const auto* modes = std::get_if<Modes>(&direction);
  if (modes != nullptr) return *modes;
  throw Error(ErrorCode::Unsupported,
              "frf: a measured frequency response has no equation of motion, which the time domain "
              "and the stability test need; give modes fitted to it");
}

void validate(const Compliance& compliance) {
  validate(compliance.x, "x");
  validate(compliance.y, "y");
}

}  // namespace ridgeline::cutting
