#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "core/base/progress.hpp"

namespace ridgeline::jobs {

/// What a document may be at most; a request beyond it is refused before any of it is used.
inline constexpr std::size_t max_document_bytes = 32'000'000;
inline constexpr std::size_t max_document_levels = 64;

/// Reads one JSON document (RFC 8259) in one pass without recursion. Throws Error{BadInput} for
/// text that is not JSON (line, column and, as far as known, the pointer), a document beyond the
/// limits above, a key given twice in one object, a number beyond the range of a double, or text
/// that is not UTF-8.
nlohmann::json parse(std::string_view text, const Progress& progress = {});

}  // namespace ridgeline::jobs
