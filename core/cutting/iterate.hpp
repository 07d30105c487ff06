#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/cutting/force.hpp"
#include "core/cutting/secants.hpp"

namespace ridgeline::cutting {

/// What happens to a low-pass that would cut the tool's own resonance: the cut is refused, or goes
/// without.
enum class LowPassGuard { Refuse, Off };

/// Where the next loop begins: the weighted averages of the document (3)..(5), or with what the
/// loops before told, also of the cuts before on a path (Secants). Both end at the same deflection.
enum class Mixing { Averages, Secants };

/// How the iteration runs. The names of the document where it has them.
struct IterateOptions {
  double alpha = 0.01;  ///< converged when A < alpha sum |D4|^2 (2)
  Mixing mixing = Mixing::Averages;
  double beta = 3;                           ///< diverges when A > beta min(earlier A)
  int stall = 10;                            ///< or when so many loops before gave no new minimum
  std::vector<double> weights{1, 3, 6, 10};  ///< w1 at the start and after each divergence
  bool adapt = true;                         ///< change weights at all
  int max_loops = 300;
  double largest = std::numeric_limits<double>::infinity();  ///< deflection that ends it [mm]
  std::optional<double> kappa;  ///< low-pass at kappa / tc; absent: none
  LowPassGuard guard = LowPassGuard::Refuse;
  Span span = Span::Revolution;
  bool keeps_history = true;  ///< the error after each loop
};

/// At which loop w1 became what.
struct WeightChange {
  int loop = 0;
  double w1 = 0;
};

/// What predicts an error, whichever way.
struct Prediction {
  std::optional<double> e;  ///< machining error; nullopt when nothing cuts [mm]
  bool converged = false;
  int loops = 0;  ///< force evaluations
  double w1 = 1;
  std::vector<WeightChange> weight_changes;
  std::vector<double> A;  ///< residual of each loop (1) [mm2]
  std::vector<std::optional<double>> e_history;
  std::optional<double> cutoff;  ///< of the low-pass [Hz]
  double contact_time = 0;       ///< tc, of one tooth in the first loop [s]
  int cut_points = 0;            ///< of the last force evaluation
  Forces F;                      ///< N samples (a pitch: N / z)
  Deflections D;                 ///< D4, the same
  Deflections ahead;             ///< where a cut like this one begins best; empty: from D
  double reach = 0;              ///< deflection that the chips were searched for [mm]
};

/// The method of document 001 (figures 2 and 13): loops over one revolution. `S` is the spindle
/// speed [rev/s]; `start` the last deflection of the path segment before, of any number of samples,
/// or empty; loop 1 from nothing is the rigid method. Throws Error{BadInput} when the low-pass
/// would cut the tool's own resonance.
Prediction iterate(const Cut& cut, const Compliance& compliance, double S,
                   const IterateOptions& options, const Deflections& start = {},
                   const Progress& progress = {});

/// The rigid method: one loop from no deflection.
Prediction rigid(const Cut& cut, const Compliance& compliance, double S, Span span);

/// The same for one cut after another of one tool at one speed: keeps what they share.
class Iteration {
public:
  Iteration(const Compliance& compliance, double S, IterateOptions options);

  /// Predicts a cut; its principal directions may have turned.
  Prediction solve(const Cut& cut, const Eigen::Matrix2d& axes, const Deflections& start,
                   const Progress& progress = {});

  /// Where a cut one station further along a path begins: `start`, moved on by as much as the force
  /// came later in the last cut than in the one before. With the engagement the vibration moves
  /// round the tool; at low speed, with many waves in a revolution, that is most of its change.
  Deflections next_start(const Deflections& start);

  /// Error of the last cut solved against another surface: n points from its contact to O'.
  std::optional<double> error_towards(const Eigen::Vector3d& n) const;

  /// The cut with a deflection of one revolution that another method found: what error_towards()
  /// and solve() go on from.
  void adopt(const Cut& cut, Deflections D);

  /// The last cut again with its forces scaled, from its own deflection (the rigid method: from
  /// none): K_c and K_e times these.
  Prediction scaled(double cut_scale, double edge_scale);

private:
  Prediction loops(Deflections D1, const Progress& progress);
  void make_room(const Cut& cut, const Deflections& D, double change);

  Compliance compliance_;
  double S_;
  IterateOptions options_;
  std::optional<Response> response_;
  int samples_ = 0;
  ChipTable table_;
  Revolution revolution_;
  Deflections D_;
  Span span_ = Span::Revolution;  // of D_
  Secants secants_;
  std::optional<double> place_, last_place_;  // of the force in the tooth period [samples]
  Eigen::Matrix2d axes_ = Eigen::Matrix2d::Identity();
  double cut_scale_ = 1, edge_scale_ = 1;
  bool is_centred_ = false;  // the chips are those round a deflection
  bool is_rigid_ = false;    // one loop from no deflection
};

}  // namespace ridgeline::cutting
