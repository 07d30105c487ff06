#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "core/base/progress.hpp"
#include "core/cutting/floquet.hpp"
#include "core/cutting/predict.hpp"
#include "core/cutting/station.hpp"

namespace ridgeline::cutting {

/// Relative standard uncertainty of what the prediction rests on.
struct Uncertainty {
  double cutting = 0;    ///< of K_c
  double edge = 0;       ///< of K_e
  double stiffness = 0;  ///< of the tool
};

/// Whether the state that a station settles to is tested for chatter, and how.
enum class StabilityTest { None, Floquet, TimeDomain };

/// How a path is predicted. Mixing::Secants with `iterate` serves best: stations are alike.
struct AlongOptions {
  Method method = Method::Iterate;
  IterateOptions iterate;
  TimeOptions time;
  bool fall_back = true;                   ///< to the time domain where a station does not converge
  std::optional<Uncertainty> uncertainty;  ///< absent: no spread
  StabilityTest stability = StabilityTest::None;
  int stability_every = 1;  ///< every so many stations, counted from the first of the path
  int threads = 1;  ///< the result does not depend on it: parts of `part` stations begin cold
  int part = 512;
};

/// Corrected path: shifts along n until what is left of the error is small.
struct CorrectOptions {
  double residual = 0.0005;  ///< largest error left [mm] ...
  double relative = 0.05;    ///< ... or this part of the error before
  int max_shifts = 6;
  double largest_shift = 0.25;  ///< of the radius; beyond it the engagement is another one
  bool by_borders = false;      ///< the mean error at Station::borders in place of that along n
  bool only_overcut = false;    ///< what is left standing stays: a later pass takes it off
};

/// What one station gives. Frame: work.
struct StationError {
  std::optional<double> e;  ///< along n, > 0: material left; nullopt: nothing cuts here [mm]
  double spread = 0;        ///< standard uncertainty of e by AlongOptions::uncertainty
  std::vector<std::optional<double>> border;  ///< at each of Station::borders
  Eigen::Vector3d mean_force = Eigen::Vector3d::Zero();
  Eigen::Vector3d peak_force = Eigen::Vector3d::Zero();       ///< of the sample with the greatest
  Eigen::Vector3d peak_deflection = Eigen::Vector3d::Zero();  ///< likewise
  int loops = 0;
  bool converged = true;
  bool fell_back = false;
  std::optional<Stability> stability;              ///< where it was tested or fell back
  std::optional<std::complex<double>> multiplier;  ///< where it was tested by Floquet
  bool settles = true;        ///< false: even the time domain finds no end to the vibration
  bool low_pass_off = false;  ///< kappa / tc would cut the tool's own resonance here
  double shift = 0;           ///< corrected path: the tool goes this far along -n [mm]
  double before = 0;          ///< corrected path: e of the path as it was
};

/// Predicts stations one after another, each from the deflection of the one before. S: spindle
/// [rev/s]. What it is given must outlive it.
class Follower {
public:
  Follower(const Course& course, const Compliance& compliance, double S,
           const AlongOptions& options);

  /// A station as it is, with its spread if AlongOptions asks for it.
  StationError at(const Station& station);

  /// The station with its tool at c - s n, s_new = e(s), so that the error left, e(s) - s, is
  /// small; `e` of the result is that error. Throws Error{NotConverged} with the contact point
  /// where it does not shrink or the shift would leave the limits.
  StationError corrected_at(const Station& station, const CorrectOptions& limits);

  /// Tests what the station predicted last settles to; `out` is what it gave, moved as it was.
  void test(const Station& station, StationError& out);

private:
  StationError shifted(const Station& station, double shift);
  void by_time(const Cut& cut, Prediction& prediction, StationError& out);
  double spread(const Station& nominal, double shift, double e);

  const Course& course_;
  Compliance compliance_;
  double S_;
  const AlongOptions& options_;
  Iteration iteration_;
  Deflections start_;  // what the last station settled to
  Deflections ahead_;  // where the next one begins
};

/// Every station of a path.
std::vector<StationError> along(const Course& course, const std::vector<Station>& stations,
                                const Compliance& compliance, double S, const AlongOptions& options,
                                const Progress& progress = {});

/// Every station corrected; see Follower::corrected_at.
std::vector<StationError> corrected(const Course& course, const std::vector<Station>& stations,
                                    const Compliance& compliance, double S,
                                    const AlongOptions& options, const CorrectOptions& limits,
                                    const Progress& progress = {});

}  // namespace ridgeline::cutting
