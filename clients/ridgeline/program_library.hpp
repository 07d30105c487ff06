#pragma once

#include <map>
#include <string>

namespace ridgeline::command {

/// The O number that a file name stands for: O9100, o9100.nc, 9100.NC, 9100; -1: none.
int program_number(const std::string& file_name);

/// The programs of a folder by their O numbers without zeros; of two files with one number, the one
/// that begins with O. When `main` or one of these calls a program <NAME>, also the other files, by
/// their names without ending. Throws Error{BadFile} for a folder that cannot be read.
std::map<std::string, std::string> read_programs(const std::string& folder,
                                                 const std::string& main);

}  // namespace ridgeline::command
