#include "clients/ridgeline/program_library.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include "clients/ridgeline/files.hpp"
#include "core/base/error.hpp"

namespace ridgeline::command {
namespace {

constexpr std::size_t most_digits = 8;

bool begins_with_O(const std::string& name) {
  return !name.empty() && (name.front() == 'O' || name.front() == 'o');
}

}  // namespace

int program_number(const std::string& file_name) {
  const std::string stem = std::filesystem::path(file_name).stem().string();
  const std::string digits = begins_with_O(stem) ? stem.substr(1) : stem;
  const bool is_number = !digits.empty() && digits.size() <= most_digits &&
                         std::all_of(digits.begin(), digits.end(), [](char c) {
                           return std::isdigit(static_cast<unsigned char>(c)) != 0;
                         });
  return is_number ? std::stoi(digits) : -1;
}

std::map<int, std::string> read_programs(const std::string& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator each(folder, error), end; !error && each != end;
       each.increment(error)) {
    if (each->is_regular_file(error)) files.push_back(each->path());
  }
  if (error) {
    throw Error(ErrorCode::BadFile, "cannot read the folder " + folder + ": " + error.message());
  }
  // Files that begin with O last, so that they win; otherwise in the order of their names.
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) {
    const std::string x = a.filename().string(), y = b.filename().string();
    return std::pair(begins_with_O(x), x) < std::pair(begins_with_O(y), y);
  });
  std::map<int, std::string> programs;
  for (const std::filesystem::path& file : files) {
    const int number = program_number(file.filename().string());
    if (number >= 0) programs[number] = read_file(file.string());
  }
  return programs;
}

}  // namespace ridgeline::command
