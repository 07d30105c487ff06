#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "service/library.hpp"
#include "service/sqlite.hpp"

/// How changes lie in the file; for the functions of Library alone.
namespace ridgeline::service {

inline constexpr char change_columns[] =
    "kind, name, revision, time, origin, instance, request, removed, document, checksum";

/// A query of whole changes.
std::string select_changes(std::string_view rest);

/// A row that begins with change_columns. nullopt: its checksum says that it was damaged.
std::optional<Change> change_of(const sqlite::Statement& row);

/// The other name under which a change is found.
std::optional<std::string> alias_of(const Change& change);

}  // namespace ridgeline::service
