#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/cutting/chips.hpp"
#include "core/cutting/response.hpp"

namespace ridgeline::cutting {

/// Which samples are evaluated. Pitch: one tooth pitch stands for the revolution; only for a table
/// with pitch_samples and a deflection that repeats with the teeth, which hides flips.
enum class Span { Revolution, Pitch };

/// Force of a revolution (or pitch) under one deflection.
struct Revolution {
  Forces F;                       ///< N samples, or N / z [N]
  std::vector<std::uint8_t> cut;  ///< of each chip in the order evaluated: does it cut?
  int cut_points = 0;             ///< how many chips cut, all teeth
  int cut_steps = 0;              ///< samples of a whole revolution in which tooth 0 cuts
};

/// Steps S201..S207: F(theta) under the first deflection D1, of N samples (a pitch: N / z). D1
/// must lie within table.around.
Revolution revolution_force(const ChipTable& table, const Deflections& D1, Span span);

/// (25)..(27): smallest e' of all points that cut, at the deflection D4; `revolution` is the last
/// force evaluation. nullopt when nothing cuts. > 0: material left, < 0: overcut [mm].
/// `n`: unit, from the contact point of the surface to O'.
std::optional<double> machining_error(const ChipTable& table, const Revolution& revolution,
                                      const Deflections& D4, Span span, const Eigen::Vector3d& n);

/// Largest |D| with the offset of the axis added, what the reach of a table must cover [mm]. With a
/// centre of as many samples: largest |D - centre|.
double greatest_deflection(const Cut& cut, const Deflections& D, const Deflections& centre = {});

/// K_c and K_e of every chip times these.
void scale_forces(ChipTable& table, double cut_scale, double edge_scale);

}  // namespace ridgeline::cutting
