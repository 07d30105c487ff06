#pragma once

#include <nlohmann/json.hpp>

#include "core/units/program.hpp"
#include "jobs/reader.hpp"

/// Programs of machining units between documents and values: what `units plan` prints and what
/// `units edit`, `show` and `nc` read again.
namespace ridgeline::jobs {

/// A program with what its document carries beside it.
struct UnitsProgram {
  units::Program program;
  nlohmann::json placement;                        ///< of the product in its STEP file, or null
  nlohmann::json edits = nlohmann::json::array();  ///< lists of edits since it was planned
};

nlohmann::json unit_document(const units::Unit& unit);

/// A unit of an edit: "kind", "process", "machining", "shape", "tools" (absent: the usual ones).
/// With region, core and state, as programs hold it.
units::Unit read_unit(const Value& value);

nlohmann::json parameters_document(const units::Parameters& parameters);
units::Parameters read_parameters(const Value& value);
nlohmann::json split_document(const units::Split& split);
units::Split read_split(const Value& value);

/// The whole document of interfaces.md, "status" and "tree" included.
nlohmann::json program_document(const UnitsProgram& program);
UnitsProgram read_program(const Value& value);

/// One line for a unit: "3 bar_inner  X 18 to 12, Z 0 to 75".
std::string unit_label(const units::Unit& unit);

}  // namespace ridgeline::jobs
