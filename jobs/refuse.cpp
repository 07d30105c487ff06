#include "jobs/refuse.hpp"

#include "jobs/text.hpp"

namespace ridgeline::jobs {

void refuse(const Refusal& refusal) {
  ErrorDetails details;
  details.field = shortened(refusal.field, 200);
  details.value = shortened(refusal.value);
  details.limit = refusal.limit;
  const std::string subject = details.field.empty() ? "the document" : details.field;
  throw Error(refusal.code,
              refusal.message.empty()
                  ? subject + " must be " + details.limit + ", is " + details.value
                  : refusal.message,
              details);
}

}  // namespace ridgeline::jobs
