#include "core/cutting/predict.hpp"

#include "core/cutting/modal_fit.hpp"

namespace ridgeline::cutting {
namespace {

// Takes over what the time domain says of the cut.
void take(TimeDomain run, Predicted& out) {
  out.method = Method::TimeDomain;
  out.revolutions = run.revolutions;
  out.change = std::move(run.change);
  out.prediction.e = run.e;
  out.prediction.F = std::move(run.F);
  out.prediction.D = std::move(run.D);
}

}  // namespace

Predicted predict(const Engagement& engagement, Method method, const Deflections& start,
                  const Progress& progress) {
  const auto& [cut, compliance, S, options, time, fall_back] = engagement;
  Predicted out;
  out.method = method;
  if (method == Method::TimeDomain) {
    TimeDomain run = time_domain(cut, with_modes(compliance), S, time, progress);
    out.prediction.converged = run.converged;
    out.prediction.loops = run.revolutions;
    take(std::move(run), out);
    return out;
  }
  if (method == Method::Rigid) {
    IterateOptions once = options;
    once.max_loops = 1;
    out.prediction = iterate(cut, compliance, S, once, {}, progress);
    return out;
  }
  out.prediction = iterate(cut, compliance, S, options, start, progress);
  if (out.prediction.converged || !fall_back) return out;
  out.fell_back = true;
  take(time_domain(cut, with_modes(compliance), S, time, progress), out);
  return out;
}

}  // namespace ridgeline::cutting
