#include "viewer/page.hpp"

namespace ridgeline::viewer {

std::string_view page() {
  return {};
}

}  // namespace ridgeline::viewer
