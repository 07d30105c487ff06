#include "core/base/version.hpp"

namespace ridgeline {

std::string_view version() noexcept {
  return RIDGELINE_VERSION;
}

}  // namespace ridgeline
