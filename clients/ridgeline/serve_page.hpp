#pragma once

#include <string_view>

namespace ridgeline::command {

/// What `ridgeline serve` shows: its page, that page's script and its style. Nothing of it is made
/// from requests.
std::string_view serve_page();
std::string_view serve_script();
std::string_view serve_style();

}  // namespace ridgeline::command
