#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "jobs/units_program.hpp"

namespace ridgeline::jobs {

/// The page of a program: half section and solids with each unit in its colour, beside the tree of
/// units with their numbers. `document`: the result.
std::string units_page(const UnitsProgram& whole, const nlohmann::json& document);

}  // namespace ridgeline::jobs
