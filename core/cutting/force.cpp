#include "core/cutting/force.hpp"

#include <cmath>
#include <numbers>

#include "core/cutting/chip_force.hpp"

namespace ridgeline::cutting {
namespace {

// One tooth at one sample: chips[from] .. chips[to] of its table, theta_o shifted back by `shift`.
struct Row {
  const ToothChips* tooth = nullptr;
  std::size_t from = 0;
  std::size_t to = 0;
  std::int32_t shift = 0;
  bool is_tooth_0 = false;
};

Row row_at(const ChipTable& table, int sample, int k) {
  const int N = table.cut.samples;
  const std::int32_t shift = table.pitch_samples * k;  // 0 when each tooth has its own table
  const int at = sample + shift < N ? sample + shift : sample + shift - N;
  const ToothChips& tooth = table.teeth[table.pitch_samples > 0 ? 0 : static_cast<std::size_t>(k)];
  return {.tooth = &tooth,
          .from = static_cast<std::size_t>(tooth.first[static_cast<std::size_t>(at)]),
          .to = static_cast<std::size_t>(tooth.first[static_cast<std::size_t>(at) + 1]),
          .shift = shift,
          .is_tooth_0 = k == 0};
}

int samples_of(const ChipTable& table, Span span) {
  return span == Span::Pitch ? table.pitch_samples : table.cut.samples;
}

// Rotating offset of the tool axis: it displaces every edge as a deflection does.
Eigen::Vector2d offset_at(const Cut& cut, int sample) {
  if (cut.cutter.offset == 0) return Eigen::Vector2d::Zero();
  const double at = 2 * std::numbers::pi * sample / cut.samples + cut.cutter.offset_angle;
  return cut.cutter.offset * Eigen::Vector2d(-std::cos(at), std::sin(at));
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

double greatest_deflection(const ChipTable& table, const Deflections& D) {
  double greatest = 0;
  for (const Eigen::Vector2d& U : D) greatest = std::max(greatest, U.squaredNorm());
  return std::sqrt(greatest) + table.cut.cutter.offset;
}

Revolution revolution_force(const ChipTable& table, const Deflections& D1, Span span) {
  const int samples = samples_of(table, span);
  const std::size_t terms = table.curves.size();
  const auto back = static_cast<std::size_t>(table.cut.earlier_teeth - 1);
  const std::int32_t N = table.cut.samples;
  const Deflections D = repeated(table, D1);
  Revolution revolution;
  revolution.F.assign(static_cast<std::size_t>(samples), Eigen::Vector3d::Zero());
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d U = D[static_cast<std::size_t>(i)];
    Eigen::Vector3d F = Eigen::Vector3d::Zero();
    for (int k = 0; k < teeth(table.cut.cutter); ++k) {
      const Row row = row_at(table, i, k);
      const auto at_theta_o = [&](const Earlier& earlier) -> Eigen::Vector2d {
        const auto o = static_cast<std::size_t>(earlier.before - row.shift + N);
        return D[o] + earlier.frac * (D[o + 1] - D[o]);
      };
      int cut_here = 0;
      for (std::size_t index = row.from; index < row.to; ++index) {
        const ChipPlace at{row.tooth, index, terms, back};
        const double t = is_engaged(table, at, U) ? chip_thickness(table, at, U, at_theta_o) : 0;
        const bool cuts = t > least_chip;
        revolution.cut.push_back(cuts ? 1 : 0);
        if (!cuts) continue;
        F += at.chip().Fe + t * at.chip().Fc;  // (14)..(16), (23), (24)
        ++cut_here;
      }
      revolution.cut_points += cut_here;
      if (cut_here > 0 && (row.is_tooth_0 || span == Span::Pitch)) ++revolution.cut_steps;
    }
    revolution.F[static_cast<std::size_t>(i)] = F;
  }
  if (span == Span::Pitch) revolution.cut_points *= teeth(table.cut.cutter);
  return revolution;
}

std::optional<double> machining_error(const ChipTable& table, const Revolution& revolution,
                                      const Deflections& D4, Span span) {
  std::optional<double> e;
  std::size_t evaluated = 0;
  for (int i = 0; i < samples_of(table, span); ++i) {
    const Eigen::Vector2d U = D4[static_cast<std::size_t>(i)] + offset_at(table.cut, i);
    const double shift = U.dot(table.cut.n.head<2>());
    for (int k = 0; k < teeth(table.cut.cutter); ++k) {
      const Row row = row_at(table, i, k);
      for (std::size_t index = row.from; index < row.to; ++index) {
        if (revolution.cut[evaluated++] == 0) continue;
        const double left = row.tooth->chips[index].depth + shift;  // e'
        if (!e || left < *e) e = left;
      }
    }
  }
  return e;
}

}  // namespace ridgeline::cutting
