#include "jobs/kinds.hpp"
#include "jobs/predict_along.hpp"
#include "jobs/predict_kinds.hpp"
#include "jobs/predict_work.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {
namespace {

[[noreturn]] void refuse_program(const std::string& why) {
  refuse({.code = ErrorCode::Unsupported,
          .field = "",
          .value = "nc",
          .limit = "json, csv, svg or html",
          .message = why});
}

// A false "correct" asks for none.
bool asks_for_correction(Object& job) {
  const std::optional<Value> correct = job.optional("correct");
  return correct && correct->json() != false;
}

Answer predict_along(Object& job, const Value& along, const Request& request) {
  if (request.format == "nc" && !asks_for_correction(job)) {
    refuse_program("the program of a prediction is the corrected one: ask for it by \"correct\"");
  }
  const Value kind = Object(along).required("job");
  if (kind.is_word("chamfer")) return predict_chamfer(job, along, request);
  if (kind.is_word("program")) return predict_nc(job, along, request);
  if (kind.is_word("cycle")) return predict_cycle(job, along, request);
  kind.refuse("\"chamfer\", \"cycle\" or \"program\"");
}

}  // namespace

Answer predict(const Request& request) {
  Object job{Value(request.document)};
  job.required("job");
  if (const std::optional<Value> along = job.optional("along")) {
    return predict_along(job, *along, request);
  }
  if (request.format == "nc") {
    refuse_program(
        "one engagement has no program: ask for json, csv, svg or html, or predict along a path");
  }
  if (job.has("depths")) return predict_lobes(job, request);
  if (job.has("speeds_rpm")) return predict_sweep(job, request);
  return predict_engagement(job, request);
}

}  // namespace ridgeline::jobs
