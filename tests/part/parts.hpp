#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace ridgeline::part {

/// The turned ones of tests/parts.
inline const std::vector<std::string> turned_parts{"own_cross_tube.step", "own_flanged_shaft.step",
                                                   "own_hard_shaft.step", "tie_rod.step"};

inline std::string part_text(const std::filesystem::path& folder, const std::string& name) {
  std::ifstream in(folder / "parts" / name, std::ios::binary);
  if (!in) throw std::runtime_error("no part " + name);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace ridgeline::part
