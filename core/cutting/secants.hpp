#pragma once

#include <Eigen/Core>
#include <deque>

#include "core/cutting/response.hpp"

namespace ridgeline::cutting {

/// What the last loops told of the map D1 -> D4 around its fixed point: differences of D1 and of
/// the residual R = D4 - D1 from loop to loop. The next D1 takes away the part of R that they
/// explain (Anderson's acceleration; D. G. Anderson, J. ACM 12, 1965). The differences of the cuts
/// before serve too: along a path the map changes little.
class Secants {
public:
  /// The next D1 after a loop from D1 to D4.
  Deflections next(const Deflections& D1, const Deflections& D4);

  /// Where a cut like the one that converged from D1 to D4 begins best; empty: nothing is known.
  Deflections ahead(const Deflections& D1, const Deflections& D4) const;

  /// The next loop is of another cut: no difference between it and the last one.
  void begin_cut() { has_last_ = false; }

  /// The next cut does the same so many samples later; all that was learnt moves with it.
  void move_on(double samples) { later_ += samples; }

  /// What was learnt holds no longer: the tool stands another way to the work.
  void clear();

private:
  struct Loop {
    Eigen::VectorXd D, R;
  };
  struct Difference {
    Eigen::VectorXd R;
    Eigen::VectorXd D_and_R;  ///< sum of both
  };
  void learn(const Eigen::VectorXd& D, const Eigen::VectorXd& R);
  Eigen::VectorXd shares(const Eigen::VectorXd& R) const;
  Eigen::VectorXd explained(const Eigen::VectorXd& R) const;

  std::deque<Difference> differences_;
  Eigen::MatrixXd products_;  ///< of the R of the differences, the lower half
  Loop last_;
  bool has_last_ = false;
  double later_ = 0;  // than where the differences were learnt [samples]
};

/// The deflection of one period, so many samples later; between samples on the line.
Deflections moved_on(const Deflections& D, double samples);

}  // namespace ridgeline::cutting
