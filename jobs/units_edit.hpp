#pragma once

#include <nlohmann/json.hpp>

#include "core/units/edit.hpp"
#include "jobs/reader.hpp"
#include "jobs/units_program.hpp"

namespace ridgeline::jobs {

/// Applies a list of edits: [{"unit": 6, "set": {"shape/1/end": [12, 125]}}, {"insert_after": 3,
/// "unit": {...}}, {"remove": 5}]. Paths begin with machining, shape, tools, process or closed.
/// Rows that met go on meeting; new tools alone change no geometry.
units::Program edited(const units::Program& program, const Value& edits);

/// The program as it was `count` lists of edits ago.
UnitsProgram undone(const UnitsProgram& program, const Value& count);

}  // namespace ridgeline::jobs
