#include <cstdlib>
#include <random>

#include "jobs/definitions.hpp"
#include "service/library.hpp"
#include "service/library_rows.hpp"

namespace ridgeline::service {
namespace {

using sqlite::Statement;

constexpr int application_id = 0x52444c4e;  // "RDLN", tells our files from others
constexpr int schema_version = 1;
constexpr char schema[] = R"sql(
  CREATE TABLE change(
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    kind TEXT NOT NULL,
    name TEXT NOT NULL,
    revision INTEGER NOT NULL,
    time INTEGER NOT NULL,
    origin TEXT NOT NULL,
    instance TEXT NOT NULL,
    request TEXT NOT NULL,
    removed INTEGER NOT NULL,
    document TEXT NOT NULL,
    checksum INTEGER NOT NULL,
    UNIQUE(kind, name, revision, time, origin));
  CREATE INDEX change_request ON change(request) WHERE request <> '';
  CREATE TABLE current(
    kind TEXT NOT NULL,
    name TEXT NOT NULL,
    alias TEXT,
    change INTEGER NOT NULL REFERENCES change(id),
    PRIMARY KEY(kind, name)) WITHOUT ROWID;
  CREATE INDEX current_alias ON current(kind, alias) WHERE alias IS NOT NULL;
)sql";

std::string random_origin() {
  std::random_device device;
  std::uniform_int_distribution<int> digit(0, 15);
  std::string origin(32, '0');
  for (char& c : origin) c = "0123456789abcdef"[digit(device)];
  return origin;
}

/// The file's name, its folder made.
const std::string& prepared(const std::string& file) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  std::error_code error;
  if (file != ":memory:" && !folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) {
    throw Error(ErrorCode::Storage,
                "library " + file + ": its folder cannot be made (" + error.message() + ")");
  }
  return file;
}

}  // namespace

std::string select_changes(std::string_view rest) {
  return "SELECT " + std::string(change_columns) + " FROM change " + std::string(rest);
}

/// A row that begins with `columns`. nullopt: its checksum says that it was damaged.
std::optional<Change> change_of(const Statement& row) {
  Change change{.kind = row.text(0),
                .name = row.text(1),
                .revision = static_cast<int>(row.number(2)),
                .time = row.number(3),
                .origin = row.text(4),
                .instance = row.text(5),
                .request = row.text(6),
                .removed = row.number(7) != 0,
                .document = row.text(8)};
  if (static_cast<std::int64_t>(digest(change)) != row.number(9)) return {};
  return change;
}

std::optional<std::string> alias_of(const Change& change) {
  if (change.removed) return {};
  return jobs::key_of(nlohmann::json::parse(change.document)).alias;
}

std::uint64_t digest(const Change& change) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  const auto add = [&hash](std::string_view bytes) {
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    hash = (hash ^ 0xff) * 0x100000001b3;  // no byte of UTF-8: ends the field
  };
  for (const std::string* text : {&change.kind, &change.name, &change.origin, &change.instance,
                                  &change.request, &change.document}) {
    add(*text);
  }
  add(std::to_string(change.revision));
  add(std::to_string(change.time));
  add(change.removed ? "removed" : "");
  hash ^= hash >> 33;  // spreads the low bits, for the exclusive or of many
  hash *= 0xff51afd7ed558ccd;
  return hash ^ (hash >> 33);
}

std::filesystem::path default_library_file() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value == nullptr ? "" : value);
  };
  if (auto file = variable("RIDGELINE_LIBRARY"); !file.empty()) return file;
  auto folder = variable("XDG_DATA_HOME");
  if (folder.empty()) folder = variable("HOME") / ".local/share";
  return folder / "ridgeline/library.db";
}

Library::Library(const std::filesystem::path& file, std::string instance)
    : file_(file.string()),
      instance_(std::move(instance)),
      origin_(random_origin()),
      connection_(prepared(file_), sqlite::Connection::Access::ReadWrite) {
  try {
    create();
    Statement check(connection_, "PRAGMA quick_check(1)");
    if (check.step() && check.text(0) != "ok") salvage(check.text(0));
  } catch (const Error&) {
    const int code = sqlite3_errcode(connection_.get());
    if ((code & 0xff) != SQLITE_CORRUPT) throw;
    salvage(sqlite3_errstr(code));
  }
}

void Library::create() {
  const auto number = [this](const char* sql) {
    Statement statement(connection_, sql);
    return statement.step() ? statement.number(0) : 0;
  };
  connection_.run("PRAGMA journal_mode = WAL");
  connection_.run("PRAGMA synchronous = FULL");
  if (number("PRAGMA user_version") == 0) {
    sqlite::Transaction transaction(connection_);
    if (number("SELECT count(*) FROM sqlite_schema") == 0) {  // not created meanwhile by another
      connection_.run(schema);
      connection_.run(("PRAGMA application_id = " + std::to_string(application_id)).c_str());
      connection_.run(("PRAGMA user_version = " + std::to_string(schema_version)).c_str());
    }
    transaction.commit();
  }
  if (number("PRAGMA application_id") != application_id) {
    throw Error(ErrorCode::Storage, "library " + file_ + ": it is the database of another program");
  }
  if (number("PRAGMA user_version") > schema_version) {
    throw Error(ErrorCode::Storage, "library " + file_ + ": it has version " +
                                        std::to_string(number("PRAGMA user_version")) +
                                        ", written by a newer program; this one reads up to " +
                                        std::to_string(schema_version));
  }
}

/// Copies every record that can still be read into memory, row by row past the damaged pages.
void Library::salvage(const std::string& reason) {
  damage_ = "library " + file_ + " is damaged (" + reason +
            "): what could be read is used, nothing can be changed";
  const sqlite::Connection damaged = std::move(connection_);
  connection_ = sqlite::Connection(":memory:", sqlite::Connection::Access::ReadWrite);
  connection_.run(schema);
  std::int64_t last = 1'000'000;  // rows to try when not even their number can be read
  for (const char* sql :
       {"SELECT seq FROM sqlite_sequence WHERE name = 'change'", "SELECT max(id) FROM change"}) {
    try {
      Statement statement(damaged, sql);
      if (statement.step() && !statement.is_null(0)) {
        last = statement.number(0);
        break;
      }
    } catch (const Error&) {
      continue;  // the next way to learn it
    }
  }
  const std::string by_id = select_changes("WHERE id = ?");
  int lost = 0;
  for (std::int64_t id = 1; id <= last; ++id) {
    try {
      Statement row(damaged, by_id.c_str());
      if (!row.bind(id).step()) continue;
      const auto change = change_of(row);
      if (change) {
        insert(*change, alias_of(*change));
      } else {
        ++lost;
      }
    } catch (const Error&) {
      ++lost;
    }
  }
  damage_ += "; records lost: " + std::to_string(lost);
}

}  // namespace ridgeline::service
