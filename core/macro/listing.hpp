#pragma once

#include <string>

#include "core/base/progress.hpp"
#include "core/macro/result.hpp"

namespace ridgeline::macro {

struct NcStyle {
  int decimals = 4;  ///< 1 to 6
  bool is_linuxcnc = false;
};

/// The motion as plain G code without macro statements: G90, arcs with I J K, the functions of the
/// program in their places. Coordinates of the work offsets, so that it runs with any values in
/// them; G53 for moves that were commanded in machine coordinates. An alarm is a comment at the
/// end.
std::string nc_text(const Result& result, const NcStyle& style = {}, const Progress& progress = {});

/// One line a move: kind, end in work and machine coordinates, arc, feed, place in the program.
std::string csv_text(const Result& result, const Progress& progress = {});

/// One line a block: place, text, assigned variable.
std::string trace_text(const Result& result, const Progress& progress = {});

}  // namespace ridgeline::macro
