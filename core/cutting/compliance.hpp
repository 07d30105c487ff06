#pragma once

#include <Eigen/Core>
#include <complex>
#include <variant>
#include <vector>

namespace ridgeline::cutting {

/// One mode of the tool in its holder at the tip: 1/k / (1 - (f/fn)^2 + 2 i zeta f/fn).
struct Mode {
  double frequency = 0;  ///< fn [Hz]
  double damping = 0;    ///< zeta [1]
  double stiffness = 0;  ///< k [N/mm]
};

/// No mode: rigid in that direction.
using Modes = std::vector<Mode>;

/// Measured frequency response: displacement by force, linear between the lines, e^{+iwt}. Below
/// the first line its real part holds (a hammer sees nothing at 0 Hz: give a static line from a fit
/// if there is one); above the last it falls as a mass does, with 1/f^2.
struct MeasuredResponse {
  std::vector<double> frequency;            ///< ascending [Hz]
  std::vector<std::complex<double>> value;  ///< [mm/N]
};

using Direction = std::variant<Modes, MeasuredResponse>;

/// Compliance of the tool tip across its axis, in two principal directions that are not coupled.
struct Compliance {
  Direction x;
  Direction y;
  /// Unit vectors of the two directions as columns, in X and Y of the cut: the feed turns, the
  /// machine does not.
  Eigen::Matrix2d axes = Eigen::Matrix2d::Identity();
};

/// G at a frequency [mm/N].
std::complex<double> compliance_at(const Direction& direction, double frequency);

/// Natural frequencies of both directions [Hz]: modes, or the peaks of a measurement.
std::vector<double> natural_frequencies(const Compliance& compliance);

/// The modes of a direction; throws Error{Unsupported} for a measurement: it has no equation of
/// motion.
const Modes& modes_of(const Direction& direction);

/// Throws Error{BadInput}.
void validate(const Compliance& compliance);

}  // namespace ridgeline::cutting
