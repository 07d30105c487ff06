#pragma once

#include <string>
#include <string_view>

namespace ridgeline::command {

/// The whole of a file, or of standard input for "-". Throws Error{BadFile} when it cannot be read
/// or is longer than a document may be.
std::string read_file(const std::string& path);

/// Writes to a file, or to standard output for "-" and "". A regular file is replaced as a whole or
/// not at all. Throws Error{BadFile}.
void write_file(const std::string& path, std::string_view text);

}  // namespace ridgeline::command
