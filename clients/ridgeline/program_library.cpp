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

bool begins_with_o(const std::string& name) {
  return !name.empty() && (name.front() == 'O' || name.front() == 'o');
}

constexpr std::size_t longest_name = 31;

bool is_program_name(const std::string& name) {
  return !name.empty() && name.size() <= longest_name &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '+' || c == '.';
         });
}

}  // namespace

int program_number(const std::string& file_name) {
  const std::string stem = std::filesystem::path(file_name).stem().string();
  const std::string digits = begins_with_o(stem) ? stem.substr(1) : stem;
  const bool is_number = !digits.empty() && digits.size() <= most_digits &&
                         std::all_of(digits.begin(), digits.end(), [](char c) {
                           return std::isdigit(static_cast<unsigned char>(c)) != 0;
                         });
  return is_number ? std::stoi(digits) : -1;
}

std::map<std::string, std::string> read_programs(const std::string& folder,
                                                 const std::string& main) {
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
    return std::pair(begins_with_o(x), x) < std::pair(begins_with_o(y), y);
  });
  std::map<std::string, std::string> programs;
  const auto calls_names = [](const std::string& text) { return text.find('<') != text.npos; };
  bool has_names = calls_names(main);
  for (const std::filesystem::path& file : files) {
    const int number = program_number(file.filename().string());
    if (number < 0) continue;
    std::string& text = programs[std::to_string(number)] = read_file(file.string());
    has_names = has_names || calls_names(text);
  }
  if (!has_names) return programs;
  for (const std::filesystem::path& file : files) {
    const std::string name = file.stem().string();
    if (program_number(name) < 0 && is_program_name(name)) {
      programs[name] = read_file(file.string());
    }
  }
  return programs;
}

}  // namespace ridgeline::command
