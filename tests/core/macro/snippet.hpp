#pragma once

#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <string>

#include "core/macro/interpreter.hpp"

namespace ridgeline::macro {

/// A program, and the commons that it leaves; or the alarm that stops it.
struct Snippet {
  const char* name;
  std::string text;
  std::map<int, double> variables;
  int alarm = 0;
  int line = 0;
  std::string control = "30i";
  OffsetMemory offset_memory = OffsetMemory::C;
};

inline void PrintTo(const Snippet& snippet, std::ostream* out) {
  *out << snippet.name;
}

/// Runs the program and compares; variables to 1e-12.
void expect_as_said(const Snippet& snippet);

}  // namespace ridgeline::macro
