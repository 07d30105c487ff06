#include "core/cutting/secants.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace ridgeline::cutting {
namespace {

// Enough for the few harmonics round a resonance, in both directions. Measured on the mould path of
// cutting_bench at 3000 rev/min: 4 need 1.0, 8 and 12 need 0.9 of the loops of these.
constexpr std::size_t most_differences = 12;

// Part of its own square added to each difference: differences that say the same share the work,
// and the jumps of the edge force do not pass for slopes.
constexpr double damping = 1e-3;

// A step this much beyond what it starts from comes from differences that cancel.
constexpr double longest_step = 10;

Eigen::Map<const Eigen::VectorXd> flat(const Deflections& D) {
  return {D.front().data(), static_cast<Eigen::Index>(2 * D.size())};
}

}  // namespace

void Secants::clear() {
  differences_.clear();
  has_last_ = false;
}

// Least squares: R - sum share_i dR_i is least.
Eigen::VectorXd Secants::shares(const Eigen::VectorXd& R) const {
  const auto count = static_cast<Eigen::Index>(differences_.size());
  Eigen::MatrixXd products(count, count);
  Eigen::VectorXd with_R(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd& dR = differences_[static_cast<std::size_t>(i)].R;
    with_R[i] = dR.dot(R);
    for (Eigen::Index j = 0; j <= i; ++j)
      products(i, j) = dR.dot(differences_[static_cast<std::size_t>(j)].R);
    products(i, i) *= 1 + damping;
  }
  return products.selfadjointView<Eigen::Lower>().ldlt().solve(with_R);
}

Deflections Secants::next(const Deflections& D1, const Deflections& D4) {
  const Eigen::VectorXd D = flat(D1);
  const Eigen::VectorXd R = flat(D4) - D;
  if (!differences_.empty() && differences_.front().D.size() != D.size()) clear();
  if (has_last_) differences_.push_back({D - last_.D, R - last_.R});
  if (differences_.size() > most_differences) differences_.pop_front();
  last_ = {D, R};
  has_last_ = true;

  Eigen::VectorXd moved = D + R / 2;  // (3)..(5) with w1 = w2, while nothing is known
  if (!differences_.empty()) {
    const Eigen::VectorXd share = shares(R);
    Eigen::VectorXd step = R;
    for (Eigen::Index i = 0; i < share.size(); ++i) {
      const Pair& difference = differences_[static_cast<std::size_t>(i)];
      step -= share[i] * (difference.D + difference.R);
    }
    const double longest = longest_step * std::max(D.norm(), flat(D4).norm());
    if (step.norm() <= longest)
      moved = D + step;
    else
      clear();
  }
  Deflections out(D1.size());
  Eigen::Map<Eigen::VectorXd>(out.front().data(), moved.size()) = moved;
  return out;
}

}  // namespace ridgeline::cutting
