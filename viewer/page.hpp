#pragma once

#include <string_view>

namespace ridgeline::viewer {

/// Where the page waits for its data, as JSON that holds no `<`.
inline constexpr std::string_view page_marker = "RIDGELINE_DATA";

/// The viewer as one HTML text that holds page_marker once. Empty: built without the viewer.
std::string_view page();

}  // namespace ridgeline::viewer
