#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/geometry/workpiece.hpp"
#include "core/tool/tool.hpp"
#include "jobs/answer.hpp"
#include "jobs/reader.hpp"

/// Workpieces, holes and tools between documents and values.
namespace ridgeline::jobs {

/// Checks a definition for the library: every key, range and cross reference. Throws
/// Error{BadInput} or Error{InconsistentEccentricity} with the pointer of what is wrong.
void validate_definition(const nlohmann::json& definition);

/// What the library files a valid definition under.
struct DefinitionKey {
  std::string kind;
  std::string name;                  ///< a tool without a name: its number as text
  std::optional<std::string> alias;  ///< a named tool's number as text
};
DefinitionKey key_of(const nlohmann::json& definition);

geometry::Workpiece read_workpiece(const Value& value);
/// `body`: the workpiece that the hole is in; gives the defaults of its place.
geometry::Hole read_hole(const Value& value, const geometry::Workpiece& body);
tool::Tool read_tool(const Value& value);

struct ResolvedWorkpiece {
  geometry::Workpiece workpiece;
  std::optional<int> revision;          ///< of the library; absent for an inline object
  std::optional<std::string> material;  ///< names a cutting-coefficient set
};
struct ResolvedTool {
  tool::Tool tool;
  std::optional<int> revision;
  nlohmann::json dynamics = nullptr;  ///< how the tool gives way; null: not said
};

/// A name of the library or an inline object. Throws Error{UnknownWorkpiece}.
ResolvedWorkpiece resolve_workpiece(const Value& value, const Definitions& definitions);
/// A number or a name of the library, or an inline object. Throws Error{UnknownTool}.
ResolvedTool resolve_tool(const Value& value, const Definitions& definitions);
/// A name among the workpiece's holes, or an inline object. Throws Error{UnknownHole}.
geometry::Hole resolve_hole(const Value& value, const geometry::Workpiece& workpiece);

}  // namespace ridgeline::jobs
