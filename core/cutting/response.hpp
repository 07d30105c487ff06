#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <vector>

#include "core/cutting/compliance.hpp"

namespace ridgeline::cutting {

using Forces = std::vector<Eigen::Vector3d>;       ///< on the tool, per sample [N]
using Deflections = std::vector<Eigen::Vector2d>;  ///< X, Y of the tool tip, per sample [mm]

/// Steady response of a compliance to a force that repeats: D2 = IFFT(G(k f1) FFT(F)), document 001
/// [0031]. Holds the plan and G of every bin; one thread at a time.
class Response {
public:
  /// samples in a period, and how often the period repeats [Hz].
  Response(const Compliance& compliance, int samples, double repetition);
  ~Response();
  Response(Response&&) noexcept;
  Response& operator=(Response&&) noexcept;

  /// Turns the principal directions: columns in X and Y of the cut.
  void turn(const Eigen::Matrix2d& axes);

  /// D2 of one period of force.
  Deflections deflections(const Forces& forces) const;

  /// D4: only the bins up to `cutoff` [Hz], a zero-phase brick wall.
  Deflections deflections(const Forces& forces, double cutoff) const;

private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace ridgeline::cutting
