#include "core/macro/refuse.hpp"

#include "core/base/error.hpp"
#include "core/macro/text.hpp"

namespace ridgeline::macro {

void refuse(const std::string& field, double value, const std::string& limit) {
  ErrorDetails details;
  details.field = field;
  details.value = number_text(value);
  details.limit = limit;
  throw Error(ErrorCode::BadInput, field + " must be " + limit + ", is " + number_text(value),
              details);
}

}  // namespace ridgeline::macro
