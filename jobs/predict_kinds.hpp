#pragma once

#include "jobs/kinds.hpp"
#include "jobs/predict_case.hpp"

/// The forms of a predict job; predict() in predict.cpp chooses.
namespace ridgeline::jobs {

/// Whether the converged state is tested for chatter, and how.
enum class StabilityTest { TimeDomain, None };

/// The members that every form on one engagement shares: case, options, method, stability.
struct PredictJob {
  cutting::Engagement engagement;
  cutting::Method method = cutting::Method::Iterate;
  StabilityTest test = StabilityTest::TimeDomain;
};
PredictJob read_predict_job(Object& job);

/// {"case", "speed_rpm", "options", "warm_from"}: one engagement at one speed.
Answer predict_engagement(Object& job, const Request& request);
/// The same with "speeds_rpm": error and stability against the speed.
Answer predict_sweep(Object& job, const Request& request);

/// The same with "speeds_rpm" and "depths": the depth at which the cut begins to chatter.
Answer predict_lobes(Object& job, const Request& request);

/// [rpm, ...] or {"from", "to", "step"}.
std::vector<double> read_speeds(const Value& value);

/// "stable", "flip" or "unstable"; null where it was not or cannot be tested, and why in
/// `warnings`.
nlohmann::json stability_document(const PredictJob& job, std::vector<std::string>& warnings,
                                  const Progress& progress);

}  // namespace ridgeline::jobs
