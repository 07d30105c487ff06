#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace ridgeline::nc {

/// Text of a golden file; with RIDGELINE_WRITE_GOLDEN set it is written first
/// (tests/golden/README.md).
inline std::string golden(const std::string& name, const std::string& current) {
  const std::string path = RIDGELINE_TESTS "/golden/" + name;
  if (std::getenv("RIDGELINE_WRITE_GOLDEN") != nullptr) std::ofstream(path) << current;
  std::ifstream file(path);
  EXPECT_TRUE(file) << path << " cannot be read";
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace ridgeline::nc
