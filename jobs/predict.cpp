#include <array>

#include "jobs/kinds.hpp"
#include "jobs/predict_kinds.hpp"
#include "jobs/reader.hpp"

namespace ridgeline::jobs {

Answer predict(const Request& request) {
  Object job{Value(request.document)};
  job.required("job");
  if (request.format == "nc")
    refuse({.code = ErrorCode::Unsupported,
            .field = "",
            .value = "nc",
            .limit = "json, csv or svg",
            .message =
                "one engagement has no program: ask for json, csv or svg, or predict along a "
                "path"});
  if (job.has("speeds_rpm")) return predict_sweep(job, request);
  return predict_engagement(job, request);
}

}  // namespace ridgeline::jobs
