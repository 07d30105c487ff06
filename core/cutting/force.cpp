#include "core/cutting/force.hpp"

#include <cmath>
#include <numbers>

#include "core/cutting/rows.hpp"

namespace ridgeline::cutting {
namespace {

int samples_of(const ChipTable& table, Span span) {
  return span == Span::Pitch ? table.pitch_samples : table.cut.samples;
}

// D1 with the offset, repeated so that any index in [0, 2N] reads without wrapping.
Deflections repeated(const ChipTable& table, const Deflections& D1) {
  const auto N = static_cast<std::size_t>(table.cut.samples);
  Deflections twice(2 * N + 1);
  for (std::size_t i = 0, s = 0; i <= 2 * N; ++i) {
    twice[i] = D1[s] + offset_at(table.cut, static_cast<int>(i));
    s = s + 1 < D1.size() ? s + 1 : 0;
  }
  return twice;
}

}  // namespace

Eigen::Vector2d offset_at(const Cut& cut, int sample) {
  if (cut.cutter.offset == 0) return Eigen::Vector2d::Zero();
  const double at = 2 * std::numbers::pi * sample / cut.samples + cut.cutter.offset_angle;
  return cut.cutter.offset * Eigen::Vector2d(-std::cos(at), std::sin(at));
}

double greatest_deflection(const Cut& cut, const Deflections& D, const Deflections& centre) {
  double greatest = 0;
  for (std::size_t i = 0; i < D.size(); ++i) {
    const Eigen::Vector2d from = centre.empty() ? Eigen::Vector2d::Zero().eval() : centre[i];
    greatest = std::max(greatest, (D[i] - from).squaredNorm());
  }
  return std::sqrt(greatest) + cut.cutter.offset;
}

void scale_forces(ChipTable& table, double cut_scale, double edge_scale) {
  if (cut_scale == 1 && edge_scale == 1) return;
  for (ToothChips& tooth : table.teeth) {
    for (Chip& chip : tooth.chips) {
      chip.Fc *= cut_scale;
      chip.Fe *= edge_scale;
    }
  }
}

Revolution revolution_force(const ChipTable& table, const Deflections& D1, Span span) {
  const int samples = samples_of(table, span);
  const std::int32_t N = table.cut.samples;
  const Deflections D = repeated(table, D1);
  const auto at_theta_o = [&](const Earlier& earlier, std::int32_t shift) -> Eigen::Vector2d {
    const std::int32_t before = earlier.before - shift + N;
    const auto o = static_cast<std::size_t>(before);
    return D[o] + earlier.frac * (D[o + 1] - D[o]);
  };
  Revolution revolution;
  revolution.F.reserve(static_cast<std::size_t>(samples));
  for (int i = 0; i < samples; ++i) {
    int last_cutting = -1;
    const auto on_chip = [&](const Chip&, const Row& row, bool cuts, double) {
      revolution.cut.push_back(cuts ? 1 : 0);
      if (!cuts) return;
      ++revolution.cut_points;
      if (last_cutting == row.number) return;
      last_cutting = row.number;
      if (row.number == 0 || span == Span::Pitch) ++revolution.cut_steps;
    };
    revolution.F.push_back(force_at(table, i, D[static_cast<std::size_t>(i)], at_theta_o, on_chip));
  }
  if (span == Span::Pitch) revolution.cut_points *= teeth(table.cut.cutter);
  return revolution;
}

std::optional<double> machining_error(const ChipTable& table, const Revolution& revolution,
                                      const Deflections& D4, Span span, const Eigen::Vector3d& n) {
  const double r = table.cut.cutter.r;
  std::optional<double> e;
  std::size_t evaluated = 0;
  for (int i = 0; i < samples_of(table, span); ++i) {
    const Eigen::Vector2d U = D4[static_cast<std::size_t>(i)] + offset_at(table.cut, i);
    const double shift = U.dot(n.head<2>());
    for (int k = 0; k < teeth(table.cut.cutter); ++k) {
      const Row row = row_at(table, i, k);
      for (std::size_t index = row.from; index < row.to; ++index) {
        if (revolution.cut[evaluated++] == 0) continue;
        const Chip& chip = row.tooth->chips[index];
        const double left = r + chip.r * chip.N.dot(n) + shift;  // e'
        if (!e || left < *e) e = left;
      }
    }
  }
  return e;
}

}  // namespace ridgeline::cutting
