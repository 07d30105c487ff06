#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/answer.hpp"
#include "service/sqlite.hpp"

namespace ridgeline::service {

/// One revision of a definition, or its removal, which is a revision too. Never changed once made.
/// Two instances that did not see each other may both make revision n: all are kept, and the one
/// that is greatest by (revision, time, origin) holds.
struct Change {
  std::string kind;
  std::string name;
  int revision = 0;
  std::int64_t time = 0;  ///< when it was made [ns since 1970]
  std::string origin;     ///< the run of the program that made it, 32 hexadecimal digits
  std::string instance;   ///< its name, for people
  std::string request;    ///< id of the request that asked for it; empty: none
  bool removed = false;
  std::string document;  ///< JSON; empty when removed
};

/// What a put or a removal did.
struct Receipt {
  std::string kind;
  std::string name;
  int revision = 0;
  bool is_new = true;  ///< false: the library held just that already
};

/// A definition as a list shows it.
struct Listed {
  std::string kind;
  std::string name;
  std::optional<std::string> alias;  ///< number of a named tool
  int revision = 0;
  std::int64_t time = 0;
  std::string instance;
  bool is_damaged = false;
};

/// The named definitions in one SQLite file: write-ahead log, full sync, so that what was
/// acknowledged is still there after kill -9. Several processes may use one file. A damaged file is
/// read as far as it can be and not written: see damage(). All functions may be called from any
/// thread and throw Error{Storage} when the file fails.
class Library : public jobs::Definitions {
public:
  /// Opens or creates. `file` ":memory:" holds as long as the object. `instance` names the author
  /// of changes.
  explicit Library(const std::filesystem::path& file, std::string instance = "local");

  std::optional<jobs::Definition> find(std::string_view kind, std::string_view name) const override;
  std::vector<std::string> names(std::string_view kind) const override;

  /// The change that holds, or the one of that revision; nullopt when there is none.
  std::optional<Change> get(std::string_view kind, std::string_view name,
                            std::optional<int> revision = {}) const;
  std::vector<Listed> list(std::optional<std::string_view> kind = {}) const;
  /// Every change of a name, oldest first.
  std::vector<Change> history(std::string_view kind, std::string_view name) const;

  /// Checks and stores. The same request twice stores once. Throws what validate_definition throws.
  Receipt put(const nlohmann::json& definition, std::string_view request = {});
  /// All or none; the field of an error begins with /definitions/<index>.
  std::vector<Receipt> put_all(std::span<const nlohmann::json> definitions,
                               std::string_view request = {});
  /// Throws Error{UnknownDefinition}.
  Receipt remove(std::string_view kind, std::string_view name, std::string_view request = {});

  /// Up to `limit` changes in the order in which this file got them, after the position `after`,
  /// which is moved on. Damaged records are left out.
  std::vector<Change> changes(std::int64_t& after, int limit) const;
  /// Takes changes made elsewhere; those known already are left alone. Returns how many were new.
  int merge(std::span<const Change> changes);
  /// Revisions that were made twice with different contents.
  int conflicts() const;

  /// Empty, or what is wrong with the file.
  const std::string& damage() const noexcept { return damage_; }
  const std::string& file() const noexcept { return file_; }

private:
  void create();
  void salvage(const std::string& reason);
  void require_writable() const;
  std::optional<Change> held_change(std::string_view kind, std::string_view name) const;
  std::optional<Change> aliased_change(std::string_view kind, std::string_view name) const;
  Receipt store(const nlohmann::json& definition, std::string_view request);
  void insert(const Change& change, const std::optional<std::string>& alias);
  std::optional<Receipt> done(std::string_view kind, std::string_view name,
                              std::string_view request) const;

  std::string file_;
  std::string instance_;
  std::string origin_;
  std::string damage_;
  mutable std::mutex mutex_;  ///< one statement at a time
  mutable sqlite::Connection connection_;
};

/// Where the library is when nothing else is said: $RIDGELINE_LIBRARY, or ridgeline/library.db
/// below $XDG_DATA_HOME or ~/.local/share.
std::filesystem::path default_library_file();

/// A number that differs for each change; the exclusive or over a library tells whether two hold
/// the same.
std::uint64_t digest(const Change& change);

}  // namespace ridgeline::service
