#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "jobs/recording.hpp"

namespace ridgeline::schema {

/// {"chamfer": {"width": "...", "output/decimals": "...", "": "of the whole"}, ...}: what a key
/// means.
using Descriptions = nlohmann::ordered_json;

/// The value of "job" or "kind" in a definition: "along_cycle" is the job "cycle" elsewhere.
std::string word_of(const std::string& definition);
/// Not where another reading of the place says the same or more.
bool is_shown(const jobs::Reading& reading, const jobs::Record& record);

/// JSON Schema (draft 2020-12) of all job files and definitions.
nlohmann::ordered_json json_schema(const jobs::Recording& recording,
                                   const Descriptions& descriptions);

/// Every key with its type, unit, limits, default and meaning, as a page of docs/.
std::string reference(const jobs::Recording& recording, const Descriptions& descriptions);

/// Keys without a description or a known type, and descriptions of no key; a line each.
std::string gaps(const jobs::Recording& recording, const Descriptions& descriptions);

}  // namespace ridgeline::schema
