#pragma once

#include "core/macro/program.hpp"

namespace ridgeline::macro {

/// Joins each WHILE or DO with its END, and tells every block its innermost loop. Blocks that do
/// not pair become Faulty: alarm 124 (no END, loops that cross) or 126 (no DO).
void pair_loops(Program& program);

/// May a GOTO in block `from` jump to block `to`? Out of loops, but not into one.
bool may_jump(const Program& program, std::int32_t from, std::int32_t to);

}  // namespace ridgeline::macro
