#include "core/cutting/secants.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

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

// X, Y of each sample in turn, so many samples later.
Eigen::VectorXd moved_on(const Eigen::VectorXd& D, double samples) {
  if (samples == 0) return D;
  const Eigen::Index n = D.size() / 2;
  const double turn =
      -samples - static_cast<double>(n) * std::floor(-samples / static_cast<double>(n));
  const Eigen::Index whole = static_cast<Eigen::Index>(turn) % n;
  const double part = turn - std::floor(turn);
  Eigen::VectorXd out(D.size());
  for (Eigen::Index i = 0, from = whole; i < n; ++i) {
    const Eigen::Index next = from + 1 < n ? from + 1 : 0;
    out.segment<2>(2 * i) =
        D.segment<2>(2 * from) + part * (D.segment<2>(2 * next) - D.segment<2>(2 * from));
    from = next;
  }
  return out;
}

}  // namespace

Deflections moved_on(const Deflections& D, double samples) {
  Deflections out(D.size());
  Eigen::Map<Eigen::VectorXd>(out.front().data(), static_cast<Eigen::Index>(2 * D.size())) =
      moved_on(Eigen::VectorXd(flat(D)), samples);
  return out;
}

void Secants::clear() {
  differences_.clear();
  products_.resize(0, 0);
  has_last_ = false;
  later_ = 0;
}

void Secants::learn(const Eigen::VectorXd& D, const Eigen::VectorXd& R) {
  if (differences_.size() == most_differences) {
    differences_.pop_front();
    products_ = products_.bottomRightCorner(products_.rows() - 1, products_.cols() - 1).eval();
  }
  const Eigen::VectorXd dR = moved_on(R - last_.R, -later_);
  differences_.push_back({dR, moved_on(D - last_.D, -later_) + dR});
  const auto count = static_cast<Eigen::Index>(differences_.size());
  products_.conservativeResize(count, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    products_(count - 1, j) =
        differences_.back().R.dot(differences_[static_cast<std::size_t>(j)].R);
  }
  products_(count - 1, count - 1) *= 1 + damping;
}

// Least squares: R - sum share_i dR_i is least. R as when the differences were learnt.
Eigen::VectorXd Secants::shares(const Eigen::VectorXd& R) const {
  Eigen::VectorXd with_R(products_.rows());
  for (Eigen::Index i = 0; i < with_R.size(); ++i) {
    with_R[i] = differences_[static_cast<std::size_t>(i)].R.dot(R);
  }
  return products_.selfadjointView<Eigen::Lower>().ldlt().solve(with_R);
}

// What the differences explain of where D4 is.
Eigen::VectorXd Secants::explained(const Eigen::VectorXd& R) const {
  const Eigen::VectorXd share = shares(moved_on(R, -later_));
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(R.size());
  for (Eigen::Index i = 0; i < share.size(); ++i) {
    sum += share[i] * differences_[static_cast<std::size_t>(i)].D_and_R;
  }
  return moved_on(sum, later_);
}

Deflections Secants::ahead(const Deflections& D1, const Deflections& D4) const {
  if (differences_.empty() || differences_.front().R.size() != flat(D1).size()) return {};
  const Eigen::VectorXd R = flat(D4) - flat(D1);
  const Eigen::VectorXd more = explained(R);
  Deflections out = D4;
  Eigen::Map<Eigen::VectorXd>(out.front().data(), R.size()) -= more;
  const bool cancels = !(more.norm() <= flat(D4).norm());  // as in next()
  return cancels ? Deflections() : out;
}

Deflections Secants::next(const Deflections& D1, const Deflections& D4) {
  const Eigen::VectorXd D = flat(D1);
  const Eigen::VectorXd R = flat(D4) - D;
  if (!differences_.empty() && differences_.front().R.size() != D.size()) clear();
  if (has_last_) learn(D, R);
  last_ = {D, R};
  has_last_ = true;

  Eigen::VectorXd moved = D + R / 2;  // (3)..(5) with w1 = w2, while nothing is known
  if (!differences_.empty()) {
    const Eigen::VectorXd step = R - explained(R);
    const double longest = longest_step * std::max(D.norm(), flat(D4).norm());
    if (step.norm() <= longest) {
      moved = D + step;
    } else {
      clear();
    }
  }
  Deflections out(D1.size());
  Eigen::Map<Eigen::VectorXd>(out.front().data(), moved.size()) = moved;
  return out;
}

}  // namespace ridgeline::cutting
