#include "core/cutting/time_domain.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/cutting/oscillator.hpp"
#include "core/cutting/rows.hpp"

namespace ridgeline::cutting {
namespace {

// Displacements of the edge of the latest samples, by sample number.
class History {
public:
  void make_room(double delay) {
    std::size_t size = 4;
    while (static_cast<double>(size) < delay + 4) size *= 2;
    if (size <= ring_.size()) return;
    Deflections larger(size, Eigen::Vector2d::Zero());
    for (std::size_t back = 0; back < ring_.size(); ++back) {
      const long n = latest_ - static_cast<long>(back);
      if (n >= 0) larger[static_cast<std::size_t>(n) & (size - 1)] = at(n);
    }
    ring_ = std::move(larger);
  }

  void set(long n, const Eigen::Vector2d& U) {
    ring_[static_cast<std::size_t>(n) & (ring_.size() - 1)] = U;
    latest_ = n;
  }

  /// Linear between samples; nothing was displaced before the start.
  Eigen::Vector2d between(double n) const {
    if (n < 0) return Eigen::Vector2d::Zero();
    const double below = std::floor(n);
    const auto from = static_cast<long>(below);
    return at(from) + (n - below) * (at(from + 1) - at(from));
  }

private:
  const Eigen::Vector2d& at(long n) const {
    return ring_[static_cast<std::size_t>(n) & (ring_.size() - 1)];
  }
  Deflections ring_;
  long latest_ = -1;
};

double longest_delay(const ChipTable& table) {
  double longest = 0;
  for (const ToothChips& tooth : table.teeth) {
    for (const Chip& chip : tooth.chips) longest = std::max(longest, chip.earlier.delay);
    for (const Earlier& earlier : tooth.earlier) longest = std::max(longest, earlier.delay);
  }
  return longest;
}

// What a tool does that cuts on and on.
class Run {
public:
  Run(const Cut& cut, const Compliance& compliance, double S, double largest)
      : largest_(largest * cut.cutter.r),
        x_(modes_of(compliance.x), 1 / (S * cut.samples)),
        y_(modes_of(compliance.y), 1 / (S * cut.samples)),
        axes_(compliance.axes) {
    constexpr double first_reach = 0.1;
    search(cut, first_reach);
  }

  /// `at(turned)` is called now and then with the part of the revolution done.
  template <typename At>
  TimeDomain revolution(const At& at) {
    constexpr int often = 256;
    TimeDomain out;
    for (int i = 0; i < table_.cut.samples; ++i) {
      if (i % often == 0) at(static_cast<double>(i) / table_.cut.samples);
      step(i);
      out.D.push_back(displacement());
      out.F.push_back(F_);
      if (e_ && (!out.e || *e_ < *out.e)) out.e = e_;
    }
    return out;
  }

private:
  // From sample n - 1 to n: F held gives U, F(U) gives a better U, whose force is taken.
  void step(int i) {
    ++n_;
    const Eigen::Vector2d offset = offset_at(table_.cut, i);
    Eigen::Vector3d F = F_;
    if (n_ > 0) F = force(i, ahead(F) + offset);
    F = force(i, ahead(F) + offset);
    if (n_ > 0) {
      const Eigen::Vector2d from = along_axes(F_);
      const Eigen::Vector2d to = along_axes(F);
      x_.step(from.x(), to.x());
      y_.step(from.y(), to.y());
    }
    F_ = F;
    const Eigen::Vector2d U = displacement() + offset;
    history_.set(n_, U);
    if (least_depth_) e_ = *least_depth_ + U.dot(table_.cut.n.head<2>());
    if (!least_depth_) e_.reset();
  }

  Eigen::Vector2d ahead(const Eigen::Vector3d& F) const {
    if (n_ == 0) return Eigen::Vector2d::Zero();
    const Eigen::Vector2d from = along_axes(F_);
    const Eigen::Vector2d to = along_axes(F);
    return axes_ * Eigen::Vector2d(x_.ahead(from.x(), to.x()), y_.ahead(from.y(), to.y()));
  }

  Eigen::Vector2d along_axes(const Eigen::Vector3d& F) const {
    return axes_.transpose() * F.head<2>();
  }

  Eigen::Vector2d displacement() const {
    return axes_ * Eigen::Vector2d(x_.displacement(), y_.displacement());
  }

  Eigen::Vector3d force(int i, const Eigen::Vector2d& U) {
    if (const double moved = U.norm(); !(moved <= table_.around.reach)) {
      if (!(moved < largest_)) {
        throw Error(ErrorCode::NotConverged,
                    "time domain: the vibration outgrows the tool, the cut is unstable");
      }
      search(table_.cut, 1.5 * moved);
    }
    const auto at_theta_o = [&](const Earlier& earlier, std::int32_t) -> Eigen::Vector2d {
      return history_.between(static_cast<double>(n_) - earlier.delay);
    };
    least_depth_.reset();
    const auto on_chip = [&](const Chip& chip, const Row&, bool cuts, double) {
      if (cuts) least_depth_ = std::min(least_depth_.value_or(chip.depth), chip.depth);
    };
    return force_at(table_, i, U, at_theta_o, on_chip);
  }

  void search(const Cut& cut, double reach) {
    table_ = chip_table(Cut(cut), {reach});
    history_.make_room(longest_delay(table_));
  }

  ChipTable table_;
  double largest_;  // [mm]
  Oscillator x_, y_;
  Eigen::Matrix2d axes_;
  History history_;
  Eigen::Vector3d F_ = Eigen::Vector3d::Zero();
  std::optional<double> least_depth_;  // of the chips that cut at the last force
  std::optional<double> e_;
  long n_ = -1;
};

// Sum over the last `count` samples of |D - D lag before|^2, over that of |D|^2.
double change_at(const Deflections& D, std::size_t lag, std::size_t count) {
  double change = 0;
  double size = 0;
  for (std::size_t i = D.size() - count; i < D.size(); ++i) {
    change += i < lag ? D[i].squaredNorm() : (D[i] - D[i - lag]).squaredNorm();
    size += D[i].squaredNorm();
  }
  return size > 0 ? change / size : 0;
}

std::size_t tooth_period(const Cut& cut) {
  const int z = teeth(cut.cutter);
  const bool alike = is_periodic(cut.cutter) && cut.samples % z == 0;
  return static_cast<std::size_t>(alike ? cut.samples / z : cut.samples);
}

}  // namespace

TimeDomain time_domain(const Cut& cut, const Compliance& compliance, double S,
                       const TimeOptions& options, const Progress& progress) {
  Run run(cut, compliance, S, options.largest);
  const auto N = static_cast<std::size_t>(cut.samples);
  TimeDomain out;
  Deflections latest;  // up to three revolutions
  while (out.revolutions < options.max_revolutions && !out.converged) {
    TimeDomain next = run.revolution([&](double turned) {
      progress.at((out.revolutions + turned) / options.max_revolutions, "time domain");
    });
    if (latest.size() == 3 * N) latest.erase(latest.begin(), latest.begin() + cut.samples);
    latest.insert(latest.end(), next.D.begin(), next.D.end());
    next.change = std::move(out.change);
    next.change.push_back(change_at(latest, N, N));
    next.revolutions = out.revolutions + 1;
    next.converged = next.change.back() < options.tolerance;
    out = std::move(next);
  }
  out.tooth_change = change_at(latest, tooth_period(cut), N);
  out.flip_change = change_at(latest, 2 * tooth_period(cut), N);
  return out;
}

Stability stability_of(const TimeDomain& run) {
  constexpr double none = 0.03 * 0.03;
  if (run.tooth_change < none) return Stability::Stable;
  return run.flip_change < none ? Stability::Flip : Stability::Unstable;
}

Stability stability(const Cut& cut, const Compliance& compliance, double S,
                    const Progress& progress) {
  Cut real = cut;
  real.earlier_teeth = std::max(cut.earlier_teeth, 3);
  constexpr TimeOptions long_enough{.max_revolutions = 120};
  try {
    return stability_of(time_domain(real, compliance, S, long_enough, progress));
  } catch (const Error& error) {
    if (error.code() == ErrorCode::NotConverged) return Stability::Unstable;
    throw;
  }
}

}  // namespace ridgeline::cutting
