#include "core/cutting/cutter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "core/base/error.hpp"
#include "core/cutting/require.hpp"

namespace ridgeline::cutting {

using std::numbers::pi;

std::vector<double> equal_pitch(int z) {
  return std::vector<double>(static_cast<std::size_t>(std::max(z, 0)), 2 * pi / z);
}

bool is_periodic(const Cutter& cutter) {
  const double even = 2 * pi / teeth(cutter);
  const auto differs = [even](double pitch) { return std::abs(pitch - even) > 1e-12; };
  const auto is_out = [&](double runout) { return runout != cutter.runout.front(); };
  return cutter.offset == 0 && std::none_of(cutter.pitch.begin(), cutter.pitch.end(), differs) &&
         std::none_of(cutter.runout.begin(), cutter.runout.end(), is_out);
}

double tooth_angle(const Cutter& cutter, int k) {
  const int z = teeth(cutter), turns = k / z;
  const auto first = cutter.pitch.begin();
  return 2 * pi * turns + std::accumulate(first, first + k % z, 0.0);
}

double tooth_radius(const Cutter& cutter, int k) {
  if (cutter.runout.empty()) return cutter.r;
  return cutter.r + cutter.runout[static_cast<std::size_t>(k % teeth(cutter))];
}

double lag(const Cutter& cutter, double sin_q, double cos_q, double z) {
  return lag(cutter, std::tan(cutter.helix), sin_q, cos_q, z);
}

namespace {

// Width of the chip r dq, or length of the edge r dq sqrt(1 + (sin q dpsi/dq)^2).
double ball_width(const Cutter& cutter, double sin_q, double cos_q, double dq) {
  const double chip = cutter.r * dq;
  if (cutter.chip_width == ChipWidth::Chip) return chip;
  const double tan_beta = std::tan(cutter.helix);
  const double slope =
      cutter.lag == LagLaw::ConstantLead ? sin_q * tan_beta : tan_beta / (1 + cos_q);
  return chip * std::hypot(1, sin_q * slope);
}

}  // namespace

std::vector<Element> elements(const Cutter& cutter) {
  std::vector<Element> row(static_cast<std::size_t>(cutter.elements));
  for (std::size_t j = 0; j < row.size(); ++j) {
    const double middle = (static_cast<double>(j) + 0.5) / cutter.elements;
    Element& element = row[j];
    if (cutter.kind == CutterKind::Ball) {
      const double q = middle * cutter.q_end;
      element.sin_q = std::sin(q);
      element.cos_q = std::cos(q);
      element.z = cutter.r * (1 - element.cos_q);
      element.width =
          ball_width(cutter, element.sin_q, element.cos_q, cutter.q_end / cutter.elements);
    } else {
      element.z = middle * cutter.height;
      const double dz = cutter.height / cutter.elements;
      element.width = cutter.chip_width == ChipWidth::Chip ? dz : dz / std::cos(cutter.helix);
    }
    element.psi = lag(cutter, element.sin_q, element.cos_q, element.z);
  }
  return row;
}

void validate(const Cutter& cutter) {
  constexpr int most_teeth = 100;
  constexpr int most_elements = 4096;
  require_between("/case/tool/z", teeth(cutter), 1, most_teeth, "");
  require_between("/case/tool/r", cutter.r, 1e-3, 1e3, "mm");
  require_between("/case/tool/helix_deg", cutter.helix, -1.5, 1.5, "rad");
  require_between("/case/tool/nq", cutter.elements, 1, most_elements, "elements");
  require_between("/case/tool/q_end_deg", cutter.q_end, 0.01, pi - 0.01, "rad");
  double turn = 0;
  for (const double pitch : cutter.pitch) {
    require_between("/case/tool/pitch_deg", pitch, 1e-3, 2 * pi, "rad");
    turn += pitch;
  }
  require_between("/case/tool/pitch_deg", turn, 2 * pi - 1e-9, 2 * pi + 1e-9, "rad in sum");
  if (!cutter.runout.empty() && cutter.runout.size() != cutter.pitch.size()) {
    throw Error(ErrorCode::BadInput,
                "runout_mm: " + std::to_string(cutter.runout.size()) + " values for " +
                    std::to_string(teeth(cutter)) + " teeth; give one for each tooth",
                {.field = "/case/tool/runout_mm"});
  }
  for (const double runout : cutter.runout) {
    require_between("/case/tool/runout_mm", runout, -cutter.r / 4, cutter.r / 4, "mm");
  }
  require_between("/case/tool/offset_mm", cutter.offset, 0, cutter.r / 4, "mm");
  require_between("/case/tool/offset_deg", cutter.offset_angle, -100, 100, "rad");
  if (cutter.kind == CutterKind::Square) {
    require_between("/case/engagement/ap", cutter.height, 1e-4, 1e3, "mm");
  }
}

}  // namespace ridgeline::cutting
