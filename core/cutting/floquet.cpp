#include "core/cutting/floquet.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/cutting/oscillator.hpp"
#include "core/cutting/rows.hpp"

namespace ridgeline::cutting {
namespace {

// dF(n) = now dU(n) + sum of taps dU(n - lag).
struct Tap {
  int lag = 0;
  Eigen::Matrix2d matrix;
};
struct Linear {
  Eigen::Matrix2d now = Eigen::Matrix2d::Zero();
  std::vector<Tap> taps;
};

// Steady displacement of the edge at any sample, repeating.
class Steady {
public:
  Steady(const Cut& cut, const Deflections& D) : cut_(cut), D_(D) {}
  Eigen::Vector2d at(int n) const {
    const auto size = static_cast<int>(D_.size());
    return D_[static_cast<std::size_t>(((n % size) + size) % size)] + offset_at(cut_, n);
  }
  Eigen::Vector2d between(double n) const {
    const double below = std::floor(n);
    const auto from = static_cast<int>(below);
    return at(from) + (n - below) * (at(from + 1) - at(from));
  }

private:
  const Cut& cut_;
  const Deflections& D_;
};

// The steady cut, looked at chip by chip.
class SteadyCut {
public:
  SteadyCut(const ChipTable& table, const Deflections& D, Engaging engaging)
      : table_(table), steady_(table.cut, D), engaging_(engaging) {}

  /// Linear force at a sample.
  Linear linear_at(int n) const {
    Linear linear;
    std::map<int, Eigen::Matrix2d> taps;
    for (int k = 0; k < teeth(table_.cut.cutter); ++k) {
      const Row row = row_of(n, k);
      for (std::size_t index = row.from; index < row.to; ++index) {
        const ChipPlace at = place(row, index);
        if (!look(at, n).cuts) continue;
        const Eigen::Vector2d Fc = at.chip().Fc.head<2>();
        add_thickness(at, n, Fc, linear, taps);  // dF = Fc dt
        if (engaging_ == Engaging::Frozen) continue;
        add_switch(at, n, n - 1, k, linear, taps);
        add_switch(at, n, n + 1, k, linear, taps);
      }
    }
    for (const auto& [lag, matrix] : taps) linear.taps.push_back({lag, matrix});
    return linear;
  }

private:
  using Taps = std::map<int, Eigen::Matrix2d>;

  // One chip in the steady cut: it cuts where all conditions are below 0.
  struct Look {
    bool cuts = false;
    double t = 0;
    std::vector<double> conditions;     // g of each boundary (of a union: the least), then -t
    std::vector<std::size_t> boundary;  // that each belongs to
  };

  Row row_of(int n, int k) const {
    const int N = table_.cut.samples;
    return row_at(table_, ((n % N) + N) % N, k);
  }

  ChipPlace place(const Row& row, std::size_t index) const {
    return {row.tooth, index, table_.curves.size(),
            static_cast<std::size_t>(table_.cut.earlier_teeth - 1)};
  }

  double thickness(const ChipPlace& at, const Earlier& earlier, int n) const {
    const Eigen::Vector2d moved = steady_.at(n) - steady_.between(n - earlier.delay);
    return earlier.ts + at.chip().N.head<2>().dot(moved);
  }

  // The earlier tooth that bounds the chip.
  const Earlier& bounding(const ChipPlace& at, int n) const {
    const Earlier* best = &at.chip().earlier;
    for (std::size_t m = 0; m < at.back; ++m) {
      const Earlier& other = at.further()[m];
      if (thickness(at, other, n) < thickness(at, *best, n)) best = &other;
    }
    return *best;
  }

  Look look(const ChipPlace& at, int n) const {
    const Stock& stock = table_.cut.stock;
    const Eigen::Vector2d U = steady_.at(n);
    const auto deflection_at = [&](const Earlier& earlier) -> Eigen::Vector2d {
      return steady_.between(n - earlier.delay);
    };
    Look out;
    const bool any = stock.combine == Combine::Any;
    for (std::size_t b = 0; b < at.terms; ++b) {
      const double g = boundary_value(table_, at, b, U);
      const bool joins = any && b > 0 && b < stock.faces.size();
      if (!joins) {
        out.conditions.push_back(g);
        out.boundary.push_back(b);
      } else if (g < out.conditions.front()) {
        out.conditions.front() = g;
        out.boundary.front() = b;
      }
    }
    out.t = chip_thickness(table_, at, U, deflection_at);
    out.conditions.push_back(-out.t);
    out.cuts = is_engaged(table_, at, U) && out.t > least_chip;
    return out;
  }

  // Adds vector dt to the force, dt = N.(dU - dU(theta_o)).
  void add_thickness(const ChipPlace& at, int n, const Eigen::Vector2d& vector, Linear& linear,
                     Taps& taps) const {
    const Earlier& earlier = bounding(at, n);
    const Eigen::Matrix2d gain = vector * at.chip().N.head<2>().transpose();
    linear.now += gain;
    const auto whole = static_cast<int>(std::ceil(earlier.delay));
    const double frac = whole - earlier.delay;  // theta_o lies this far after sample n - whole
    const auto add = [&taps](int lag, const Eigen::Matrix2d& matrix) {
      const auto [tap, is_new] = taps.try_emplace(lag, matrix);
      if (!is_new) tap->second += matrix;
    };
    add(whole, -(1 - frac) * gain);
    if (frac > 0) add(whole - 1, -frac * gain);
  }

  // The element enters or leaves between n and the sample beside it. Where the condition s that
  // changes moves by ds, it cuts for ds / |s difference| of a sample less, at the force it has
  // here.
  void add_switch(const ChipPlace& at, int n, int beside, int k, Linear& linear, Taps& taps) const {
    const std::optional<ChipPlace> other = same_element(at, beside, k);
    if (!other) return;
    const Look out = look(*other, beside);
    if (out.cuts) return;
    const Look in = look(at, n);
    std::optional<std::size_t> last;
    double nearest = 2;
    for (std::size_t i = 0; i < in.conditions.size(); ++i) {
      if (out.conditions[i] <= 0) continue;
      const double way = in.conditions[i] / (in.conditions[i] - out.conditions[i]);
      if (way < nearest) nearest = way, last = i;
    }
    if (!last) return;
    const Chip& chip = at.chip();
    const Eigen::Vector2d F = (chip.Fe + in.t * chip.Fc).head<2>();
    const Eigen::Vector2d per = F / (out.conditions[*last] - in.conditions[*last]);
    if (*last + 1 == in.conditions.size()) {
      add_thickness(at, n, per, linear, taps);
    } else {
      linear.now -=
          per * boundary_gradient(table_, at, in.boundary[*last], steady_.at(n)).transpose();
    }
  }

  std::optional<ChipPlace> same_element(const ChipPlace& at, int beside, int k) const {
    const Row row = row_of(beside, k);
    const auto begin = row.tooth->chips.begin();
    const std::int32_t element = at.chip().element;
    const auto found = std::lower_bound(
        begin + static_cast<std::ptrdiff_t>(row.from), begin + static_cast<std::ptrdiff_t>(row.to),
        element, [](const Chip& chip, std::int32_t wanted) { return chip.element < wanted; });
    const auto index = static_cast<std::size_t>(found - begin);
    if (index == row.to || found->element != element) return {};
    return place(row, index);
  }

  const ChipTable& table_;
  Steady steady_;
  Engaging engaging_;
};

// The linear cut over one tooth period as a map of its state: modes, last force, history of dU.
class Period {
public:
  Period(const Cut& cut, const Compliance& compliance, double S, const Deflections& D,
         Engaging engaging)
      : axes_(compliance.axes) {
    const double dt = 1 / (S * cut.samples);
    for (const Mode& mode : modes_of(compliance.x)) x_.push_back(step_matrix(mode, dt));
    for (const Mode& mode : modes_of(compliance.y)) y_.push_back(step_matrix(mode, dt));
    double used = 0;
    for (const Eigen::Vector2d& U : D) used = std::max(used, U.norm());
    constexpr double beyond = 0.05;  // elements a sample before they enter are wanted too
    const ChipTable table = chip_table(cut, {used + cut.cutter.offset + beyond});
    const SteadyCut steady(table, D, engaging);
    const int z = teeth(cut.cutter);
    const int length = table.pitch_samples > 0 ? cut.samples / z : cut.samples;
    for (int n = 0; n < length; ++n) {
      steps_.push_back(steady.linear_at(n));
      for (const Tap& tap : steps_.back().taps) longest_ = std::max(longest_, tap.lag);
    }
    for (const StepMatrix& m : x_) end_gain_.x() += m.q1;
    for (const StepMatrix& m : y_) end_gain_.y() += m.q1;
  }

  Eigen::Index size() const {
    return static_cast<Eigen::Index>(2 * (x_.size() + y_.size()) + 2 + 2 * history());
  }

  Eigen::VectorXd operator()(const Eigen::VectorXd& from) const {
    Eigen::VectorXd modal = from.head(modal_size());
    Eigen::Vector2d F = from.segment<2>(modal_size());
    const auto kept = static_cast<std::size_t>(history());
    std::vector<Eigen::Vector2d> U(kept + steps_.size());
    for (std::size_t i = 0; i < kept; ++i) {
      U[i] = from.segment<2>(modal_size() + 2 + static_cast<Eigen::Index>(2 * i));
    }
    for (std::size_t n = 0; n < steps_.size(); ++n) {
      U[kept + n] = step(steps_[n], U, kept + n, modal, F);
    }
    Eigen::VectorXd to(from.size());
    to.head(modal_size()) = modal;
    to.segment<2>(modal_size()) = F;
    for (std::size_t i = 0; i < kept; ++i) {
      to.segment<2>(modal_size() + 2 + static_cast<Eigen::Index>(2 * i)) = U[steps_.size() + i];
    }
    return to;
  }

private:
  Eigen::Index modal_size() const { return static_cast<Eigen::Index>(2 * (x_.size() + y_.size())); }
  std::size_t history() const { return static_cast<std::size_t>(std::max(longest_, 1)); }

  // dU(n) = free + g dF(n), dF(n) = now dU(n) + delayed: solved for dU, the force linear in
  // between.
  Eigen::Vector2d step(const Linear& linear, const std::vector<Eigen::Vector2d>& U, std::size_t n,
                       Eigen::VectorXd& modal, Eigen::Vector2d& F) const {
    Eigen::Vector2d delayed = Eigen::Vector2d::Zero();
    for (const Tap& tap : linear.taps) {
      delayed += tap.matrix * U[n - static_cast<std::size_t>(tap.lag)];
    }
    const Eigen::Vector2d F0 = axes_.transpose() * F;
    Eigen::Vector2d free = Eigen::Vector2d::Zero();
    Eigen::Index i = 0;
    for (const StepMatrix& m : x_) {
      free.x() += m.qq * modal[i] + m.qv * modal[i + 1] + m.q0 * F0.x();
      i += 2;
    }
    for (const StepMatrix& m : y_) {
      free.y() += m.qq * modal[i] + m.qv * modal[i + 1] + m.q0 * F0.y();
      i += 2;
    }
    const Eigen::Matrix2d g = axes_ * end_gain_.asDiagonal() * axes_.transpose();
    const Eigen::Matrix2d left = Eigen::Matrix2d::Identity() - g * linear.now;
    Eigen::Vector2d dU = left.inverse() * (axes_ * free + g * delayed);
    F = linear.now * dU + delayed;
    const Eigen::Vector2d F1 = axes_.transpose() * F;
    i = 0;
    for (const StepMatrix& m : x_) advance(m, F0.x(), F1.x(), modal, i);
    for (const StepMatrix& m : y_) advance(m, F0.y(), F1.y(), modal, i);
    return dU;
  }

  static void advance(const StepMatrix& m, double F0, double F1, Eigen::VectorXd& modal,
                      Eigen::Index& i) {
    const double q = modal[i];
    const double v = modal[i + 1];
    modal[i] = m.qq * q + m.qv * v + m.q0 * F0 + m.q1 * F1;
    modal[i + 1] = m.vq * q + m.vv * v + m.v0 * F0 + m.v1 * F1;
    i += 2;
  }

  Eigen::Matrix2d axes_;
  std::vector<StepMatrix> x_, y_;
  Eigen::Vector2d end_gain_ = Eigen::Vector2d::Zero();
  std::vector<Linear> steps_;
  int longest_ = 0;
};

}  // namespace

// Arnoldi: the eigenvalues of the map on the space of a start vector and its images.
std::complex<double> floquet_multiplier(const Cut& cut, const Compliance& compliance, double S,
                                        const Deflections& D, Engaging engaging) {
  const Period map(cut, compliance, S, D, engaging);
  const Eigen::Index most = std::min<Eigen::Index>(40, map.size());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  Eigen::MatrixXd V(map.size(), most + 1);
  for (Eigen::Index i = 0; i < map.size(); ++i) V(i, 0) = number(random);
  V.col(0) = map(map(V.col(0)));  // scales differ between modes, force and history: settle first
  V.col(0).normalize();
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(most + 1, most);
  Eigen::Index size = 0;
  while (size < most) {
    Eigen::VectorXd w = map(V.col(size));
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd h = V.leftCols(size + 1).transpose() * w;
      w -= V.leftCols(size + 1) * h;
      H.col(size).head(size + 1) += h;
    }
    H(size + 1, size) = w.norm();
    ++size;
    if (H(size, size - 1) < 1e-12 * H.norm()) break;
    V.col(size) = w / H(size, size - 1);
  }
  const Eigen::VectorXcd values = H.topLeftCorner(size, size).eigenvalues();
  std::complex<double> dominant = 0;
  for (const std::complex<double>& value : values) {
    if (std::abs(value) > std::abs(dominant)) dominant = value;
  }
  return dominant;
}

}  // namespace ridgeline::cutting
