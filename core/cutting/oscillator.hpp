#pragma once

#include "core/cutting/compliance.hpp"

namespace ridgeline::cutting {

/// q'' + 2 zeta w q' + w^2 q = w^2 / k F over one step, F linear in it: exact.
struct StepMatrix {
  double qq = 0, qv = 0, vq = 0, vv = 0;  ///< free motion of displacement q and velocity v
  double q0 = 0, v0 = 0;                  ///< by the force at the start
  double q1 = 0, v1 = 0;                  ///< by the force at the end
};

StepMatrix step_matrix(const Mode& mode, double dt);

/// Modes of one direction in motion.
class Oscillator {
public:
  Oscillator(const Modes& modes, double dt);

  /// Displacement after a step from force F0 to F1, without taking it [mm].
  double ahead(double F0, double F1) const;
  void step(double F0, double F1);
  double displacement() const;

private:
  struct State {
    StepMatrix matrix;
    double q = 0;
    double v = 0;
  };
  std::vector<State> modes_;
};

}  // namespace ridgeline::cutting
