#pragma once

#include <string>

#include "core/base/error.hpp"

namespace ridgeline::jobs {

/// What an error object says of one field of a document.
struct Refusal {
  ErrorCode code = ErrorCode::BadInput;
  std::string field = {};    ///< JSON pointer
  std::string value = {};    ///< as text
  std::string limit = {};    ///< what it must be, with unit
  std::string message = {};  ///< empty: "<field> must be <limit>, is <value>"
};

[[noreturn]] void refuse(const Refusal& refusal);

}  // namespace ridgeline::jobs
