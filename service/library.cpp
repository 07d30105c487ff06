#include "service/library.hpp"

#include <chrono>
#include <tuple>

#include "jobs/definitions.hpp"
#include "service/library_rows.hpp"

namespace ridgeline::service {
namespace {

using Json = nlohmann::json;
using sqlite::Statement;

std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

Change intact(const std::string& file, const Statement& row) {
  if (auto change = change_of(row)) return *std::move(change);
  throw Error(ErrorCode::Storage, "library " + file + ": the record of " + row.text(0) + " \"" +
                                      row.text(1) + "\" is damaged");
}

bool is_later(const Change& a, const Change& b) {
  return std::tie(a.revision, a.time, a.origin) > std::tie(b.revision, b.time, b.origin);
}

}  // namespace

void Library::require_writable() const {
  if (!damage_.empty()) throw Error(ErrorCode::Storage, damage_);
}

std::optional<Change> Library::get(std::string_view kind, std::string_view name,
                                   std::optional<int> revision) const {
  const std::scoped_lock lock(mutex_);
  std::optional<Change> held = held_change(kind, name);
  if (!revision || (held && held->revision == *revision)) return held;
  Statement row(connection_, select_changes("WHERE kind = ? AND name = ? AND revision = ? "
                                            "ORDER BY time DESC, origin DESC LIMIT 1")
                                 .c_str());
  row.bind(kind).bind(held ? held->name : name).bind(std::int64_t{*revision});
  if (!row.step()) return {};
  return intact(file_, row);
}

std::optional<Change> Library::held_change(std::string_view kind, std::string_view name) const {
  Statement row(connection_, select_changes("WHERE id = (SELECT change FROM current "
                                            "WHERE kind = ? AND name = ?)")
                                 .c_str());
  if (row.bind(kind).bind(name).step()) {
    Change change = intact(file_, row);
    if (!change.removed) return change;
    auto aliased = aliased_change(kind, name);
    return aliased ? aliased : change;
  }
  return aliased_change(kind, name);
}

std::optional<Change> Library::aliased_change(std::string_view kind, std::string_view name) const {
  Statement row(connection_, select_changes("WHERE id IN (SELECT change FROM current "
                                            "WHERE kind = ? AND alias = ?)")
                                 .c_str());
  if (!row.bind(kind).bind(name).step()) return {};
  Change change = intact(file_, row);
  if (row.step()) {
    throw Error(ErrorCode::BadInput, std::string(kind) + " " + std::string(name) +
                                         " stands for two definitions, \"" + change.name +
                                         "\" and \"" + row.text(1) + "\": change one of them");
  }
  return change;
}

std::optional<jobs::Definition> Library::find(std::string_view kind, std::string_view name) const {
  const std::optional<Change> change = get(kind, name);
  if (!change || change->removed) return {};
  return jobs::Definition{Json::parse(change->document), change->revision};
}

std::vector<std::string> Library::names(std::string_view kind) const {
  std::vector<std::string> names;
  for (const Listed& each : list(kind)) {
    names.push_back(each.name);
    if (each.alias) names.push_back(*each.alias);
  }
  return names;
}

std::vector<Listed> Library::list(std::optional<std::string_view> kind) const {
  const std::scoped_lock lock(mutex_);
  Statement row(connection_,
                ("SELECT c." + std::string("kind, c.name, c.revision, c.time, c.origin, "
                                           "c.instance, c.request, c.removed, c.document, "
                                           "c.checksum, u.alias FROM current u JOIN change c ON "
                                           "c.id = u.change WHERE ? OR c.kind = ? "
                                           "ORDER BY c.kind, c.name"))
                    .c_str());
  row.bind(std::int64_t{!kind}).bind(kind.value_or(""));
  std::vector<Listed> result;
  while (row.step()) {
    if (row.number(7) != 0) continue;
    result.push_back({.kind = row.text(0),
                      .name = row.text(1),
                      .alias = row.is_null(10) ? std::nullopt : std::optional(row.text(10)),
                      .revision = static_cast<int>(row.number(2)),
                      .time = row.number(3),
                      .instance = row.text(5),
                      .is_damaged = !change_of(row)});
  }
  return result;
}

std::vector<Change> Library::history(std::string_view kind, std::string_view name) const {
  const std::scoped_lock lock(mutex_);
  Statement row(
      connection_,
      select_changes("WHERE kind = ? AND name = ? ORDER BY revision, time, origin").c_str());
  row.bind(kind).bind(name);
  std::vector<Change> result;
  while (row.step()) result.push_back(intact(file_, row));
  return result;
}

std::optional<Receipt> Library::done(std::string_view kind, std::string_view name,
                                     std::string_view request) const {
  if (request.empty()) return {};
  Statement row(connection_,
                "SELECT revision FROM change WHERE request = ? AND kind = ? AND name = ?");
  if (!row.bind(request).bind(kind).bind(name).step()) return {};
  return Receipt{std::string(kind), std::string(name), static_cast<int>(row.number(0)), true};
}

void Library::insert(const Change& change, const std::optional<std::string>& alias) {
  Statement insert(connection_, ("INSERT INTO change(" + std::string(change_columns) +
                                 ") VALUES(?,?,?,?,?,?,?,?,?,?)")
                                    .c_str());
  insert.bind(change.kind)
      .bind(change.name)
      .bind(std::int64_t{change.revision})
      .bind(change.time)
      .bind(change.origin)
      .bind(change.instance)
      .bind(change.request)
      .bind(std::int64_t{change.removed})
      .bind(change.document)
      .bind(static_cast<std::int64_t>(digest(change)))
      .run();
  const std::int64_t id = sqlite3_last_insert_rowid(connection_.get());
  Statement current(connection_, select_changes("WHERE id = (SELECT change FROM current "
                                                "WHERE kind = ? AND name = ?)")
                                     .c_str());
  if (current.bind(change.kind).bind(change.name).step()) {
    const auto held = change_of(current);
    if (held && !is_later(change, *held)) return;
  }
  Statement update(connection_, "REPLACE INTO current(kind, name, alias, change) VALUES(?,?,?,?)");
  update.bind(change.kind).bind(change.name);
  if (alias) {
    update.bind(*alias);
  } else {
    update.bind(std::optional<std::int64_t>());
  }
  update.bind(id).run();
}

Receipt Library::store(const Json& definition, std::string_view request) {
  jobs::validate_definition(definition);
  const jobs::DefinitionKey key = jobs::key_of(definition);
  if (auto receipt = done(key.kind, key.name, request)) return *receipt;

  Statement taken(connection_,
                  "SELECT c.name FROM current u JOIN change c ON c.id = u.change WHERE u.kind = ? "
                  "AND c.removed = 0 AND u.name <> ? AND (u.alias IN (?, ?) OR u.name = ?)");
  const std::string& alias = key.alias ? *key.alias : key.name;
  if (taken.bind(key.kind).bind(key.name).bind(alias).bind(key.name).bind(alias).step()) {
    throw Error(ErrorCode::BadInput,
                key.kind + " \"" + key.name + "\": number " + alias + " is that of \"" +
                    taken.text(0) + "\"",
                {.field = "/number",
                 .value = alias,
                 .limit = "a number that no other " + key.kind + " has",
                 .parameter = {},
                 .target = {}});
  }

  Change change{.kind = key.kind,
                .name = key.name,
                .revision = 1,
                .time = now(),
                .origin = origin_,
                .instance = instance_,
                .request = std::string(request),
                .removed = false,
                .document = definition.dump()};
  Statement row(connection_,
                "SELECT c.revision, c.removed, c.document FROM current u JOIN change c "
                "ON c.id = u.change WHERE u.kind = ? AND u.name = ?");
  if (row.bind(key.kind).bind(key.name).step()) {
    const auto held = static_cast<int>(row.number(0));
    if (row.number(1) == 0 && row.text(2) == change.document) {
      return {key.kind, key.name, held, false};
    }
    change.revision = held + 1;
  }
  insert(change, key.alias);
  return {key.kind, key.name, change.revision, true};
}

Receipt Library::put(const Json& definition, std::string_view request) {
  const std::scoped_lock lock(mutex_);
  require_writable();
  sqlite::Transaction transaction(connection_);
  Receipt receipt = store(definition, request);
  transaction.commit();
  return receipt;
}

std::vector<Receipt> Library::put_all(std::span<const Json> definitions, std::string_view request) {
  const std::scoped_lock lock(mutex_);
  require_writable();
  sqlite::Transaction transaction(connection_);
  std::vector<Receipt> receipts;
  for (std::size_t i = 0; i < definitions.size(); ++i) {
    try {
      receipts.push_back(store(definitions[i], request));
    } catch (const Error& error) {
      ErrorDetails details = error.details();
      details.field = "/definitions/" + std::to_string(i) + details.field;
      throw Error(error.code(), error.what(), details);
    }
  }
  transaction.commit();
  return receipts;
}

Receipt Library::remove(std::string_view kind, std::string_view name, std::string_view request) {
  const std::scoped_lock lock(mutex_);
  require_writable();
  sqlite::Transaction transaction(connection_);
  const std::optional<Change> held = held_change(kind, name);
  if (held) {
    if (auto receipt = done(kind, held->name, request)) return *receipt;
  }
  if (!held || held->removed) {
    throw Error(ErrorCode::UnknownDefinition,
                "the library has no " + std::string(kind) + " \"" + std::string(name) + "\"",
                {.field = "/name",
                 .value = std::string(name),
                 .limit = "a name that \"list\" lists",
                 .parameter = {},
                 .target = {}});
  }
  Change change = *held;
  change.revision = held->revision + 1;
  change.time = now();
  change.origin = origin_;
  change.instance = instance_;
  change.request = std::string(request);
  change.removed = true;
  change.document.clear();
  insert(change, {});
  transaction.commit();
  return {change.kind, change.name, change.revision, true};
}

std::vector<Change> Library::changes(std::int64_t& after, int limit) const {
  const std::scoped_lock lock(mutex_);
  Statement row(connection_, ("SELECT " + std::string(change_columns) +
                              ", id FROM change WHERE id > ? ORDER BY id LIMIT ?")
                                 .c_str());
  row.bind(after).bind(std::int64_t{limit});
  std::vector<Change> result;
  while (row.step()) {
    after = row.number(10);
    if (auto change = change_of(row)) result.push_back(*std::move(change));
  }
  return result;
}

int Library::merge(std::span<const Change> changes) {
  const std::scoped_lock lock(mutex_);
  require_writable();
  sqlite::Transaction transaction(connection_);
  int added = 0;
  for (const Change& change : changes) {
    Statement row(connection_, ("SELECT " + std::string(change_columns) +
                                ", id FROM change WHERE kind = ? AND name = ? AND revision = ? "
                                "AND time = ? AND origin = ?")
                                   .c_str());
    row.bind(change.kind).bind(change.name).bind(std::int64_t{change.revision});
    if (row.bind(change.time).bind(change.origin).step()) {
      if (change_of(row)) continue;
      Statement heal(connection_, "DELETE FROM change WHERE id = ?");  // ours is damaged
      heal.bind(row.number(10)).run();
    }
    insert(change, alias_of(change));
    ++added;
  }
  transaction.commit();
  return added;
}

int Library::conflicts() const {
  const std::scoped_lock lock(mutex_);
  Statement row(connection_,
                "SELECT count(*) FROM (SELECT 1 FROM change GROUP BY kind, name, revision "
                "HAVING count(DISTINCT document) > 1)");
  row.step();
  return static_cast<int>(row.number(0));
}

}  // namespace ridgeline::service
