#pragma once

#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <string>
#include <vector>

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

/// What a program does, in machine coordinates and in the order of the machine: "G0 10 0 50",
/// "G1 0 0 -5", "G2 x y z centre i j k", "G4 0.5" [s]. Numbers to 1e-6.
std::vector<std::string> moves_text(const Result& result);

}  // namespace ridgeline::macro
