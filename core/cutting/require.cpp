#include "core/cutting/require.hpp"

#include <limits>
#include <sstream>

namespace ridgeline::cutting {
namespace {

std::string text(double value) {
  std::ostringstream out;
  out.precision(9);
  out << value;
  return out.str();
}

}  // namespace

void require_between(std::string_view field, double value, double least, double most,
                     std::string_view unit) {
  if (value >= least && value <= most) return;
  std::ostringstream limit;
  limit.precision(9);
  if (most < std::numeric_limits<double>::max()) {
    limit << least << " to " << most;
  } else {
    limit << "at least " << least;
  }
  if (!unit.empty()) limit << ' ' << unit;
  std::ostringstream message;
  message.precision(9);
  message << field.substr(field.rfind('/') + 1) << ": " << value;
  if (!unit.empty()) message << ' ' << unit;
  message << "; allowed " << limit.str();
  throw Error(ErrorCode::BadInput, message.str(),
              {.field = std::string(field), .value = text(value), .limit = limit.str()});
}

}  // namespace ridgeline::cutting
